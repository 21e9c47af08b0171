// The page itself: what a change of one thing changes elsewhere.

import { answerTo, heldInstead, lawsAt, percent } from "./answer.mjs";
import { chartOf, lawLine } from "./chart.mjs";
import { fieldBox, markRight, markWrong } from "./fields.mjs";
import { fitPanel } from "./fit_panel.mjs";
import { solverOfAll } from "./kinds.mjs";
import { liquidNames } from "./liquids.mjs";
import { drawMap, MAP_DEGREES, MAP_MARGIN, mapChoices, mapFrame, mapKey, mapSides, valueAtShare } from "./map.mjs";
import { pictureOf, solidsInWords, VIEW_BOX } from "./picture.mjs";
import { load } from "./pendular.mjs";
import { MODULE, RECORDS } from "./records.mjs";
import { layOutKinds, showKinds, SOLID_LABELS } from "./solids_panel.mjs";
import { BEYOND_RUPTURE, positionOf, trackOf, valueAt, valueOf, written } from "./tracks.mjs";
import { show } from "./units.mjs";
import { asksForHeap, closeHeap, heapLink, openHeap } from "./views.mjs";
import { FIRST_VIEW, hashOf, HELD, startingValue, viewAt } from "./view.mjs";
import { commandOf, csvOf, numbersOf, plainText, programOf, spoken, tilesOf } from "./words.mjs";

const LABELS = {
  separation: "Separation",
  ...SOLID_LABELS,
  "contact-angle": "Contact angle 1",
  "contact-angle2": "Contact angle 2",
  liquid: "Liquid",
  temperature: "Temperature",
  "surface-tension": "Surface tension",
};
const BY_NAME = "by name";
const GIVEN = "surface tension";
const CSV_POINTS = 201; // as the command has them
const LITTLE = 80; // between two changes of tables and texts while a hand moves, [ms]
const PAUSE = 250; // after the last change: what is slow, or speaks, waits so long, [ms]

const at = (id) => document.getElementById(id);
export const exact = solverOfAll(await load(MODULE));
const fields = {};
let answer; // what is shown
let fitting; // the panel of a measured curve
let picture;
let chart;
let stopMap = () => {};
const sizes = { chart: [0, 0], plan: [0, 0] }; // in pixels

// -- Laying out ------------------------------------------------------------------------------------------------------

function layOut() {
  for (const place of document.querySelectorAll("[data-fields]"))
    for (const name of place.dataset.fields.split(" ")) place.append(fieldNamed(name));
  layOutKinds(() => ahead?.view ?? answer.view, change);
  choice("control", HELD, hold);
  choice("source", [BY_NAME, GIVEN], giveLiquid);
  options(
    "plot",
    RECORDS.plotted.map((name) => [name, name.replaceAll("_", " ")]),
  );
  options("map-choice", mapChoices());
  at("liquids").innerHTML = liquidNames()
    .map((name) => `<option value="${plainText(name)}">`)
    .join("");
  at("laws").innerHTML = RECORDS.laws.map(lawRow).join("");
}

function fieldNamed(name) {
  const made = fieldBox(name, LABELS[name] ?? "Suction", name === "liquid" ? "liquids" : "");
  const { field, text, slider } = made;
  fields[name] = made;
  const finish = () => {
    const typed = text.value.trim();
    if (made.isRefused || typed !== answer.view[name]) change(name, { [name]: typed });
  };
  text.addEventListener("change", finish);
  slider?.addEventListener("input", () => slide(name, slider.valueAsNumber));
  return field;
}

export function choice(id, names, chosen) {
  at(id).innerHTML = names
    .map((name) => `<label><input type="radio" name="${id}" value="${name}"><span>${name}</span></label>`)
    .join("");
  at(id).addEventListener("change", (event) => chosen(event.target.value));
}

export function options(id, choices) {
  at(id).innerHTML = choices.map(([value, words]) => `<option value="${value}">${words}</option>`).join("");
}

function lawRow(law, place) {
  const canDraw = law.gives.includes("force");
  const title = law.doi
    ? `<a class="meaning" href="https://doi.org/${encodeURI(law.doi)}" title="${plainText(law.reference)}" rel="noreferrer">${plainText(law.title)}</a>`
    : `<span class="meaning" title="${plainText(law.reference)}">${plainText(law.title)}</span>`;
  const swatch = canDraw
    ? `<svg viewBox="0 0 28 6" aria-hidden="true"><path ${lawLine(place)} d="M1 3H27"/></svg>`
    : "";
  const name = canDraw
    ? `<label><input type="checkbox" value="${law.name}"> ${law.name}</label>`
    : `<span class="name">${law.name}</span>`;
  return (
    `<tr data-law="${law.name}"><th scope="row">${name}${swatch}${title}` +
    '<span class="outside"></span></th><td></td><td></td></tr>'
  );
}

