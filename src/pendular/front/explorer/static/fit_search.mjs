// A fit of a measured curve: residuals in units of their error, starts from several places, and what is told of the
// minimum; as fitting.search and fitting.fitting.

import { boundNotes, errorsOf, secantRates, widening } from "./fit_errors.mjs";
import { dataOf, endsAt, foretoldForce, limitsOf, modelOf, numbersAt, predictionOf } from "./fit_model.mjs";
import { innerOf, outerOf } from "./fit_unknowns.mjs";
import { leastSquares } from "./least_squares.mjs";
import { medianOf } from "./linear.mjs";
import { RECORDS } from "./records.mjs";

const SEARCH = RECORDS.fitting;
const LINE_POINTS = 200;
const LONGEST = { cosine: 0.5, log: 1, humidity: 1, linear: 0.3 }; // step of a variable
const BEFORE_RUPTURE = 1e-4; // root of the way before rupture, over the curve, to which the line goes

/** Fit of a request: the curve, the pair, what is held, what is free, the rupture as a datum, and the loss. */
export function fitOf(request, solver) {
  const data = dataOf(request);
  const model = modelOf(request, data);
  const given = request.forceError;
  const { found, errors } = settled(model, data, solver, given, request.loss);
  return tellFit(model, data, solver, found, errors, request);
}

/** The minimum, and the errors of the forces, told by its own residuals if they are not given. */
function settled(model, data, solver, given, loss) {
  if (given) return { found: minimumOf(model, data, solver, given, loss, SEARCH.STARTS), errors: given };
  const equal = (size) => data.force.map(() => size);
  let size = SEARCH.FIRST_ERROR * data.height;
  let found = minimumOf(model, data, solver, equal(size), loss, SEARCH.STARTS);
  for (let round = 0; round < SEARCH.MOST_ROUNDS; round++) {
    const told = Math.max(sizeOfErrors(model, data, found, loss), SEARCH.LEAST_ERROR * data.height);
    // no size moves the minimum of squares
    const isSettled = Math.abs(told - size) < SEARCH.SETTLED * size;
    if (loss === "linear" && data.rupture === null) {
      // no size moves the minimum of squares
      const rescaled = (values) => values.map((one) => (one * size) / told);
      found = { ...found, residuals: rescaled(found.residuals), columns: found.columns.map(rescaled) };
      size = told;
      break;
    }
    size = told;
    if (isSettled) break;
    const again = minimumOf(model, data, solver, equal(size), loss, 1, found.variables);
    found = { ...again, evaluations: found.evaluations + again.evaluations };
  }
  return { found, errors: equal(size) };
}

/** Common size of the errors of the forces, by the residuals. */
function sizeOfErrors(model, data, found, loss) {
  const misses = found.prediction.force.map((one, i) => data.force[i] - one).filter((_, i) => data.judged[i]);
  const lost = Math.sqrt(misses.length / Math.max(misses.length - model.unknowns.length, 1));
  if (loss === "linear") return lost * Math.sqrt(misses.reduce((sum, one) => sum + one * one, 0) / misses.length);
  return lost * SEARCH.OF_MEDIAN * medianOf(misses.map(Math.abs));
}

// -- Residuals -------------------------------------------------------------------------------------------------------

/**
 * Residuals of a model in units of their errors, those of the force first, then that of rupture. The last one, of the
 * search alone, tells how far the curve goes beyond the rupture of the model.
 */
function missesOf(model, data, solver, errors) {
  const worth = data.steepness / medianOf(errors);
  const offset = model.unknowns.findIndex(({ name }) => name === "offset");
  const reachOf = (found, variables) => found.ends.separation - numbersAt(model, variables).offset;
  const excessOf = (found, variables) => (found.ends ? Math.max(data.farthest - reachOf(found, variables), 0) : 0);
  const measured = (rates) => rates.map((rate, i) => (i === offset ? rate - model.unknowns[i].scale : rate));
  const predicted = (variables, withRates) => predictionOf(model, data, solver, variables, withRates);
  let known = 0;

  const residualsOf = (found, variables) => {
    const misses = Array.from(found.force, (one, i) => (data.judged[i] ? (one - data.force[i]) / errors[i] : 0));
    if (data.rupture) misses.push((reachOf(found, variables) - data.rupture[0]) / data.rupture[1]);
    return misses;
  };
  const ratesOf = (found) => {
    const atRupture = data.rupture ? measured(found.ends.separationRates) : [];
    return found.rates.map((column, i) => [
      ...Array.from(column, (rate, row) => (data.judged[row] ? rate / errors[row] : 0)),
      ...(data.rupture ? [atRupture[i] / data.rupture[1]] : []),
    ]);
  };
  return {
    searched(variables) {
      try {
        const found = predicted(variables, false);
        const told = residualsOf(found, variables);
        known = told.length + 1;
        return [...told, worth * excessOf(found, variables)];
      } catch (error) {
        if (!(error instanceof RangeError) || !known) throw error;
        return Array(known).fill(NaN);
      }
    },
    searchedRates(variables) {
      const found = predicted(variables, true);
      const isBeyond = excessOf(found, variables) > 0;
      const last = isBeyond ? measured(found.ends.separationRates) : [];
      return ratesOf(found).map((column, i) => [...column, isBeyond ? -worth * last[i] : 0]);
    },
    told(variables) {
      const prediction = predicted(variables, true);
      return { prediction, residuals: residualsOf(prediction, variables), columns: ratesOf(prediction) };
    },
  };
}

