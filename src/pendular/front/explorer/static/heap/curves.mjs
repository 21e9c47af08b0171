// Retention of a heap: its state along the main drying and wetting branches, and the suction at which bridges meet.

import { unlessFailed } from "../answer.mjs";
import { answersAt, meetingsOf, membersOf, settingOfRows, wettedOf } from "./wetted.mjs";

export const PATHS = ["drying", "wetting"];
const UNKNOWN = { stress: Array(6).fill(NaN) }; // where the solver failed
const PRECISION = 1e-9; // of the suction at which bridges meet, as in the package
const SLICE = 8; // time in one go, [ms], so that a hand on a slider is not felt

/** Suctions from one to another, evenly in their logarithm, [Pa]. */
export function suctionsBetween(low, high, count) {
  return Array.from({ length: count }, (_, i) => low * (high / low) ** (i / (count - 1)));
}

/** The state on both branches at a suction. */
export function statesAt(setting, suction, solver) {
  const answers = unlessFailed(() => answersAt(setting, suction, solver), null);
  if (!answers) return Object.fromEntries(PATHS.map((path) => [path, UNKNOWN]));
  return Object.fromEntries(PATHS.map((path) => [path, wettedOf(setting, answers, membersOf(answers, path))]));
}

/** Follow both branches by and by; returns a function that stops it. `done` is told the states and the limits. */
export function followCurves(setting, suctions, solver, done) {
  const states = [];
  let timer;
  const goOn = () => {
    const until = performance.now() + SLICE;
    while (states.length < suctions.length && performance.now() < until)
      states.push(statesAt(setting, suctions[states.length], solver));
    if (states.length < suctions.length) timer = setTimeout(goOn);
    else done(curvesOf(setting, suctions, states, solver));
  };
  timer = setTimeout(goOn);
  return () => clearTimeout(timer);
}

/** Both branches, followed at once. */
export const wholeCurvesOf = (setting, suctions, solver) =>
  curvesOf(
    setting,
    suctions,
    suctions.map((suction) => statesAt(setting, suction, solver)),
    solver,
  );

function curvesOf(setting, suctions, states, solver) {
  const branches = Object.fromEntries(PATHS.map((path) => [path, states.map((state) => state[path])]));
  const limits = Object.fromEntries(
    PATHS.map((path) => [path, unlessFailed(() => limitOf(setting, suctions, branches[path], path, solver), NaN)]),
  );
  return { suctions, branches, limits };
}

/**
 * Suction below which bridges meet, NaN if it is not between two of the suctions, [Pa]. Half-filling angles fall with
 * the suction and no bridge is added, so that those count alone that meet at the lower suction.
 */
function limitOf(setting, suctions, states, path, solver) {
  const last = states.findLastIndex((state) => state.meeting_grains > 0);
  if (last < 0 || last === states.length - 1) return NaN;
  let [low, high] = [suctions[last], suctions[last + 1]];
  let few = settingOfRows(setting, meetingAt(setting, low, path, solver));
  while (high / low - 1 > PRECISION) {
    const middle = Math.sqrt(low * high);
    const met = meetingAt(few, middle, path, solver);
    if (met.length) [few, low] = [settingOfRows(few, met), middle];
    else high = middle;
  }
  return low;
}

function meetingAt(setting, suction, path, solver) {
  const answers = answersAt(setting, suction, solver);
  return meetingsOf(setting, answers, membersOf(answers, path)).rows;
}