// -- What a person does ----------------------------------------------------------------------------------------------

function listen() {
  at("is-same").addEventListener("change", (event) =>
    change("contact-angle2", { "contact-angle2": event.target.checked ? "" : answer.view["contact-angle"] }),
  );
  at("plot").addEventListener("change", (event) => change("value", { plot: event.target.value }));
  at("map-choice").addEventListener("change", (event) => change("value", { map: event.target.value }));
  at("across").addEventListener("change", (event) => change("value", { across: event.target.value }));
  at("laws").addEventListener("change", () =>
    change("value", { laws: [...at("laws").querySelectorAll("input:checked")].map(({ value }) => value) }),
  );
  letPull(at("picture"));
  letSeek(at("chart"));
  letGo(at("plan"));
  at("save-curve").addEventListener("click", () => save("curve.csv", "text/csv", curveTable()));
  at("save-picture").addEventListener("click", () => save("bridge.svg", "image/svg+xml", wholePicture()));
  at("save-program").addEventListener("click", () => save("bridge.py", "text/x-python", programOf(answer)));
  for (const button of document.querySelectorAll("[data-copies]")) button.addEventListener("click", () => copy(button));
  addEventListener("hashchange", () => begin());
  document.querySelector(".skip").addEventListener("click", skip);
  const observer = new ResizeObserver(() => {
    if (!answer || at("pair-view").hidden) return; // the heap is open
    measure();
    drawSized();
  });
  for (const id of Object.keys(sizes)) observer.observe(at(id));
}

const kindOf = (name) => (name === "value" ? answer.view.control : name);

function slide(name, position) {
  const value = valueAt(trackOf(kindOf(name), answer), position);
  change(name, { [name]: written(kindOf(name), value, name === "separation" ? 4 : 3) });
}

function hold(control) {
  let value;
  try {
    value = heldInstead(control, answer);
  } catch (error) {
    refuse("value", answer.view.value, error);
    return;
  }
  accept("value");
  const track = trackOf(control, answer);
  const text = Number.isNaN(value)
    ? answer.question.arePlanes
      ? written(control, valueAt(track, track.steps / 2))
      : startingValue(control)
    : written(control, value, 5);
  change("value", { control, value: text });
}

function giveLiquid(source) {
  const tension = written("surface-tension", answer.question.liquid.surfaceTension, 4);
  change("surface-tension", { "surface-tension": source === GIVEN ? tension : "" });
}

/** A grain is pulled along the axis: that under the hand stays there. */
function letPull(svg) {
  let held;
  const placeOf = (event) => {
    const box = svg.getBoundingClientRect();
    const unit = Math.max(VIEW_BOX[2] / box.width, VIEW_BOX[3] / box.height);
    const [x, y] = [event.clientX - box.x - 0.5 * box.width, event.clientY - box.y - 0.5 * box.height].map(
      (one) => one * unit,
    );
    return picture.upright ? -picture.upright * y : x;
  };
  svg.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    const place = placeOf(event);
    const [u, v] = picture.middle;
    const middle = picture.upright ? -picture.upright * v : u;
    held = { place, side: place >= middle ? 1 : -1, separation: answer.question.separation, metre: picture.metre };
    svg.setPointerCapture(event.pointerId);
    svg.classList.add("held");
    event.preventDefault();
  });
  svg.addEventListener("pointermove", (event) => {
    if (!held) return;
    // both grains move from the middle of the picture
    pull(held.separation + (2 * held.side * (placeOf(event) - held.place)) / held.metre);
  });
  for (const name of ["pointerup", "pointercancel"])
    svg.addEventListener(name, () => {
      held = undefined;
      svg.classList.remove("held");
    });
}

/** Set the separation, between contact and some way beyond rupture. */
function pull(separation) {
  const { low, high } = trackOf("separation", answer);
  const most = answer.rupture ? Math.max(high, BEYOND_RUPTURE * answer.rupture.separation) : high;
  change("separation", { separation: written("separation", Math.min(Math.max(separation, low), most), 4) });
}