/** First and second derivatives of a loss. */
const DERIVATIVES = {
  linear: (one) => [one, 1],
  soft_l1: (one, square) => [one / Math.sqrt(1 + square), (1 + square) ** -1.5],
  huber: (one, square) => [one / Math.sqrt(Math.max(square, 1)), square <= 1 ? 1 : 0],
  cauchy: (one, square) => [one / (1 + square), (1 - square) / (1 + square) ** 2],
};

function scoresAndGain(loss, residuals) {
  const found = residuals.map((one) => DERIVATIVES[loss](one, (one / SEARCH.LOSSES[loss]) ** 2));
  return { scores: found.map(([score]) => score), gain: found.map(([, gain]) => gain) };
}

// -- Search ----------------------------------------------------------------------------------------------------------

/** The least loss; the search starts from the guess, and is tried from more places on few of the points. */
function minimumOf(model, data, solver, errors, loss, starts, begin) {
  const misses = missesOf(model, data, solver, errors);
  const limits = { ...limitsOf(model), longest: model.unknowns.map(({ kind }) => LONGEST[kind]) };
  const guess = begin ?? model.unknowns.map((unknown) => innerOf(unknown, unknown.start));
  const first = guess.map((one, i) => Math.min(Math.max(one, limits.low[i]), limits.high[i]));
  const search = (from, start, stops) =>
    leastSquares(from.searched, from.searchedRates, start, { ...limits, loss, full: SEARCH.LOSSES[loss], stops });
  let evaluations = 0;
  let likeliest = [first];
  if (starts > 1) {
    const chosen = chosenOf(data);
    const few = fewOf(data, chosen);
    const scan = missesOf(
      model,
      few,
      solver,
      chosen.map((i) => errors[i]),
    );
    const tried = [search(scan, first, SEARCH.SCAN)];
    for (const start of startsOf(model, data, first, limits, starts)) {
      try {
        tried.push(search(scan, start, SEARCH.SCAN));
      } catch (error) {
        if (!(error instanceof RangeError)) throw error; // where there is no answer
      }
    }
    evaluations = tried.reduce((sum, one) => sum + one.evaluations, 0);
    likeliest = apart(tried.sort((one, other) => one.cost - other.cost));
  }
  const polished = likeliest.map((place) => search(misses, place, SEARCH.POLISH));
  const best = polished.reduce((one, other) => (other.cost < one.cost ? other : one));
  evaluations += polished.reduce((sum, one) => sum + one.evaluations, 0);
  return { variables: best.x, ...misses.told(best.x), isSettled: best.isSettled, evaluations };
}

/** The best place, and the next best, if it is another one and nearly as good. */
function apart([best, ...rest]) {
  const most = SEARCH.NEARLY * best.cost + SEARCH.SLIGHT;
  const isOther = ({ x, cost }) =>
    cost < most && Math.max(...x.map((one, i) => Math.abs(one - best.x[i]))) > SEARCH.SAME;
  const other = rest.find(isOther);
  return other ? [best.x, other.x] : [best.x];
}

/** Some of the points, evenly along the curve, with its end. */
function chosenOf({ separation, broken }) {
  const order = separation
    .map((_, i) => i)
    .sort((i, j) => separation[i] - separation[j])
    .filter((i) => !broken[i]);
  const places = Array.from({ length: SEARCH.FEW }, (_, i) => toEven(((order.length - 1) * i) / (SEARCH.FEW - 1)));
  return [...new Set(places)].map((place) => order[place]);
}

/** The nearest whole number, of two the even one. */
function toEven(value) {
  const below = Math.floor(value);
  if (value - below !== 0.5) return Math.round(value);
  return below % 2 ? below + 1 : below;
}

