// The least sum of losses between bounds, by the method of Levenberg and Marquardt.
//
// A variable at its bound rests there while the gradient presses it outwards; a step that leaves the bounds is cut, and
// one that goes too far from where the rates were asked is shortened.
// J. Nocedal, S. J. Wright, Numerical Optimization, 2006, chapters 10 and 16; the damping as in H. B. Nielsen, 1999.

import { dotOf, solvePositive, squareOf } from "./linear.mjs";

const FIRST_DAMPING = 1e-3;
const MOST_DAMPING = 1e30;
const AFTER_NOTHING = 16; // times the damping where no residual is known
const LEAST_GAIN = 0.1; // of a residual far out, over that of its slope: else what is far would say nothing of a step

// Loss of the square of a residual over that which counts in full, with its first and second derivatives.
const LOSS_OF = {
  linear: (z) => [z, 1, 0],
  soft_l1: (z) => [2 * (Math.sqrt(1 + z) - 1), (1 + z) ** -0.5, -0.5 * (1 + z) ** -1.5],
  huber: (z) => (z <= 1 ? [z, 1, 0] : [2 * Math.sqrt(z) - 1, z ** -0.5, -0.5 * z ** -1.5]),
  cauchy: (z) => [Math.log1p(z), 1 / (1 + z), -1 / (1 + z) ** 2],
};

/**
 * The place of the least loss. `residualsAt` gives NaN where nothing is known; `ratesAt` gives a column of rates for each
 * variable, which no step changes by more than its `longest`.
 */
export function leastSquares(residualsAt, ratesAt, start, { low, high, longest, loss, full, stops }) {
  const lossOf = LOSS_OF[loss];
  const costOf = (residuals) => 0.5 * full ** 2 * residuals.reduce((sum, one) => sum + lossOf((one / full) ** 2)[0], 0);
  let x = clipped(start, low, high);
  let residuals = residualsAt(x);
  let cost = costOf(residuals);
  let evaluations = 1;
  let damping = FIRST_DAMPING;
  let worse = 2;
  let status = "";
  const scale = x.map(() => 0);
  let near = nearBy(residuals, ratesAt(x), lossOf, full);
  while (!status && evaluations < stops.max_nfev) {
    for (const [i, column] of near.columns.entries()) scale[i] = Math.max(scale[i], Math.sqrt(dotOf(column, column)));
    const isFree = x.map(
      (one, i) => !((one <= low[i] && near.gradient[i] > 0) || (one >= high[i] && near.gradient[i] < 0)),
    );
    const way = x.map((one, i) => Math.min(Math.max(one - near.gradient[i], low[i]), high[i]) - one);
    if (Math.max(...way.map(Math.abs)) < stops.gtol) {
      status = "gradient";
      break;
    }
    const step = shortened(dampedStep(near, scale, damping, isFree), longest);
    const next =
      step &&
      clipped(
        x.map((one, i) => one + step[i]),
        low,
        high,
      );
    const moved = next?.map((one, i) => one - x[i]);
    const promised = moved
      ? -dotOf(near.gradient, moved) -
        0.5 *
          dotOf(
            moved,
            near.square.map((row) => dotOf(row, moved)),
          )
      : NaN;
    if (!(promised > 0)) {
      damping *= worse;
      worse *= 2;
      if (damping > MOST_DAMPING) status = "step";
      continue;
    }
    const tried = residualsAt(next);
    evaluations++;
    const nextCost = costOf(tried);
    if (!Number.isFinite(nextCost)) {
      damping *= AFTER_NOTHING;
      if (damping > MOST_DAMPING) status = "step";
      continue;
    }
    const gained = cost - nextCost;
    const ratio = gained / promised;
    if (gained < stops.ftol * cost && ratio > 0.25) status = "loss";
    else if (lengthOf(moved) < stops.xtol * (stops.xtol + lengthOf(x))) status = "step";
    if (gained > 0) {
      [x, residuals, cost] = [next, tried, nextCost];
      near = nearBy(residuals, ratesAt(x), lossOf, full);
      damping *= Math.max(1 / 3, 1 - (2 * ratio - 1) ** 3);
      worse = 2;
    } else {
      damping *= worse;
      worse *= 2;
    }
  }
  return { x, cost, evaluations, isSettled: status !== "" };
}

function shortened(step, longest) {
  if (!step) return undefined;
  const share = Math.min(1, ...step.map((one, i) => longest[i] / Math.abs(one)));
  return step.map((one) => share * one);
}

const lengthOf = (values) => Math.sqrt(dotOf(values, values));
const clipped = (values, low, high) => values.map((one, i) => Math.min(Math.max(one, low[i]), high[i]));

/** Columns of rates, gradient and their square, where a loss stands in the place of squares. */
function nearBy(residuals, rates, lossOf, full) {
  const gradient = rates.map((column) =>
    column.reduce((sum, rate, i) => sum + rate * residuals[i] * lossOf((residuals[i] / full) ** 2)[1], 0),
  );
  const gains = Array.from(residuals, (one) => {
    const z = (one / full) ** 2;
    const [, first, second] = lossOf(z);
    return Math.sqrt(Math.max(first + 2 * z * second, LEAST_GAIN * first));
  });
  const columns = rates.map((column) => column.map((rate, i) => rate * gains[i]));
  return { gradient, columns, square: squareOf(columns) };
}

/** Step of the variables that are free, undefined where they cannot be told apart. */
function dampedStep({ gradient, square }, scale, damping, isFree) {
  const free = isFree.flatMap((one, i) => (one ? [i] : []));
  const size = free.map((i) => scale[i] || 1); // of a unit each: so that the square keeps its digits
  const matrix = free.map((i, a) => free.map((j, b) => square[i][j] / size[a] / size[b] + (a === b ? damping : 0)));
  const found = solvePositive(
    matrix,
    free.map((i, a) => -gradient[i] / size[a]),
  );
  if (!found) return undefined;
  const step = scale.map(() => 0);
  for (const [a, i] of free.entries()) step[i] = found[a] / size[a];
  return step;
}
