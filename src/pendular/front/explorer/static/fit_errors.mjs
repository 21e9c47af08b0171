// How well the data fix what was fitted: errors, correlations, bounds, and a line for each thing that one has to know.
// As fitting.errors has it.

import { outerOf, slopeOf } from "./fit_unknowns.mjs";
import { general } from "./general.mjs";
import { dotOf, eigenOf, normalBelow, normalQuantile, squareOf } from "./linear.mjs";
import { RECORDS } from "./records.mjs";

const JUDGED_BY = RECORDS.fitting;

/** Errors, correlation, upper bounds and notes at a minimum. */
export function errorsOf(unknowns, variables, columns, scores, gain) {
  const size = columns.map((column) => Math.sqrt(dotOf(column, column)) || 1);
  const isSilent = columns.map((column) => dotOf(column, column) === 0);
  const scaled = columns.map((column, i) => column.map((rate) => rate / size[i]));
  const { values, vectors } = eigenOf(squareOf(scaled));
  const isFlat = values.map((value) => value <= JUDGED_BY.SINGULAR ** 2 * Math.max(values.at(-1), 1));
  const inverse = size.map((_, i) =>
    size.map((__, j) =>
      values.reduce((sum, value, k) => (isFlat[k] ? sum : sum + (vectors[k][i] * vectors[k][j]) / value), 0),
    ),
  );
  const widened = widening(scores, gain, unknowns.length);
  const deviation = size.map((_, i) => Math.sqrt(widened * inverse[i][i]));
  const isLost = size.map((_, i) =>
    vectors.some((vector, k) => isFlat[k] && Math.abs(vector[i]) > JUDGED_BY.NOT_FIXED),
  );
  const pulls = scaled.map((column) => dotOf(column, scores));
  const mean = gain.reduce((sum, one) => sum + one, 0) / gain.length;
  const steps = size.map((one, i) => -dotOf(inverse[i], pulls) / mean / one);
  const turn = unknowns.map(({ kind }) => (kind === "cosine" || kind === "humidity" ? -1 : 1));
  const correlation = size.map((_, i) =>
    size.map((__, j) => {
      if (i === j) return 1;
      if (isLost[i] || isLost[j]) return NaN;
      return (turn[i] * turn[j] * widened * inverse[i][j]) / (deviation[i] || 1) / (deviation[j] || 1);
    }),
  );
  const notes = vectors.flatMap((vector, k) => (isFlat[k] ? [valleyNote(unknowns, vector, isSilent)] : []));
  const upper = {};
  const errors = unknowns.map((unknown, i) => {
    const error = isLost[i] ? Infinity : deviation[i] / size[i];
    const [told, bound] = errorOf(unknown, variables[i], error, steps[i]);
    if (bound !== undefined) {
      upper[unknown.name] = bound;
      const degrees = general((180 / Math.PI) * bound, 3);
      notes.push(`${unknown.name}: 0 is within its error; below ${degrees}° with 95 % confidence`);
    }
    return told;
  });
  return { errors, upper, correlation, notes: [...notes, ...valleyNotes(unknowns, correlation)] };
}

/** By how much a loss that is not squares makes the covariance wider; 1 for squares. */
export function widening(scores, gain, free) {
  if (gain.every((one) => one === 1)) return 1;
  const mean = gain.reduce((sum, one) => sum + one, 0) / gain.length;
  return dotOf(scores, scores) / Math.max(scores.length - free, 1) / mean ** 2;
}

/**
 * Rates of residuals by differences over one standard error along the axes of the covariance.
 *
 * Where the rates change within the errors, next to rupture or along a bent valley, these tell the width of the minimum
 * better. The rates are taken as they are where they leave a direction open.
 */
export function secantRates(residualsAt, variables, columns, widened, low, high) {
  const size = columns.map((column) => Math.sqrt(dotOf(column, column)));
  if (size.includes(0)) return columns;
  const { values, vectors } = eigenOf(squareOf(columns.map((column, i) => column.map((rate) => rate / size[i]))));
  if (values[0] < JUDGED_BY.SINGULAR ** 2 * values.at(-1)) return columns;
  const lengths = values.map((value) => Math.sqrt(widened / value));
  const secants = vectors.map((vector, k) =>
    secantAlong(
      residualsAt,
      variables,
      vector.map((one, i) => (lengths[k] * one) / size[i]),
      low,
      high,
    ),
  );
  if (secants.some((secant) => secant === undefined || secant.some(Number.isNaN))) return columns;
  // the axes are orthogonal in the scaled variables, so that their inverse is their transpose
  return size.map((one, i) =>
    secants[0].map(
      (_, row) => one * secants.reduce((sum, secant, k) => sum + (secant[row] * vectors[k][i]) / lengths[k], 0),
    ),
  );
}