function fewOf(data, chosen) {
  const taken = Object.fromEntries(
    ["separation", "force", "time", "broken", "judged"].map((name) => [name, chosen.map((i) => data[name][i])]),
  );
  return {
    ...data,
    ...taken,
    farthest: Math.max(...taken.separation.filter((_, i) => !taken.broken[i])),
    span: spanOf(taken.separation),
  };
}

const spanOf = (values) => Math.max(...values) - Math.min(...values);

/** Places to start from beside the guess, about it; angles anywhere up to a right one. Half of them begin in contact. */
function startsOf({ unknowns }, { separation }, first, { low, high }, count) {
  const random = SEARCH.RANDOM[Symbol.iterator]();
  const nearest = Math.min(...separation);
  const touching = first.map((one, i) => (unknowns[i].name === "offset" ? -nearest / unknowns[i].scale : one));
  return Array.from({ length: count - 1 }, (_, number) =>
    (number % 2 ? touching : first).map((one, i) => {
      const { kind } = unknowns[i];
      const share = random.next().value;
      const place = kind === "cosine" ? Math.cos(0.5 * Math.PI * share) : one + (2 * share - 1) * SEARCH.SPREAD[kind];
      return Math.min(Math.max(place, low[i]), high[i]);
    }),
  );
}

// -- What is told ----------------------------------------------------------------------------------------------------

function tellFit(model, data, solver, found, errors, { held, loss }) {
  const { unknowns } = model;
  const { scores, gain } = scoresAndGain(loss, found.residuals);
  const { low, high } = limitsOf(model);
  const exact = missesOf(model, data, solver, errors);
  const residualsAt = (place) => exact.searched(place).slice(0, -1);
  residualsAt(found.variables); // from here on NaN where nothing is known
  const widened = widening(scores, gain, unknowns.length);
  const columns = secantRates(residualsAt, found.variables, found.columns, widened, low, high);
  const told = errorsOf(unknowns, found.variables, columns, scores, gain);
  const numbers = numbersAt(model, found.variables);
  const names = unknowns.map(({ name }) => name);
  const byName = (values) => Object.fromEntries(names.map((name, i) => [name, values[i]]));
  const values = byName(unknowns.map((unknown, i) => outerOf(unknown, found.variables[i])));
  const { prediction } = found;
  const { unreached } = prediction;
  const notes = [...told.notes, ...boundNotes(unknowns, values)];
  if (unreached) notes.push(`at these values there is no bridge at ${unreached} of ${data.force.length} points`);
  const ends = prediction.ends ?? endsAt(model, data, solver, found.variables, false);
  const residuals = Array.from(prediction.force, (one, i) => data.force[i] - one);
  return {
    names,
    values,
    errors: byName(told.errors),
    upper: told.upper,
    correlation: told.correlation,
    notes,
    separation: data.separation,
    force: data.force,
    forceError: errors,
    fitted: Array.from(prediction.force),
    residuals,
    rms: Math.sqrt(residuals.reduce((sum, one) => sum + one * one, 0) / residuals.length),
    ruptureSeparation: ends.separation - numbers.offset,
    measuredRupture: data.rupture,
    numbers,
    held: { name: held, value: held === "humidity" ? (values.humidity ?? null) : numbers[model.control] },
    chiSquare: found.residuals.reduce((sum, one) => sum + one * one, 0),
    degreesOfFreedom: data.judged.filter(Boolean).length + (data.rupture !== null) - unknowns.length,
    converged: found.isSettled,
    evaluations: found.evaluations,
    line: lineOf(model, data, solver, numbers, ends.separation - numbers.offset, prediction),
  };
}

/** The fitted curve to draw, dense towards rupture, where the force falls fastest. */
function lineOf(model, data, solver, numbers, rupture, prediction) {
  if (model.unknowns.some(({ name }) => name === "evaporation_rate")) {
    const order = data.separation.map((_, i) => i).sort((i, j) => data.separation[i] - data.separation[j]);
    return { separation: order.map((i) => data.separation[i]), force: order.map((i) => prediction.force[i]) };
  }
  const first = Math.min(...data.separation);
  const last = rupture > first ? rupture : data.farthest;
  const share = (i) => (1 + ((BEFORE_RUPTURE - 1) * i) / (LINE_POINTS - 1)) ** 2;
  const separation = Array.from({ length: LINE_POINTS }, (_, i) => last - (last - first) * share(i));
  return { separation, force: foretoldForce(model, solver, numbers, separation) };
}
