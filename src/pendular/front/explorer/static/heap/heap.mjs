// The view of the heap: what a change of one thing changes elsewhere.

import { followCurves, PATHS, suctionsBetween, wholeCurvesOf } from "./curves.mjs";
import { linesOf, packingNames } from "./grains.mjs";
import { heapAnswerTo, rangeOf, usualSuction } from "./heap_answer.mjs";
import { FARTHER, letPick, letTurn, NEARER } from "./heap_hands.mjs";
import { lengthBar, paintHeap, paintSlowly, writePicture } from "./heap_picture.mjs";
import { HEAP_RECORDS } from "./heap_records.mjs";
import { FIRST_HEAP, heapAt, heapHashOf, OWN, plotted, seenAfter } from "./heap_view.mjs";
import {
  heapCsvOf,
  heapInWords,
  heapNumbersOf,
  heapProgramOf,
  heapSpoken,
  heapTilesOf,
  radiiInWords,
} from "./heap_words.mjs";
import { takeGrains } from "./own_grains.mjs";
import { retentionChartOf } from "./retention_chart.mjs";
import { fieldBox, markRight, markWrong } from "../fields.mjs";
import { choice, copy, exact, fill, options, save } from "../main.mjs";
import { positionOf, trackOf, valueAt, written } from "../tracks.mjs";
import { show } from "../units.mjs";
import { plainText } from "../words.mjs";

const LABELS = {
  suction: "Suction",
  radius: "Mean radius",
  "contact-angle": "Contact angle",
  liquid: "Liquid",
  temperature: "Temperature",
  "surface-tension": "Surface tension",
};
const PLACES = {
  control: ["suction"],
  grains: ["radius"],
  angle: ["contact-angle"],
  liquid: ["liquid", "temperature", "surface-tension"],
};
const [BY_NAME, GIVEN] = ["by name", "surface tension"];
const WORDS = { loose: "random, loose", close: "random, close", mixed: "random, of sizes 1 to 2", own: "as pasted" };
const CURVE_POINTS = 41;
const SUCTION_STEPS = 320;
const LITTLE = 80; // between two changes of tables and texts while a hand moves, [ms]
const PAUSE = 250; // after the last change: what is slow, or speaks, waits so long, [ms]
const FINE = 2; // pixels of a still picture for each of a moving one

const at = (id) => document.getElementById(`heap-${id}`);
const fields = {};
const sizes = { canvas: [0, 0], chart: [0, 0] };
let answer; // what is shown
let own; // grains that were pasted: their text, its unit
let curves; // of the setting that was followed last
let followed;
let inner; // sides of the chart
let stopCurves = () => {};
let stopFine = () => {};
let ahead; // the view to be shown in the next frame, and the field that asked for it
let soon;
let waiting;
let isOpen = false;

// -- Laying out -------------------------------------------------------------------------------------------------------

function layOut() {
  const style = document.createElement("style");
  style.textContent = HEAP_RECORDS.style;
  document.head.append(style);
  const main = document.createElement("main");
  main.id = "heap-view";
  main.innerHTML = HEAP_RECORDS.html;
  document.getElementById("pair-view").after(main);
  for (const [place, names] of Object.entries(PLACES))
    for (const name of names) at(`fields-${place}`).append(fieldNamed(name));
  choice("heap-path", PATHS, (path) => change("suction", { path }));
  choice("heap-packing", [...packingNames(), OWN], takePacking);
  choice("heap-source", [BY_NAME, GIVEN], giveLiquid);
  options(
    "heap-plot",
    plotted().map((name) => [name, name.replaceAll("_", " ")]),
  );
}

function fieldNamed(name) {
  const made = fieldBox(`heap-${name}`, LABELS[name], name === "liquid" ? "liquids" : "");
  fields[name] = made;
  made.text.addEventListener("change", () => {
    const typed = made.text.value.trim();
    if (made.isRefused || typed !== answer.view[name]) change(name, { [name]: typed });
  });
  made.slider?.addEventListener("input", () => {
    const value = valueAt(trackNamed(name), made.slider.valueAsNumber);
    change(name, { [name]: written(name, value, name === "suction" ? 4 : 3) });
  });
  return made.field;
}

const trackNamed = (name) =>
  name === "suction" ? { ...rangeOf(answer), steps: SUCTION_STEPS, spacing: "logarithmic" } : trackOf(name, {});

function valueNamed(name) {
  const { question } = answer;
  if (name === "temperature") return question.liquid.temperature ?? NaN;
  const values = { suction: question.suction, radius: question.heap.meanRadius, "contact-angle": question.degrees };
  return values[name] ?? question.liquid.surfaceTension;
}

