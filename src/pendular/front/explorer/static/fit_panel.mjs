// The panel of a measured curve: it is pasted, fitted beside the page by a worker, and its bridge is shown.

import { curveOf, tableOf } from "./curve_text.mjs";
import { fitChartOf } from "./fit_chart.mjs";
import { fitCommandOf, fitCsvOf, fitProgramOf, fitWords, paragraphs } from "./fit_words.mjs";
import { suctionFromHumidity } from "./liquids.mjs";
import { RECORDS } from "./records.mjs";
import { written } from "./tracks.mjs";
import { readQuantity } from "./units.mjs";
import { FIRST_VIEW } from "./view.mjs";
import { plainText } from "./words.mjs";

const CHOSEN_FIRST = ["contact_angle", "contact_angle1", "contact_angle2", "volume", "suction", "humidity", "offset"];
const OF_THE_GAUGE = ["offset", "force_zero", "force_scale", "base_slope"];
const LOSS_WORDS = {
  linear: "squares",
  soft_l1: "soft_l1, heeds outliers less",
  huber: "huber, heeds outliers less",
  cauchy: "cauchy, hardly heeds outliers",
};
const SHOWN_DIGITS = 5;

/**
 * Make the panel. It is given the answer that is shown, a way to change the view, the solver and its bytes, and a way to
 * save a file; it gives back what has to be called when another answer is shown.
 */
