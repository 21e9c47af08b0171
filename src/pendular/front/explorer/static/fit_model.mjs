// The curve that is fitted and the force that is to be measured, with its rates; as fitting.question and fitting.model.

import { general } from "./general.mjs";
import { medianOf } from "./linear.mjs";
import { RECORDS } from "./records.mjs";
import { firstOffset, innerOf, outerOf, SOLIDS, unknownOf } from "./fit_unknowns.mjs";

const RULES = RECORDS.fitting;
const HELD_NAMES = ["volume", "suction", "humidity"];

export const rangeOfAll = (values) =>
  values.reduce(([low, high], one) => [Math.min(low, one), Math.max(high, one)], [Infinity, -Infinity]);

// -- The question ----------------------------------------------------------------------------------------------------

/** The measured curve, and which of its points count. */
export function dataOf({ separation, force, time, rupture }) {
  if (separation.length < 2) throw new RangeError("separation: a curve has at least 2 points");
  const [first, last] = rangeOfAll(separation);
  const height = Math.max(...rangeOfAll(force).map(Math.abs));
  if (!(last > first) || !(height > 0))
    throw new RangeError(`${last > first ? "force" : "separation"}: all values are the same`);
  const datum = ruptureOf(rupture, separation, force);
  const broken = separation.map((place) => datum !== null && place > datum[0]);
  if (!broken.includes(false)) throw new RangeError(`rupture: ${general(datum[0], 6)} m lies before all separations`);
  let end = -1; // the last bridge
  for (const [i, place] of separation.entries()) if (!broken[i] && (end < 0 || place > separation[end])) end = i;
  return {
    separation,
    force,
    time: time ?? separation.map(() => 0),
    broken,
    judged: separation.map((place, i) => broken[i] || place < separation[end]),
    lastTime: time?.[end] ?? 0,
    rupture: datum,
    steepness: (RULES.STEEP * height) / (last - first),
    farthest: separation[end],
    span: last - first,
    height,
  };
}

/** Separation of the rupture and its standard error, where it is a datum. */
function ruptureOf(rupture, separation, force) {
  if (rupture === null) return null;
  const order = separation.map((_, i) => i).sort((i, j) => separation[i] - separation[j]);
  const place = order.map((i) => separation[i]);
  const steps = place.slice(1).map((one, i) => one - place[i]);
  if (rupture === "end") {
    const [last, step] = [place.at(-1), steps.at(-1)];
    return [last + 0.5 * step, Math.max(step, 1e-9 * last) / RULES.OF_UNIFORM];
  }
  if (rupture !== "jump") return [rupture, medianOf(steps) / RULES.OF_UNIFORM];
  const drops = steps.map((_, i) => force[order[i]] - force[order[i + 1]]);
  const largest = drops.indexOf(Math.max(...drops));
  if (!(drops[largest] > RULES.CLEAR_JUMP * medianOf(drops.map(Math.abs))))
    throw new RangeError(
      `rupture: no clear jump of the force; the largest is ${general(drops[largest], 3)} N at ${general(place[largest], 6)} m`,
    );
  return [0.5 * (place[largest] + place[largest + 1]), steps[largest] / RULES.OF_UNIFORM];
}

/** The question and its unknowns: `held` names what is held, `value` is its guess, `kelvin` turns it into a suction. */
export function modelOf({ pair, held, value, surfaceTension, kelvin, free }, data) {
  const question = { ...RULES.INSTRUMENT };
  for (const [i, solid] of SOLIDS.entries()) {
    question[`radius${solid}`] = pair.radius[i];
    question[`contact_angle${solid}`] = pair.contactAngle[i];
  }
  const control = held === "volume" ? "volume" : "suction";
  question[control] = held === "humidity" ? -kelvin * Math.log(value) : value;
  question.surface_tension = surfaceTension;
  refuseFree(free, held, data);
  const near = data.separation.filter((_, i) => !data.broken[i]);
  const scales = { offset: data.span, force_zero: data.height, base_slope: data.height / data.span };
  scales.least = rangeOfAll(near)[0];
  const [begin, end] = rangeOfAll(data.time);
  if (free.includes("evaporation_rate")) scales.evaporation_rate = question.volume / Math.max(end - begin, 1e-300);
  if (free.includes("offset")) question.offset = firstOffset(question, scales);
  return { question, control, unknowns: free.map((name) => unknownOf(name, question, kelvin, scales)) };
}