/** A place on the curve is gone to. */
function letSeek(svg) {
  const separationAt = (event) => {
    const { x0, x1, left, right } = chart.inner;
    return x0 + ((event.clientX - svg.getBoundingClientRect().x - left) / (right - left)) * (x1 - x0);
  };
  svg.addEventListener("pointerdown", (event) => {
    if (event.button || !chart.inner) return;
    svg.setPointerCapture(event.pointerId);
    pull(separationAt(event));
  });
  svg.addEventListener("pointermove", (event) => {
    if (!chart.inner) return;
    if (svg.hasPointerCapture(event.pointerId)) pull(separationAt(event));
    else at("readout").value = `at ${show(Math.max(0, separationAt(event)), "m", 3)}`;
  });
  svg.addEventListener("pointerleave", () => (at("readout").value = ""));
}

/** A place on the map is gone to. */
function letGo(plan) {
  const go = (event) => {
    const box = plan.getBoundingClientRect();
    const { left, right, top, bottom } = MAP_MARGIN;
    const share = (event.clientX - box.x - left) / (box.width - left - right);
    const degrees = MAP_DEGREES * (1 - (event.clientY - box.y - top) / (box.height - top - bottom));
    if (share < 0 || share > 1 || degrees < 0 || degrees > MAP_DEGREES) return;
    const sides = mapSides(answer);
    const value = valueAtShare(sides, share);
    const changes = { "contact-angle": written("contact-angle", Math.round(degrees)) };
    if (sides.across === "separation") changes.separation = written("separation", value, 4);
    else Object.assign(changes, { control: sides.control, value: written(sides.control, value) });
    change(sides.across === "separation" ? "separation" : "value", changes);
  };
  plan.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    plan.setPointerCapture(event.pointerId);
    go(event);
  });
  plan.addEventListener("pointermove", (event) => plan.hasPointerCapture(event.pointerId) && go(event));
}

// -- What follows from it --------------------------------------------------------------------------------------------

let ahead; // the view to be shown in the next frame, and the field that asked for it

/** Show another view in the next frame: a fast hand never runs ahead of a slow machine. */
function change(field, changes) {
  const isFirst = ahead === undefined;
  ahead = { view: { ...(ahead?.view ?? answer.view), ...changes }, field };
  if (isFirst) requestAnimationFrame(showAhead);
}

function showAhead() {
  const { view, field } = ahead;
  if (!exact.knows(view)) {
    learn(field);
    return;
  }
  ahead = undefined;
  try {
    showAnswer(answerTo(view, exact, answer, true));
  } catch (error) {
    if (!(error instanceof RangeError)) throw error;
    refuse(field, view[field], error);
    return;
  }
  accept(field);
  showFields();
}

/** Load the solver of other solids, and show then what is ahead. */
function learn(field) {
  fill(at("notices"), "<p>Loading the solver of other solids …</p>");
  exact.learn().then(showAhead, (error) => {
    const { view } = ahead;
    ahead = undefined;
    refuse(field, view[field], error);
    fill(at("notices"), "");
  });
}

function showAnswer(next) {
  const isMapOld = !answer || mapKeyOf(next) !== mapKeyOf(answer);
  answer = next;
  picture = pictureOf(answer, exact);
  const svg = at("picture");
  fill(svg, picture.svg);
  svg.classList.toggle("upright", picture.upright !== 0);
  svg.setAttribute("aria-label", picture.words);
  fill(at("tiles"), tilesOf(answer));
  fill(at("notices"), answer.notices.map((notice) => `<p>${plainText(notice)}</p>`).join(""));
  drawSized();
  showFields();
  if (isMapOld) {
    stopMap();
    at("plan").classList.add("old");
  }
  later(isMapOld);
}

const filled = new WeakMap();

/** Give an element its content, where that is another one than before: each change is laid out and painted. */
export function fill(element, content) {
  if (filled.get(element) === content) return;
  element.innerHTML = content;
  filled.set(element, content);
}

function drawSized() {
  chart = chartOf(answer, ...sizes.chart);
  fill(at("chart-lines"), chart.svg);
  fill(at("chart-now"), chart.now);
  at("chart").setAttribute("aria-label", chart.words);
  const frame = mapFrame(answer, ...sizes.plan);
  fill(at("frame-lines"), frame.svg);
  fill(at("frame-now"), frame.now);
}

/** Sizes are kept: to ask for them in each frame would lay out the page twice. */
function measure() {
  for (const id of Object.keys(sizes)) sizes[id] = [at(id).clientWidth, at(id).clientHeight];
}

/** What the colours of the map depend on. */
function mapKeyOf({ view, question }) {
  const angle = question.degrees[0] === question.degrees[1] ? "same" : question.degrees[1];
  const byControl =
    view.across === "separation" ? Object.values(question.held) : [question.separation, view.control === "volume"];
  const needsGap = view.map === "rupture" && view.across === "control" ? [view.control === "volume"] : byControl;
  const solids = [question.pair.radius, JSON.stringify(question.pair.solids)];
  return [view.map, view.across, angle, ...solids, question.held.surfaceTension, needsGap].join(" ");
}

