// What the solver and the laws say to the question of a view: all that the page shows.

import { humidityFromSuction, suctionFromHumidity } from "./liquids.mjs";
import { RECORDS } from "./records.mjs";
import { rounded, signed } from "./units.mjs";
import { questionOf } from "./view.mjs";

const CURVE_POINTS = 97; // enough to look smooth at the width of a screen
const STABLE_POINTS = 33; // of its stable part alone
const SLOW = 8; // time for a whole curve, half a frame, from which on a moving hand is shown its stable part alone, [ms]
const LAW_POINTS = 97;
const OTHER_POINTS = 33; // of a law of the other control, which needs an exact bridge for each
const BEYOND = 1.3; // over the exact rupture distance: where a law that knows none is drawn to
const SAME = 1e-6; // by how much the forces of two answers for one bridge may differ
const SLACK = 1e-12; // of an angle of 40° in radians, say

/**
 * The answer to a view; what does not depend on the separation is taken from the answer before, if that had it. While a
 * hand moves, the curve may lack its unstable part, which takes longer than all the rest: `branch.isWhole` tells.
 */
export function answerTo(view, solver, before, isMoving = false) {
  const question = questionOf(view);
  const { pair, degrees, held, control } = question;
  const key = JSON.stringify([pair.radius.map(String), pair.solids ?? null, degrees, held, control]);
  const isKnown = before?.branch.key === key && (before.branch.isWhole || isMoving);
  const branch = isKnown ? before.branch : branchOf(question, solver, key, isMoving);
  const state = unlessFailed(() => solver.bridge(question.pair, question.separation, question.held), undefined);
  const answer = { view, question, branch, ...branch, state: state ?? null, isFailure: state === undefined };
  answer.drawn = drawnLaws(answer, solver);
  answer.notices = noticesOf(answer, solver);
  return answer;
}

let timeOfCurve = 0; // that the last whole one took, [ms]

function branchOf(question, solver, key, isMoving) {
  const { pair, held } = question;
  const rupture = unlessFailed(() => solver.rupture(pair, held), null);
  const lowerEnd = rupture ? unlessFailed(() => solver.lowerEnd(pair, held), null) : null;
  const isShort = isMoving && timeOfCurve > SLOW && rupture && !question.arePlanes && !pair.solids;
  const states = isShort ? stableCurve(question, rupture, lowerEnd, solver) : wholeCurve(question, rupture, solver);
  return { key, rupture, lowerEnd, isWhole: !isShort, curve: states.filter((state) => state !== null), lawCurves: new Map() };
}

function wholeCurve({ pair, held }, rupture, solver) {
  const began = performance.now();
  const states = rupture ? unlessFailed(() => solver.curve(pair, held, CURVE_POINTS), []) : [];
  timeOfCurve = performance.now() - began;
  return states;
}

/** Bridges from contact, or the lower end, to rupture, dense there, where the curve is steep. */
function stableCurve({ pair, held }, rupture, lowerEnd, solver) {
  const first = lowerEnd?.separation ?? 0;
  const share = (i) => 1 - (1 - i / STABLE_POINTS) ** 2;
  const gaps = Array.from({ length: STABLE_POINTS }, (_, i) => first + (rupture.separation - first) * share(i));
  return [...unlessFailed(() => solver.bridges(pair, gaps, held), []), rupture];
}

/** What the solver answers, or another thing where it failed: that is no mistake of who asked. */
export function unlessFailed(ask, otherwise) {
  try {
    return ask();
  } catch (error) {
    if (error.constructor !== Error) throw error;
    return otherwise;
  }
}

// -- Laws ------------------------------------------------------------------------------------------------------------

/** What the laws are asked with: contact angles and κ of both solids. */
const solidsOf = ({ pair, meanRadius }) => [...pair.contactAngle, ...pair.radius.map((radius) => meanRadius / radius)];

const ownControl = (law, question) => (law.control === "volume") === (question.control === "volume");

/** What a law of the other control is asked with at an exact bridge; NaN where no law of it speaks of that bridge. */
function otherControl(question, state, solver) {
  if (!state) return NaN;
  if (question.control !== "volume") return state.volume / question.meanRadius ** 3;
  if (!(state.suction > 0)) return NaN;
  const held = { surfaceTension: question.held.surfaceTension, suction: state.suction };
  const drained = unlessFailed(() => solver.bridge(question.pair, state.separation, held), null);
  const isHeld = drained !== null && Math.abs(drained.force - state.force) <= SAME * Math.abs(state.force);
  return isHeld ? (state.suction * question.meanRadius) / question.held.surfaceTension : NaN;
}

function controlStar({ held, meanRadius, control }) {
  return control === "volume" ? held.volume / meanRadius ** 3 : (held.suction * meanRadius) / held.surfaceTension;
}