export function fitPanel({ answerNow, change, solver, module, save }) {
  const place = (id) => document.getElementById(`fit-${id}`);
  const state = { table: null, curve: null, free: new Map(), fit: null, asked: null, worker: null, size: [0, 0] };

  // -- The curve

  const curveText = place("text");
  const forgetFit = () => {
    stopFit();
    state.fit = null;
    place("found").hidden = place("take").hidden = true;
  };

  function readText() {
    forgetFit();
    [state.table, state.curve] = [null, null];
    place("columns").hidden = true;
    tellWrong("text", "");
    if (curveText.value.trim())
      try {
        const before = columnsChosen();
        state.table = tableOf(curveText.value);
        offerColumns(before);
        state.curve = curveOf(state.table, columnsChosen(), place("attraction").value === "negative" ? -1 : 1);
      } catch (error) {
        if (!(error instanceof RangeError)) throw error;
        tellWrong("text", error.message);
      }
    drawCurve();
    offerFree();
  }

  /** Columns can be chosen where there are more than two. */
  function offerColumns(before) {
    place("columns").hidden = state.table.length < 3;
    const choices = state.table.map(({ name, unit }, i) => {
      const words = `${name || `column ${i + 1}`}${unit && ` (${unit})`}`;
      return `<option value="${i}">${plainText(words)}</option>`;
    });
    for (const [i, which] of ["separation", "force"].entries()) {
      place(`column-${which}`).innerHTML = `<option value="">by its name</option>${choices.join("")}`;
      if (before[i] < state.table.length) place(`column-${which}`).value = before[i];
    }
  }

  const columnsChosen = () =>
    ["separation", "force"].map((which) => {
      const { value } = place(`column-${which}`);
      return value === "" ? undefined : Number(value);
    });

  async function openFile(file) {
    const text = await file.text();
    if (text.includes("\0")) {
      tellWrong("text", `curve: '${file.name}' is no text; files of instruments are read by pendular fit`);
      return;
    }
    curveText.value = text;
    for (const which of ["separation", "force"]) place(`column-${which}`).value = "";
    readText();
  }

  /** A curve that is made here, of a bridge that is known, with noise. */
  function giveExample() {
    const water = { kind: "sphere", kind2: "sphere", radius: "1 mm", radius2: "1 mm", "contact-angle": "10°", "contact-angle2": "" };
    const liquid = { liquid: FIRST_VIEW.liquid, temperature: FIRST_VIEW.temperature, "surface-tension": "" };
    change("value", { ...water, ...liquid, control: "volume", value: "5 nL", separation: "50 µm" });
    curveText.value = exampleText(solver);
    place("attraction").value = "positive";
    place("rupture").value = "jump";
    place("error").value = "";
    for (const which of ["separation", "force"]) place(`column-${which}`).value = "";
    state.free.clear();
    readText();
    showRupturePlace();
  }

  // -- What is asked

  /** What may be free of the solids, the liquid and the gauge, as they are. */
  function namesOffered() {
    const { question } = answerNow();
    const { radius } = question.pair;
    const planes = radius.filter((one) => one === Infinity).length;
    const isOne = planes === 1 || radius[0] === radius[1];
    const radii = isOne ? ["radius"] : ["radius1", "radius2"];
    const angles =
      question.degrees[0] === question.degrees[1] ? ["contact_angle"] : ["contact_angle1", "contact_angle2"];
    const rates = question.control === "volume" && state.curve?.time ? ["evaporation_rate"] : [];
    return [...angles, question.control, "surface_tension", ...(planes === 2 ? [] : radii), ...OF_THE_GAUGE, ...rates];
  }

  const isFree = (name) => state.free.get(name) ?? CHOSEN_FIRST.includes(name);

  function offerFree() {
    const names = namesOffered();
    const html = names.map(
      (name) => `<label><input type="checkbox" value="${name}"> ${name.replaceAll("_", " ")}</label>`,
    );
    if (place("free").dataset.names !== names.join()) place("free").innerHTML = html.join("");
    place("free").dataset.names = names.join();
    for (const tick of place("free").querySelectorAll("input")) tick.checked = isFree(tick.value);
  }

  const showRupturePlace = () => (place("rupture-place").hidden = place("rupture").value !== "at");

  /** The request to the worker, and what the texts to take away need beside it. */
  function requestNow() {
    const { question, view } = answerNow();
    if (!state.curve) throw new RangeError("curve: there is none yet; paste one, or open a file");
    const kind = place("rupture").value;
    const at = place("rupture-at").value.trim();
    const ruptures = { none: null, jump: "jump", end: "end" };
    const rupture = kind === "at" ? readQuantity("rupture", at, "m", "0.3mm") : ruptures[kind];
    const errorText = place("error").value.trim();
    const error = errorText ? readQuantity("force-error", errorText, "N", "1nN") : undefined;
    if (error !== undefined && !(error > 0)) throw new RangeError(`force-error: ${error} N is not > 0`);
    const { separation, force, time } = state.curve;
    const forceError = error === undefined ? state.curve.forceError : force.map(() => error);
    const wrong = forceError?.find((one) => !(one > 0));
    if (wrong !== undefined) throw new RangeError(`force-error: ${wrong} N is not > 0`);
    const free = namesOffered().filter(isFree);
    const request = {
      ...{ separation, force, time, forceError, free, rupture },
      pair: question.pair,
      held: question.control,
      value: question.value,
      surfaceTension: question.liquid.surfaceTension,
      kelvin: question.control === "humidity" ? suctionFromHumidity(Math.exp(-1), question.liquid) : 1,
      loss: place("loss").value,
    };
    const chosen = columnsChosen();
    const isChosen = state.table.length > 2 && chosen.every((one) => one !== undefined);
    const columns = isChosen ? chosen.map((one) => state.table[one].name || String(one + 1)) : null;
    const taken = {
      view,
      question,
      columns,
      attraction: place("attraction").value,
      ruptureText: kind === "at" ? at.replaceAll(" ", "") : kind,
    };
    return [
      request,
      { ...request, ...taken, forceErrorText: errorText.replaceAll(" ", ""), isGivenError: error !== undefined },
    ];
  }

  // -- The fit

  function runFit() {
    stopFit();
    let request;
    try {
      [request, state.asked] = requestNow();
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      tellWrong("run", error.message);
      return;
    }
    tellWrong("run", "");
    place("status").textContent = "Fitting…";
    place("stop").hidden = false;
    state.worker = newWorker();
    state.worker.addEventListener("message", ({ data }) => {
      stopFit();
      if (data.wrong) tellWrong("run", data.wrong);
      else showFit(data.fit);
    });
    state.worker.addEventListener("error", (event) => {
      stopFit();
      tellWrong("run", `the fit failed: ${event.message}`);
    });
    state.worker.postMessage({ module, request });
  }

  function stopFit() {
    state.worker?.terminate();
    state.worker = null;
    place("stop").hidden = true;
    place("status").textContent = "";
  }

  function showFit(fit) {
    state.fit = fit;
    const { rows, lines, notes } = fitWords(fit);
    if (!fit.converged) notes.push("The search did not settle: what it found is no minimum for certain.");
    place("numbers").innerHTML = rows;
    place("lines").innerHTML = paragraphs(lines, "small") + paragraphs(notes, "note");
    place("command").textContent = fitCommandOf(state.asked);
    place("program").textContent = fitProgramOf(state.asked);
    place("found").hidden = place("take").hidden = false;
    place("status").textContent = `Fitted. ${notes[0] ?? ""}`;
    drawCurve();
    change("value", shownBy(fit, answerNow()));
  }

  function drawCurve() {
    const isSeen = state.curve !== null;
    place("chart").classList.toggle("empty", !isSeen);
    const [width, height] = state.size;
    if (!isSeen) {
      place("chart").innerHTML = "";
      place("chart").setAttribute("aria-label", "No measured curve yet");
    } else if (width) {
      const { svg, words } = fitChartOf(state.curve, state.fit, width, height);
      place("chart").innerHTML = svg;
      place("chart").setAttribute("aria-label", words);
    }
  }

  function tellWrong(id, words) {
    place(`wrong-${id}`).textContent = words;
    if (id !== "text") return;
    if (words) curveText.setAttribute("aria-invalid", "true");
    else curveText.removeAttribute("aria-invalid");
  }

  // -- The beginning

  place("loss").innerHTML = Object.keys(RECORDS.fitting.LOSSES)
    .map((name) => `<option value="${name}">${LOSS_WORDS[name] ?? name}</option>`)
    .join("");
  curveText.addEventListener("input", readText);
  curveText.addEventListener("dragover", (event) => event.preventDefault());
  curveText.addEventListener("drop", (event) => {
    const [file] = event.dataTransfer.files;
    if (!file) return;
    event.preventDefault();
    openFile(file);
  });
  place("open").addEventListener("click", () => place("file").click());
  place("file").addEventListener("change", () => {
    const [file] = place("file").files;
    if (file) openFile(file);
    place("file").value = "";
  });
  place("example").addEventListener("click", giveExample);
  for (const id of ["attraction", "column-separation", "column-force"]) place(id).addEventListener("change", readText);
  place("rupture").addEventListener("change", showRupturePlace);
  place("free").addEventListener("change", ({ target }) => state.free.set(target.value, target.checked));
  place("run").addEventListener("click", runFit);
  place("stop").addEventListener("click", stopFit);
  place("save-curve").addEventListener("click", () => save("curve.csv", "text/csv", curveText.value));
  place("save-fit").addEventListener("click", () => save("fit.csv", "text/csv", fitCsvOf(state.fit)));
  place("save-program").addEventListener("click", () => save("fit.py", "text/x-python", fitProgramOf(state.asked)));
  new ResizeObserver(() => {
    state.size = [place("chart").clientWidth, place("chart").clientHeight];
    drawCurve();
  }).observe(place("chart"));
  offerFree();
  drawCurve();
  return { follow: offerFree, found: () => state.fit };
}

