// What may be free in a fit: the variable in which it is sought, and where it may lie; as fitting.unknowns has it.

import { general } from "./general.mjs";
import { RECORDS } from "./records.mjs";

const FIT = RECORDS.fitting;
export const SOLIDS = ["1", "2"];

/** The variable in which a value is sought. */
export function innerOf({ kind, constant, scale }, value) {
  if (kind === "cosine") return Math.cos(value);
  if (kind === "log") return Math.log(value);
  if (kind === "humidity") return Math.log(-constant * Math.log(value));
  return value / scale;
}

/** The value of a variable. */
export function outerOf({ kind, constant, scale }, variable) {
  if (kind === "cosine") return variable > FIT.WETS ? 0 : Math.min(Math.acos(Math.max(-1, variable)), FIT.STRAIGHT);
  if (kind === "log") return Math.exp(variable);
  if (kind === "humidity") return Math.exp(-Math.exp(variable) / constant);
  return variable * scale;
}

/** Rate of the value in its variable; infinite for an angle of 0. */
export function slopeOf({ kind, scale }, value) {
  if (kind === "cosine") return value === 0 ? -Infinity : -1 / Math.sin(value);
  if (kind === "log") return value;
  if (kind === "humidity") return value * Math.log(value);
  return scale;
}

/** Unknown of a name, from its guess in the question, where it has a meaning. */
export function unknownOf(name, question, kelvin, scales) {
  const moves = movedBy(name, question);
  const guess = name === "humidity" ? Math.exp(-question.suction / kelvin) : question[moves[0]];
  const kind = name === "suction" && !(guess > 0) ? "linear" : kindOfUnknown(name);
  const scale = scales[name] ?? (Math.abs(guess) || 1);
  const [low, high] = domainOf(name, kind, guess, question, scales, scale);
  if (!(guess >= low && guess <= high))
    throw new RangeError(
      `${name}: ${general(guess, 6)} is not in [${general(low, 6)}, ${general(high, 6)}] ${FIT.UNITS[name]}`.trimEnd(),
    );
  return { name, kind, moves, scale, start: guess, low, high, constant: name === "humidity" ? kelvin : 1 };
}

function kindOfUnknown(name) {
  if (name.startsWith("contact_angle")) return "cosine";
  if (name === "humidity") return "humidity";
  return ["offset", "force_zero", "base_slope", "evaporation_rate"].includes(name) ? "linear" : "log";
}

/** Numbers of the question that an unknown stands for; those of both solids have to be one number. */
function movedBy(name, question) {
  if (name === "humidity") return ["suction"];
  if (name !== "contact_angle" && name !== "radius") {
    if (name.startsWith("radius") && question[name] === Infinity)
      throw new RangeError(`free: '${name}' is that of a plane, which is infinite`);
    return [name];
  }
  const names = SOLIDS.map((solid) => `${name}${solid}`);
  const [first, second] = names.map((one) => question[one]);
  if (name === "radius" && (first === Infinity) !== (second === Infinity)) return [names[first === Infinity ? 1 : 0]];
  if (name === "radius" && first === Infinity)
    throw new RangeError("free: 'radius' is that of two planes, which is infinite");
  if (first !== second)
    throw new RangeError(
      `free: '${name}' is ${general(first, 6)} and ${general(second, 6)}; free '${names[0]}' or '${names[1]}', or both`,
    );
  return names;
}

/** Guess of an offset: none, or where no bridge is as near, contact at the first point. */
export function firstOffset(question, scales) {
  const least = leastOffset(question, scales);
  return least <= 0 ? 0 : Math.max(-scales.least, least);
}

/** The offset at which the first point is as near as bridges are known. */
function leastOffset({ radius1, radius2 }, scales) {
  const smaller = Math.min(radius1, radius2);
  const closest =
    smaller < Infinity
      ? -FIT.JUST_TOUCHING * RECORDS.domain.deepestOverlap * smaller
      : FIT.PLANES_APART * scales.offset;
  return Math.max(closest - scales.least, -FIT.FARTHEST_OFFSET * scales.offset - Math.abs(scales.least));
}

/** Where a value has a meaning and the solver an answer. */
function domainOf(name, kind, guess, question, scales, scale) {
  if (kind === "cosine") return [0, FIT.STRAIGHT];
  if (kind === "humidity") return FIT.HUMIDITIES;
  const { radius1, radius2 } = question;
  if (name === "offset")
    return [leastOffset(question, scales), FIT.FARTHEST_OFFSET * scale + Math.max(-scales.least, 0)];
  if (kind === "linear") return [-FIT.FARTHEST_LINEAR * scale, FIT.FARTHEST_LINEAR * scale];
  let [low, high] = [guess / FIT.FARTHEST, guess * FIT.FARTHEST];
  if (Math.min(radius1, radius2) < Infinity) {
    const mean = 2 / (1 / radius1 + 1 / radius2);
    const { leastVolume, mostVolume, mostSuction } = RECORDS.domain;
    if (name === "volume") {
      low = Math.max(low, FIT.INSIDE * leastVolume * mean ** 3);
      high = Math.min(high, (mostVolume * mean ** 3) / FIT.INSIDE);
    }
    if (name === "suction") high = Math.min(high, (mostSuction * question.surface_tension) / mean / FIT.INSIDE);
  }
  return [low, high];
}