const forceUnit = ({ held, meanRadius }) => 2 * Math.PI * held.surfaceTension * meanRadius;

/** Force of a law where there is an exact bridge, [N]; NaN where it says nothing, or does not speak of the solids. */
export function forceOfLaw(law, question, state, solver) {
  if (question.pair.solids || uncovered(law, "force", question)) return NaN;
  const control = ownControl(law, question) ? controlStar(question) : otherControl(question, state, solver);
  const gap = state.separation / question.meanRadius;
  return forceUnit(question) * solver.laws[law.name].force(gap, control, ...solidsOf(question));
}

/** Laws that are laid over the force, each with its place among all and its curve. */
function drawnLaws({ view, question, rupture, lawCurves }, solver) {
  const wanted = RECORDS.laws.map((law, place) => ({ law, place })).filter(({ law }) => view.laws.includes(law.name));
  return wanted.map(({ law, place }) => {
    if (!lawCurves.has(law.name)) lawCurves.set(law.name, lawCurve(law, question, rupture, solver));
    return { law, place, curve: lawCurves.get(law.name) };
  });
}

/** What all laws say at a state. */
export const lawsAt = (answer, solver) => RECORDS.laws.map((law) => lawAt(law, answer, solver));

/** Errors of a law at a state, and whether it is asked outside of its range. */
function lawAt(law, answer, solver) {
  const { question, state, rupture } = answer;
  const told = { law, forceError: NaN, ruptureError: NaN, outside: "" };
  if (question.arePlanes) return { ...told, outside: "two planes are none of its solids" };
  if (question.pair.solids) return { ...told, outside: "it is for spheres and planes" };
  const solids = solidsOf(question);
  const isOwn = ownControl(law, question);
  const functions = solver.laws[law.name];
  const reasons = [];
  const covers = (quantity) => {
    const why = uncovered(law, quantity, question);
    if (why) reasons.push(why);
    return !why;
  };
  if (functions.force && state && covers("force")) {
    answer.other ??= otherControl(question, state, solver);
    const control = isOwn ? controlStar(question) : answer.other;
    const gap = question.separation / question.meanRadius;
    const force = forceUnit(question) * functions.force(gap, control, ...solids);
    told.forceError = force / state.force - 1;
    reasons.push(outside(law, "force", { separation_star: gap, [`${law.control}_star`]: control }, question));
    if (Number.isNaN(force))
      reasons.push(isOwn ? "it says nothing of this bridge" : `no ${law.control} that it knows holds this bridge`);
  }
  if (functions.rupture && isOwn && covers("rupture")) {
    const control = controlStar(question);
    if (rupture)
      told.ruptureError = (functions.rupture(control, ...solids) * question.meanRadius) / rupture.separation - 1;
    reasons.push(outside(law, "rupture", { [`${law.control}_star`]: control }, question));
  }
  return { ...told, outside: reasons.find(Boolean) ?? "" };
}

function lawCurve(law, question, rupture, solver) {
  const functions = solver.laws[law.name];
  if (!functions.force || question.arePlanes || question.pair.solids || uncovered(law, "force", question)) return [];
  const isOwn = ownControl(law, question);
  const solids = solidsOf(question);
  const last =
    functions.rupture && isOwn ? functions.rupture(controlStar(question), ...solids) * question.meanRadius : NaN;
  const reach = last > 0 ? last : (rupture?.separation ?? NaN) * (isOwn ? BEYOND : 1);
  if (!Number.isFinite(reach)) return [];
  const count = isOwn ? LAW_POINTS : OTHER_POINTS;
  // dense towards rupture, where forces are steep
  const gaps = Array.from({ length: count }, (_, i) => reach * Math.sin((0.5 * Math.PI * i) / (count - 1)));
  const states = isOwn ? [] : unlessFailed(() => solver.bridges(question.pair, gaps, question.held), []);
  return gaps.map((gap, i) => {
    const control = isOwn ? controlStar(question) : otherControl(question, states[i], solver);
    const said = forceUnit(question) * functions.force(gap / question.meanRadius, control, ...solids);
    return [gap, said === 0 ? NaN : said];
  });
}

/** Why a law does not speak of two solids; empty if it does. */
function uncovered(law, quantity, { pair }) {
  const { angles, plane, angleWords, sizeWords } = law.solids[quantity];
  const [first, second] = pair.contactAngle;
  const [low, high] = law.angleLimits;
  const says = (rule) => `its ${quantity} is for ${rule}`;
  if (Math.min(first, second) < low || Math.max(first, second) >= high)
    return says(`angles from ${degreesOf(low)}° to below ${degreesOf(high)}°`);
  if (first !== second && (angles === "equal" || angles === "zero")) return says(angleWords);
  if (first !== 0 && angles === "zero") return says(angleWords);
  if (plane === "none" && pair.radius.includes(Infinity)) return says(sizeWords);
  return "";
}