let soon;
let waiting;
let isMapWaiting = false;

/** What nobody waits for: tables and texts follow a little later, the address and the map when the hand rests. */
function later(isMapOld) {
  isMapWaiting ||= isMapOld;
  soon ??= setTimeout(showSoon, LITTLE);
  clearTimeout(waiting);
  waiting = setTimeout(() => {
    if (!answer.branch.isWhole) showAnswer(answerTo(answer.view, exact, answer));
    at("spoken").textContent = spoken(answer);
    // A link to the heap may just have been followed.
    if (!asksForHeap(location.hash.slice(1))) history.replaceState(null, "", `#${hashOf(answer.view)}`);
    if (isMapWaiting) startMap();
    isMapWaiting = false;
  }, PAUSE);
}

function showSoon() {
  soon = undefined;
  fill(at("numbers"), numbersOf(answer));
  at("command").textContent = commandOf(answer.view);
  at("program").textContent = programOf(answer);
  fitting?.follow();
  for (const { law, forceError, ruptureError, outside } of lawsAt(answer, exact)) {
    const row = at("laws").querySelector(`[data-law="${law.name}"]`);
    const cells = row.querySelectorAll("td");
    fill(cells[0], law.gives.includes("force") ? percent(forceError) : "");
    fill(cells[1], law.gives.includes("rupture") ? percent(ruptureError) : "");
    fill(row.querySelector(".outside"), plainText(outside));
    row.classList.toggle("beyond", outside !== "");
  }
}

function startMap() {
  stopMap();
  const told = at("map-key");
  if (answer.question.arePlanes && answer.view.across === "control") {
    told.textContent = "No map of two planes.";
    at("canvas").hidden = true;
    return;
  }
  at("canvas").hidden = false;
  stopMap = drawMap(at("canvas"), answer, exact, (range) => {
    at("plan").classList.remove("old");
    const key = mapKey(range, answer.view.map);
    told.innerHTML = range.isEmpty
      ? "no bridge anywhere, or nothing that the law says"
      : `<span>${key.low}</span><span class="bar" style="background:${key.bar}"></span><span>${key.high}</span><span class="none"></span><span>none</span>`;
    at("frame").setAttribute(
      "aria-label",
      `Map of the ${at("map-choice").selectedOptions[0].text}, from ${key.low} to ${key.high}`,
    );
    document.dispatchEvent(new Event("mapped"));
  });
}

function showFields() {
  const { view } = answer;
  for (const radio of document.querySelectorAll("[name=control]")) radio.checked = radio.value === view.control;
  for (const radio of document.querySelectorAll("[name=source]"))
    radio.checked = (radio.value === GIVEN) === (view["surface-tension"] !== "");
  at("plot").value = view.plot;
  at("map-choice").value = view.map;
  at("across").value = view.across;
  showKinds(view, fields);
  at("is-same").checked = view["contact-angle2"] === "";
  for (const tick of at("laws").querySelectorAll("input")) tick.checked = view.laws.includes(tick.value);
  const label = view.control[0].toUpperCase() + view.control.slice(1);
  fields.value.label.textContent = label;
  fields.value.slider.setAttribute("aria-label", label);
  fields["contact-angle2"].field.hidden = view["contact-angle2"] === "";
  fields.liquid.field.hidden = fields.temperature.field.hidden = view["surface-tension"] !== "";
  fields["surface-tension"].field.hidden = view["surface-tension"] === "";
  fields["contact-angle"].label.textContent = view["contact-angle2"] === "" ? "Contact angle" : LABELS["contact-angle"];
  fields["contact-angle"].slider.setAttribute("aria-label", fields["contact-angle"].label.textContent);
  for (const [name, field] of Object.entries(fields)) showField(name, field);
}

function showField(name, { text, slider, isRefused }) {
  if (isRefused) return;
  if (text !== document.activeElement || text.value.trim() !== answer.view[name]) text.value = answer.view[name];
  if (!slider) return;
  const track = trackOf(kindOf(name), answer);
  slider.max = track.steps;
  // the slider in use is ahead of what is rounded in its field
  if (slider !== document.activeElement) slider.value = Math.round(positionOf(track, valueOf(name, answer)));
  slider.setAttribute("aria-valuetext", answer.view[name]);
}

function refuse(name, text, error) {
  markWrong(fields[name], text, error);
  showFields();
}

function accept(name) {
  if (fields[name].isRefused) markRight(fields[name]);
}

// -- To take away ----------------------------------------------------------------------------------------------------