/** Names of what is free, each once, and none that the control does not know. */
function refuseFree(free, held, data) {
  if (!free.length) throw new RangeError("free: nothing is; choose what is to be found");
  for (const name of free) {
    if (HELD_NAMES.includes(name) && name !== held)
      throw new RangeError(`free: '${name}' is not what is held, which is the ${held}`);
    if (name === "evaporation_rate" && held !== "volume")
      throw new RangeError(`free: 'evaporation_rate' is of a volume; what is held is the ${held}`);
  }
  const points = data.judged.filter(Boolean).length + (data.rupture !== null);
  if (free.length >= points)
    throw new RangeError(`free: ${free.length} numbers need more than ${points} points beside the last`);
}

// -- The model -------------------------------------------------------------------------------------------------------

/** Numbers of the question at values of the variables. */
export function numbersAt({ question, unknowns }, variables) {
  const moved = { ...question };
  for (const [i, unknown] of unknowns.entries()) {
    const value = unknown.kind === "humidity" ? Math.exp(variables[i]) : outerOf(unknown, variables[i]);
    for (const name of unknown.moves) moved[name] = value;
  }
  return moved;
}

/** Bounds of the variables. */
export function limitsOf({ unknowns }) {
  const ends = unknowns.map((one) => [innerOf(one, one.low), innerOf(one, one.high)]);
  return { low: ends.map((pair) => Math.min(...pair)), high: ends.map((pair) => Math.max(...pair)) };
}

const leftOf = ({ volume, evaporation_rate: rate }, time) => Math.max(volume - rate * time, RULES.LEAST_LEFT * volume);

const pairOf = (numbers) => ({
  radius: SOLIDS.map((solid) => numbers[`radius${solid}`]),
  contactAngle: SOLIDS.map((solid) => numbers[`contact_angle${solid}`]),
});

const liquidOf = (control, numbers, time) => ({
  surfaceTension: numbers.surface_tension,
  ...(control === "volume" ? { volume: leftOf(numbers, time) } : { suction: numbers.suction }),
});

/** An answer of the solver, null where it has none; what is no question remains a RangeError. */
function known(ask) {
  try {
    return ask();
  } catch (error) {
    if (error instanceof RangeError) throw error;
    return null;
  }
}

/** Force at each separation, its rates if they are wanted, and how many places the model does not reach. */
export function predictionOf(model, data, solver, variables, withRates) {
  const numbers = numbersAt(model, variables);
  const pair = pairOf(numbers);
  const count = data.separation.length;
  const force = new Float64Array(count);
  const rates = model.unknowns.map(() => new Float64Array(withRates ? count : 0));
  const isOut = new Uint8Array(count);
  for (let i = 0; i < count; i++) {
    if (data.broken[i]) continue;
    const liquid = liquidOf(model.control, numbers, data.time[i]);
    const state = known(() => solver.bridge(pair, data.separation[i] + numbers.offset, liquid));
    if (!state) {
      isOut[i] = 1;
      continue;
    }
    force[i] = state.force;
    if (!withRates) continue;
    const found = ratesOfNumbers(model, numbers, solver.forceRates(pair, state, liquid), state.force, data.time[i]);
    for (const [column, unknown] of model.unknowns.entries())
      rates[column][i] = unknown.moves.reduce((sum, name) => sum + (found[name] ?? 0), 0);
  }
  const ends = data.rupture !== null || isOut.includes(1) ? endsAt(model, data, solver, variables, withRates) : null;
  let unreached = 0;
  for (let i = 0; i < count; i++) {
    if (!isOut[i]) continue;
    const beyond = data.separation[i] + numbers.offset - ends.separation;
    if (beyond > 0) {
      force[i] = ends.force;
      if (withRates) for (const [column, rate] of ends.forceRates.entries()) rates[column][i] = rate;
    }
    if (!(beyond > 0 && beyond < RULES.TOUCHING * data.span)) unreached++;
  }
  return asMeasured(model, data, numbers, { force, rates, unreached, ends });
}