const degreesOf = (angle) => rounded((angle * 180) / Math.PI, 6);

const VARIABLES = {
  suction_star: "H*",
  volume_star: "V*",
  contact_angle: "θ",
  size_ratio: "size ratio",
  angle_difference: "difference of the angles",
  separation_star: "D*",
};

/** The first variable that leaves the range of a law, in words; empty if none does. */
function outside(law, quantity, asked, { pair }) {
  const { angles, spheres, plane } = law.solids[quantity];
  const [first, second] = pair.contactAngle;
  const ratio = Math.max(...pair.radius) / Math.min(...pair.radius);
  const knowsRatio = ratio === Infinity ? plane === "mean" : spheres === "mean";
  const variables = [
    ...Object.entries(asked),
    ["contact_angle", first],
    ["contact_angle", second],
    ["size_ratio", knowsRatio || law.knowsSizeRatio ? ratio : 1],
    ["angle_difference", angles.startsWith("mean") ? Math.abs(first - second) : 0],
  ];
  for (const [name, value] of variables) {
    const [low, high] = law.ranges[name] ?? [-Infinity, Infinity];
    if (value < low - SLACK * Math.abs(low) || value > high + SLACK * Math.abs(high)) {
      const isAngle = name === "contact_angle" || name === "angle_difference";
      const brief = (number) =>
        isAngle && Number.isFinite(number) ? shortest((number * 180) / Math.PI) : shortest(number);
      const unit = isAngle ? "°" : "";
      return `${VARIABLES[name]} = ${brief(value)}${unit}; the law is for ${rangeWords(low, high, brief)}${unit}`;
    }
  }
  return "";
}

function rangeWords(low, high, brief) {
  if (low === high) return brief(low);
  if (high === Infinity) return low === -Infinity ? "any" : `≥ ${brief(low)}`;
  return `${brief(low)} to ${brief(high)}`;
}

/** A number as short as it can be written: 0.01, 100, 1e4, 13.75. */
function shortest(value) {
  if (value === 0 || !Number.isFinite(value) || (Math.abs(value) >= 1e-3 && Math.abs(value) < 1e4))
    return signed(String(rounded(value, 4)));
  return signed(rounded(value, 4).toExponential().replace("e+", "e"));
}

/** A relative error in per cent, with two digits; exactly -1 is no bridge. */
export function percent(error) {
  if (Number.isNaN(error)) return "–";
  if (error === -1) return "no bridge";
  const value = 100 * error;
  const size = Math.abs(rounded(value, 2));
  const digits = size ? Math.max(0, 1 - Math.floor(Math.log10(size))) : 0;
  const text = digits < 6 ? value.toFixed(digits) : value.toExponential(1);
  return `${value >= 0 ? "+" : ""}${signed(text)}\u00a0%`;
}

// -- Notices ---------------------------------------------------------------------------------------------------------

/** Where the solver failed, the Kelvin equation is doubtful, or a humidity does not fix the force. */
function noticesOf({ question, state, isFailure }, solver) {
  if (isFailure)
    return [
      "The solver found no answer to this question, and nothing is known of this bridge." +
        (question.pair.solids ? " Its liquid may run over the edges of two discs, which is not answered." : ""),
    ];
  if (question.control !== "humidity" || !state) return [];
  const { doubtfulRadius, humidityUncertainty, largeChange } = RECORDS.kelvin;
  const told = [];
  const radius = question.held.surfaceTension / question.held.suction;
  if (radius < doubtfulRadius)
    told.push(
      `Curvature radius ${rounded(1e9 * radius, 3)} nm: the Kelvin equation is doubtful below ${rounded(1e9 * doubtfulRadius, 3)} nm.`,
    );
  const changes = [-1, 1].map((side) => {
    const humidity = Math.min(Math.max(question.value + side * humidityUncertainty, 1e-9), 1 - 1e-12);
    const held = { ...question.held, suction: suctionFromHumidity(humidity, question.liquid) };
    const moved = unlessFailed(() => solver.bridge(question.pair, question.separation, held), null);
    return Math.abs((moved?.force ?? 0) / state.force - 1);
  });
  const change = Math.max(...changes);
  if (change > largeChange)
    told.push(
      `An uncertainty of ${100 * humidityUncertainty} % RH changes the force by up to ${rounded(100 * change, 3)} %: ` +
        "control the suction or the volume instead.",
    );
  return told;
}

/** Value of another control at which the bridge is the same, NaN where there is none. */
export function heldInstead(control, { question, state }) {
  if (control === "humidity") {
    const suction = state?.suction ?? NaN;
    const humidity = humidityFromSuction(suction, question.liquid);
    return suction > 0 ? humidity : NaN;
  }
  return state ? state[control] : NaN;
}