const curveTable = () =>
  csvOf(exact.curve(answer.question.pair, answer.question.held, CSV_POINTS).filter(Boolean), answer.question);

/** Picture and curve beside each other, in the colours of paper. */
function wholePicture() {
  const [width, height] = [460, 340];
  const palette = paperColours();
  const lines = chartOf(answer, width, height);
  const rules = [...document.styleSheets[0].cssRules].filter((rule) =>
    /^\.(picture|chart)\b/.test(rule.selectorText ?? ""),
  );
  const css = rules
    .map((rule) => rule.cssText)
    .join("\n")
    .replaceAll(/var\((--[\w-]+)\)/g, (_, name) => palette[name]);
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" width="${2 * width}" height="${height}" viewBox="0 0 ${2 * width} ${height}" font-family="sans-serif">` +
    `<title>${plainText(solidsInWords(answer.question))}</title><style>${css}</style><rect width="100%" height="100%" fill="#fff"/>` +
    `<svg class="picture" width="${width}" height="${height}" viewBox="${VIEW_BOX.join(" ")}">${picture.svg}</svg>` +
    `<svg class="chart" x="${width}" width="${width}" height="${height}">${lines.svg}${lines.now}</svg></svg>`
  );
}

/** Colours of the style sheet as they are in the light. */
export function paperColours() {
  const style = getComputedStyle(document.documentElement);
  const palette = Object.fromEntries(
    at("style")
      .textContent.match(/--[\w-]+(?=:)/g)
      .map((name) => [name, style.getPropertyValue(name)]),
  );
  const light = at("style").textContent.match(/:root \{([^}]*)\}/)[1];
  for (const [, name, value] of light.matchAll(/(--[\w-]+): *([^;]+);/g)) palette[name] = value;
  return palette;
}

export function save(name, type, content) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** Put a text on the clipboard, and say so on the button. */
export async function copy(button) {
  const what = button.dataset.copies;
  const text = what === "link" ? `${location.href.replace(/#.*/, "")}#${heapLink() ?? hashOf(answer.view)}` : at(what).textContent;
  const before = button.textContent;
  try {
    if (navigator.clipboard) await navigator.clipboard.writeText(text);
    else copyOldWay(text);
    button.textContent = "Copied";
  } catch {
    button.textContent = "Not allowed here";
  }
  setTimeout(() => (button.textContent = before), 1500);
}

/** Browsers lend the clipboard only to pages of the same machine, or over https. */
function copyOldWay(text) {
  const area = document.createElement("textarea");
  area.value = text;
  document.body.append(area);
  area.select();
  const isDone = document.execCommand("copy");
  area.remove();
  if (!isDone) throw new Error("not copied");
}

// -- The beginning ---------------------------------------------------------------------------------------------------

/** Show the view of the address; one with a mistake is told of, and the first view is shown. */
async function begin() {
  const hash = location.hash.slice(1) || location.search.slice(1);
  if (asksForHeap(hash)) {
    leave();
    openHeap(hash);
    return;
  }
  closeHeap();
  measure();
  let notice = "";
  try {
    const view = viewAt(hash);
    if (!exact.knows(view)) {
      await exact.learn();
      measure();
    }
    showAnswer(answerTo(view, exact, answer));
  } catch (error) {
    if (!(error instanceof RangeError || error.constructor === Error)) throw error;
    notice = error.message;
    showAnswer(answerTo(FIRST_VIEW, exact, answer));
  }
  if (notice) fill(at("notices"), `<p>${plainText(notice)}</p>`);
  fitting ??= fitPanel({ answerNow: () => answer, change, solver: exact, module: MODULE, save });
}

/** The pair goes out of sight: its address is kept in its link, and the address of the page is left alone. */
function leave() {
  clearTimeout(waiting);
  if (answer) at("to-pair").href = `#${hashOf(answer.view)}`;
}

/** The settings of the view that is open get the focus; the address, which holds the view, stays. */
function skip(event) {
  event.preventDefault();
  at(heapLink() === undefined ? "settings" : "heap-settings")?.focus();
}

/** What the page computes, for the console of a browser. */
window.explorer = {
  picture: () => picture,
  fit: () => fitting.found(),
  learn: exact.learn,
  answerAt(hash) {
    const answer = answerTo(viewAt(hash), exact);
    const { question, state, rupture, lowerEnd } = answer;
    const laws = lawsAt(answer, exact).map(({ law, ...told }) => ({ law: law.name, ...told }));
    return { question, state, rupture, lowerEnd, laws };
  },
};

layOut();
await begin();
listen();
if ("serviceWorker" in navigator && location.protocol.startsWith("http"))
  navigator.serviceWorker.register("offline.js");