/** Rates of the force of the bridge in the variables of each number of the question. */
function ratesOfNumbers({ control, unknowns }, numbers, rates, force, time) {
  const found = {
    contact_angle1: rates.cosAngle1,
    contact_angle2: rates.cosAngle2,
    radius1: rates.logRadius1,
    radius2: rates.logRadius2,
    offset: rates.separation,
    surface_tension: force,
  };
  if (control === "volume") {
    const left = leftOf(numbers, time);
    const isLeft = left > RULES.LEAST_LEFT * numbers.volume;
    found.volume = rates.held * (isLeft ? numbers.volume : left);
    found.evaporation_rate = isLeft ? -rates.held * time : 0;
  } else {
    found.suction = rates.held * numbers.suction;
    found.surface_tension = force - found.suction;
  }
  for (const { kind, name, scale } of unknowns)
    if (kind === "linear" && name in found) found[name] = (name === "suction" ? rates.held : found[name]) * scale;
  return found;
}

/** Force on the scale of the instrument. */
function asMeasured({ unknowns }, { separation }, numbers, found) {
  const { force_scale: times, force_zero: zero, base_slope: slope } = numbers;
  const rates = unknowns.map(({ name, scale }, column) =>
    found.rates[column].map((rate, i) => {
      if (name === "force_scale") return times * found.force[i];
      if (name === "force_zero") return scale;
      if (name === "base_slope") return scale * separation[i];
      return times * rate;
    }),
  );
  return { ...found, rates, force: found.force.map((one, i) => times * one + zero + slope * separation[i]) };
}

/** Rupture distance and the force there; their rates by differences, for a pitchfork has no others. */
export function endsAt(model, data, solver, variables, withRates) {
  const at = (place) => {
    const numbers = numbersAt(model, place);
    const liquid = liquidOf(model.control, numbers, data.lastTime);
    const found = known(() => solver.rupture(pairOf(numbers), liquid));
    return { separation: found?.separation ?? 0, force: found?.force ?? 0 };
  };
  const here = at(variables);
  const besides = withRates ? model.unknowns.map((unknown, i) => besideOf(unknown, variables, i)) : [];
  const ends = besides.map(({ ahead, behind, width }) => {
    const [forth, back] = [at(ahead), at(behind)];
    return [(forth.separation - back.separation) / width, (forth.force - back.force) / width];
  });
  return { ...here, separationRates: ends.map(([rate]) => rate), forceRates: ends.map(([, rate]) => rate) };
}

/** Variables with one of them a step ahead, and a step behind; how far these are apart. */
function besideOf({ kind }, variables, i) {
  const most = kind === "cosine" ? 1 : Infinity;
  const [ahead, behind] = [Math.min(variables[i] + RULES.STEP, most), variables[i] - RULES.STEP];
  const placed = (value) => variables.map((one, j) => (i === j ? value : one));
  return { ahead: placed(ahead), behind: placed(behind), width: ahead - behind };
}

/** Force that a fit foretells at measured separations; NaN-free: 0 of a bridge where there is none. */
export function foretoldForce(model, solver, numbers, separations) {
  const [pair, liquid] = [pairOf(numbers), liquidOf(model.control, numbers, 0)];
  return separations.map((place) => {
    const force = known(() => solver.bridge(pair, place + numbers.offset, liquid))?.force ?? 0;
    return numbers.force_scale * force + numbers.force_zero + numbers.base_slope * place;
  });
}