let workerAddress; // of the code that waits in the page as a text, once it was needed

/** The fit beside the page. */
function newWorker() {
  const code = document.getElementById("fit-code").textContent;
  workerAddress ??= URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
  return new Worker(workerAddress);
}

/** Changes of the view that show the fitted bridge; its separation stays if there is a bridge, or is halfway to rupture. */
function shownBy({ numbers, held, values, ruptureSeparation }, { view, question }) {
  const text = (name, value) => written(name, value, SHOWN_DIGITS);
  const degrees = ["1", "2"].map((solid) => (180 / Math.PI) * numbers[`contact_angle${solid}`]);
  const changes = { "contact-angle": text("contact-angle", degrees[0]) };
  if (view["contact-angle2"]) changes["contact-angle2"] = text("contact-angle", degrees[1]);
  for (const [i, name] of ["radius", "radius2"].entries()) {
    const radius = numbers[`radius${i + 1}`];
    if (radius !== question.pair.radius[i]) changes[name] = text("radius", radius);
  }
  if (held.name in values) changes.value = text(held.name, held.value);
  if ("surface_tension" in values) changes["surface-tension"] = text("surface-tension", values.surface_tension);
  const reach = ruptureSeparation + numbers.offset;
  if (reach > 0 && question.separation > reach) changes.separation = written("separation", 0.5 * reach, 3);
  return changes;
}

// -- The example -----------------------------------------------------------------------------------------------------

const EXAMPLE = { radius: 1e-3, degrees: 28, volume: 1e-11, tension: 0.0728, shift: 3e-6, noise: 1e-6, points: 60 };

/** A made curve: 10 nL of water between two beads of 1 mm at 28°, with a noise of 1 µN and a zero that is 3 µm off. */
function exampleText(solver) {
  const { radius, degrees, volume, tension, shift, noise, points } = EXAMPLE;
  const pair = { radius: [radius, radius], contactAngle: (Math.PI / 180) * degrees };
  const water = { volume, surfaceTension: tension };
  const reach = 1.15 * solver.rupture(pair, water).separation;
  const gaps = Array.from({ length: points }, (_, i) => (reach * i) / (points - 1));
  const normal = normalNumbers(28);
  const rows = solver.bridges(pair, gaps, water).map((state, i) => {
    const force = (state?.force ?? 0) + noise * normal();
    return `${(1e6 * (gaps[i] - shift)).toFixed(2)},${(1e6 * force).toFixed(2)}`;
  });
  const told = "# made by Pendular: 10 nL of water between beads of 1 mm at 28 degrees, zero 3 um off, noise 1 uN";
  return [told, "separation (um),force (uN)", ...rows, ""].join("\n");
}

/** Normal numbers, the same at each visit; Marsaglia's xorshift and the polar form of Box and Muller. */
function normalNumbers(seed) {
  let word = seed;
  const uniform = () => {
    word ^= word << 13;
    word ^= word >>> 17;
    word ^= word << 5;
    return (word >>> 0) / 2 ** 32;
  };
  for (let i = 0; i < 20; i++) uniform(); // a small seed is forgotten
  return () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform());
}