// -- What a person does -----------------------------------------------------------------------------------------------

function listen() {
  at("plot").addEventListener("change", (event) => change("suction", { plot: event.target.value }));
  at("clear").addEventListener("change", (event) =>
    change("suction", { grains: event.target.checked ? "clear" : "solid" }),
  );
  at("condensation").addEventListener("change", (event) =>
    change("suction", { condensation: event.target.checked ? "yes" : "no" }),
  );
  takeGrains(at, useOwn);
  const seenNow = () => ahead?.view.seen ?? answer.view.seen;
  letTurn(at("canvas"), seenNow, (seen) => change("suction", { seen }));
  at("nearer").addEventListener("click", () => change("suction", { seen: seenAfter(seenNow(), NEARER) }));
  at("farther").addEventListener("click", () => change("suction", { seen: seenAfter(seenNow(), FARTHER) }));
  at("first").addEventListener("click", () => change("suction", { seen: FIRST_HEAP.seen }));
  const goTo = (suction) => change("suction", { suction: written("suction", suction, 4) });
  letPick(at("chart"), at("readout"), () => inner, goTo);
  at("save-curve").addEventListener("click", () => save("retention.csv", "text/csv", heapCsvOf(wholeCurves())));
  at("save-grains").addEventListener("click", () => save("grains.txt", "text/plain", linesOf(answer.question.heap)));
  at("save-program").addEventListener("click", () => save("heap.py", "text/x-python", program()));
  at("save-picture").addEventListener("click", savePicture);
  for (const button of document.querySelectorAll("#heap-view [data-copies]"))
    button.addEventListener("click", () => copy(button));
  const observer = new ResizeObserver(() => {
    if (!isOpen || !answer) return;
    measure();
    drawSized();
  });
  for (const id of Object.keys(sizes)) observer.observe(at(id));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => isOpen && answer && drawSized());
}

function takePacking(packing) {
  if (packing !== OWN || own) change("radius", { packing });
  else {
    showFields();
    at("own").open = true;
    at("text").focus();
  }
}

/** Show the heap with pasted grains; RangeError if they are none. */
function useOwn(grains) {
  const view = { ...answer.view, packing: OWN };
  const suction = usualSuction(view, grains); // where that of the view is far from what holds bridges between them
  if (suction !== undefined) view.suction = written("suction", suction, 3);
  showHeap(heapAnswerTo(view, grains, exact, answer));
  own = grains;
  if (suction !== undefined && fields.suction.isRefused) markRight(fields.suction);
}

function giveLiquid(source) {
  const tension = written("surface-tension", answer.question.liquid.surfaceTension, 4);
  change("surface-tension", { "surface-tension": source === GIVEN ? tension : "" });
}

// -- What follows from it ---------------------------------------------------------------------------------------------

/** Show another view in the next frame: a fast hand never runs ahead of a slow machine. */
function change(field, changes) {
  const isFirst = ahead === undefined;
  ahead = { view: { ...(ahead?.view ?? answer.view), ...changes }, field };
  if (isFirst) requestAnimationFrame(showAhead);
}

function showAhead() {
  const { view, field } = ahead;
  ahead = undefined;
  try {
    showHeap(heapAnswerTo(view, own, exact, answer));
  } catch (error) {
    if (!(error instanceof RangeError || error.constructor === Error)) throw error; // of the solver, which failed
    markWrong(fields[field], view[field], error);
    showFields();
    return;
  }
  if (fields[field].isRefused) markRight(fields[field]);
  showFields();
}

function showHeap(next) {
  answer = next;
  if (answer.setting !== followed) {
    followed = answer.setting;
    curves = undefined;
    stopCurves();
    stopCurves = followCurves(followed, suctions(), exact, (found) => {
      curves = found;
      drawChart();
      later();
    });
  }
  fill(at("tiles"), heapTilesOf(answer));
  fill(at("notices"), answer.notices.map((notice) => `<p>${plainText(notice)}</p>`).join(""));
  drawSized();
  showFields();
  later();
}

function suctions() {
  const { low, high } = rangeOf(answer);
  return suctionsBetween(low, high, CURVE_POINTS);
}

function drawSized() {
  drawChart();
  drawHeap();
}

function drawChart() {
  const chart = retentionChartOf(answer, curves, rangeOf(answer), ...sizes.chart);
  inner = chart.inner;
  fill(at("chart-lines"), chart.svg);
  fill(at("chart-now"), chart.now);
  at("chart").setAttribute("aria-label", chart.words);
}