/** Rate of residuals along an axis, over as much of one length of it both ways as the bounds leave. */
function secantAlong(residualsAt, start, axis, low, high) {
  const room = (ends) => Math.min(1, ...axis.map((one, i) => (one === 0 ? Infinity : (ends(one)[i] - start[i]) / one)));
  const forth = room((one) => (one > 0 ? high : low));
  const back = -Math.min(
    1,
    ...axis.map((one, i) => (one === 0 ? Infinity : (start[i] - (one > 0 ? low : high)[i]) / one)),
  );
  if (forth - back < JUDGED_BY.LEAST_ROOM) return undefined;
  const at = (way) => residualsAt(start.map((one, i) => one + way * axis[i]));
  const [ahead, behind] = [at(forth), at(back)];
  return ahead.map((one, i) => (one - behind[i]) / (forth - back));
}

/** Standard error of a value; for an angle near 0 that of one side, and its upper bound. */
function errorOf(unknown, variable, error, step) {
  const value = outerOf(unknown, variable);
  if (!Number.isFinite(error)) return [Infinity];
  if (unknown.kind !== "cosine") return [Math.abs(slopeOf(unknown, value)) * error];
  if (variable + JUDGED_BY.NEAR_ZERO * error < 1)
    return [Math.max(...[-error, error].map((way) => Math.abs(outerOf(unknown, variable + way) - value)))];
  // as if no bound were there
  const best = variable > 1 - JUDGED_BY.AT_BOUND * error ? Math.max(variable, variable + step) : variable;
  const [likely, sure] = [JUDGED_BY.LIKELY, JUDGED_BY.SURE].map((share) =>
    Math.acos(Math.max(-1, exceeded(best, error, share))),
  );
  return [Math.max(likely - value, 0), sure];
}

/** The value that a normal variable, known to lie below 1, exceeds with a probability. */
function exceeded(mean, error, share) {
  if (mean > 1 + JUDGED_BY.FAR_BEYOND * error) return 1 + (Math.log1p(-share) * error ** 2) / (mean - 1);
  return mean + error * normalQuantile((1 - share) * normalBelow((1 - mean) / error));
}

/** One line for a direction in which nothing changes. */
function valleyNote(unknowns, direction, isSilent) {
  const names = unknowns.map(({ name }) => name);
  const order = direction.map((_, i) => i).sort((i, j) => Math.abs(direction[j]) - Math.abs(direction[i]));
  const [first] = order;
  if (isSilent[first] || names.length === 1) return `${names[first]}: has no effect on these data`;
  const share = order
    .filter((i) => Math.abs(direction[i]) > JUDGED_BY.NOT_FIXED * Math.abs(direction[first]))
    .sort((i, j) => i - j)
    .map((i) => names[i]);
  const more = share.length > 2 ? `, with ${share.slice(2).join(", ")}` : "";
  return `${share.slice(0, 2).join(" and ")}: the data do not tell them apart${more}; fix one of them`;
}

/** One line for each pair that the data hardly tell apart. */
function valleyNotes(unknowns, correlation) {
  const notes = [];
  for (const [i, row] of correlation.entries())
    for (let j = 0; j < i; j++)
      if (Math.abs(row[j]) > JUDGED_BY.VALLEY)
        notes.push(
          `${unknowns[j].name} and ${unknowns[i].name}: the data hardly tell them apart, correlation ` +
            `${row[j] < 0 ? "" : "+"}${row[j].toFixed(4)}`,
        );
  return notes;
}

/** One line for each value that has met a bound. */
export function boundNotes(unknowns, values) {
  return unknowns.flatMap((unknown) => {
    const { name, kind, low, high } = unknown;
    const value = values[name];
    const width = kind === "log" ? 0 : Math.abs(high - low);
    const met = [
      [low, "lower"],
      [high, "upper"],
    ].find(
      ([end]) =>
        !(kind === "cosine" && end === 0) &&
        Math.abs(value - end) <= JUDGED_BY.BOUND_MET * Math.max(Math.abs(end), width),
    );
    return met ? [`${name}: at its ${met[1]} bound, ${general(met[0], 6)} ${JUDGED_BY.UNITS[name]}`.trimEnd()] : [];
  });
}