/** Size of the picture with so many pixels for each of the page. */
function pixelsBy(fineness) {
  const [columns, rows] = sizes.canvas.map((size) => Math.max(1, Math.round(fineness * size)));
  return { columns, rows, isFine: fineness > 1 };
}

function drawHeap() {
  stopFine();
  paintHeap(at("canvas"), answer, exact, pixelsBy(1));
  at("canvas").setAttribute("aria-label", heapInWords(answer));
  fill(at("bar"), lengthBar(answer, ...sizes.canvas));
}

function drawFine() {
  stopFine();
  stopFine = paintSlowly(at("canvas"), answer, exact, pixelsBy(FINE));
}

/** Sizes are kept: to ask for them in each frame would lay out the page twice. */
function measure() {
  for (const id of Object.keys(sizes)) sizes[id] = [at(id).clientWidth, at(id).clientHeight];
}

/** What nobody waits for: tables and texts follow a little later, fine picture and address when the hand rests. */
function later() {
  if (!isOpen) return; // the address is another view's
  soon ??= setTimeout(() => {
    soon = undefined;
    fill(at("numbers"), heapNumbersOf(answer, curves));
    at("program").textContent = program();
  }, LITTLE);
  clearTimeout(waiting);
  waiting = setTimeout(() => {
    at("spoken").textContent = heapSpoken(answer);
    history.replaceState(null, "", `#${heapHashOf(answer.view)}`);
    document.getElementById("to-heap").href = `#${heapHashOf(answer.view)}`;
    drawFine();
  }, PAUSE);
}

function showFields() {
  const { view, question } = answer;
  const checked = { "heap-path": view.path, "heap-packing": view.packing };
  checked["heap-source"] = view["surface-tension"] === "" ? BY_NAME : GIVEN;
  for (const [name, value] of Object.entries(checked))
    for (const radio of document.querySelectorAll(`[name=${name}]`)) radio.checked = radio.value === value;
  at("plot").value = view.plot;
  at("clear").checked = view.grains === "clear";
  at("condensation").checked = view.condensation === "yes";
  fields.radius.field.hidden = view.packing === OWN;
  fields.liquid.field.hidden = fields.temperature.field.hidden = view["surface-tension"] !== "";
  fields["surface-tension"].field.hidden = view["surface-tension"] === "";
  const { heap } = question;
  at("discs").hidden = !heap.cell;
  fill(
    at("packing-words"),
    `${WORDS[view.packing]}: ${heap.count} grains of radius ${radiiInWords(heap)}, solid fraction ${show(1 - answer.values.porosity, "", 3)}${heap.cell ? "; the cell repeats" : ""}`,
  );
  for (const [name, field] of Object.entries(fields)) showField(name, field);
}

function showField(name, { text, slider, isRefused }) {
  if (isRefused) return;
  if (text !== document.activeElement || text.value.trim() !== answer.view[name]) text.value = answer.view[name];
  if (!slider) return;
  const track = trackNamed(name);
  slider.max = track.steps;
  // the slider in use is ahead of what is rounded in its field
  const value = valueNamed(name);
  if (slider !== document.activeElement && Number.isFinite(value)) slider.value = Math.round(positionOf(track, value));
  slider.setAttribute("aria-valuetext", answer.view[name]);
}

// -- To take away -----------------------------------------------------------------------------------------------------

const program = () => heapProgramOf(answer, rangeOf(answer), CURVE_POINTS);

/** The curves, followed at once where they are not there yet. */
const wholeCurves = () => curves ?? wholeCurvesOf(answer.setting, suctions(), exact);

function savePicture() {
  writePicture(answer, exact, (content) => save("heap.png", "image/png", content));
  drawFine(); // the pictures share one room
}

// -- In and out of sight ----------------------------------------------------------------------------------------------

/** Show the view of an address; one with a mistake is told of, and the first view is shown. */
function open(hash) {
  isOpen = true;
  measure();
  let notice = "";
  try {
    showHeap(heapAnswerTo(heapAt(hash), own, exact, answer));
  } catch (error) {
    if (!(error instanceof RangeError)) throw error;
    notice = error.message;
    showHeap(heapAnswerTo(FIRST_HEAP, own, exact, answer));
  }
  if (notice) fill(at("notices"), `<p>${plainText(notice)}</p>`);
}

function close() {
  isOpen = false;
  clearTimeout(waiting);
  stopFine();
}

/** The view, laid out. */
export function makeHeap() {
  layOut();
  listen();
  return { open, close, hash: () => heapHashOf(answer.view) };
}
