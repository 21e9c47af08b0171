// A map of all bridges like the one that is shown: over what is held, or the separation, and the contact angle.

import { forceOfLaw, unlessFailed } from "./answer.mjs";
import { RECORDS } from "./records.mjs";
import { scaleOf, show, signed } from "./units.mjs";

const COLUMNS = 80;
const ROWS = 60;
const MOST_DEGREES = 90;
const SLICE = 7; // time in one go, [ms], so that a hand on a slider is not felt
const SPANS = { suction: [-1, 4], volume: [-7, 1] }; // of H R̄/γ and V/R̄³
const SPANS_BY_GAP = { suction: [-5, 0], volume: [-1, 8] };
export const MAP_MARGIN = { left: 46, right: 10, top: 8, bottom: 44 };

// Light to dark, told apart without colours; and from too small over right to too large.
const SEQUENCE = [
  [253, 245, 214],
  [201, 226, 203],
  [127, 190, 196],
  [63, 143, 182],
  [37, 92, 150],
  [34, 41, 98],
];
const BALANCE = [
  [45, 76, 138],
  [120, 160, 205],
  [240, 240, 238],
  [233, 160, 128],
  [164, 52, 34],
];
const MOST_ERROR = 0.2;

/** What can be mapped, by its name in the address. */
export function mapChoices() {
  const errors = RECORDS.laws
    .filter(({ gives }) => gives.includes("force"))
    .map(({ name }) => [name, `error of ${name}`]);
  return [["force", "force"], ["rupture", "rupture distance"], ...errors];
}

/** Sides of the map of an answer: what a place in it means. */
export function mapSides({ question, view, rupture }) {
  const control = question.control === "volume" ? "volume" : "suction";
  if (question.hasSize === false && view.across !== "separation") return sidesWithoutSize(question, control);
  if (view.across === "separation") {
    const high = 1.6 * (rupture?.separation ?? 0.2 * question.meanRadius);
    return { across: "separation", control, low: 0, high, unit: 1, isLogarithmic: false };
  }
  const unit = control === "volume" ? question.meanRadius ** 3 : question.held.surfaceTension / question.meanRadius;
  const [low, high] = SPANS[control].map((decade) => 10 ** decade);
  return { across: control, control, low, high, unit, isLogarithmic: true };
}

/** Between solids without a size it is the gap that what is held is measured by. */
function sidesWithoutSize({ separation, meanRadius, held }, control) {
  const length = separation > 0 ? separation : meanRadius;
  const unit = control === "volume" ? length ** 3 : held.surfaceTension / length;
  const [low, high] = SPANS_BY_GAP[control].map((decade) => 10 ** decade);
  return { across: control, control, low, high, unit, isLogarithmic: true };
}

/** Share of the width at which a value lies, in SI units. */
function shareOf({ low, high, unit, isLogarithmic }, value) {
  const star = value / unit;
  return isLogarithmic ? Math.log(star / low) / Math.log(high / low) : (star - low) / (high - low);
}

export function valueAtShare({ low, high, unit, isLogarithmic }, share) {
  return unit * (isLogarithmic ? low * (high / low) ** share : low + (high - low) * share);
}

export const MAP_DEGREES = MOST_DEGREES;

/** Fill a canvas by and by; returns a function that stops it. `done` is told the range of the values. */
export function drawMap(canvas, answer, solver, done) {
  const sides = mapSides(answer);
  const value = valueFor(answer, solver, sides);
  const values = new Float64Array(COLUMNS * ROWS);
  let next = 0;
  let timer;
  const goOn = () => {
    const until = performance.now() + SLICE;
    while (next < values.length && performance.now() < until) {
      const [column, row] = [next % COLUMNS, Math.floor(next / COLUMNS)];
      values[next++] = value(valueAtShare(sides, (column + 0.5) / COLUMNS), (MOST_DEGREES * (row + 0.5)) / ROWS);
    }
    if (next < values.length) timer = setTimeout(goOn);
    else done(paint(canvas, values, answer.view.map));
  };
  timer = setTimeout(goOn);
  return () => clearTimeout(timer);
}

/** What is drawn at a place: NaN where there is no bridge, or a law says nothing. */
function valueFor({ question, view }, solver, sides) {
  const isSame = question.degrees[0] === question.degrees[1];
  const law = RECORDS.laws.find(({ name }) => name === view.map);
  return (x, degrees) => {
    const angle = degrees * (Math.PI / 180);
    const pair = {
      ...question.pair,
      contactAngle: [angle, isSame ? angle : question.pair.contactAngle[1]],
    };
    const isGap = sides.across === "separation";
    const held = isGap ? question.held : { surfaceTension: question.held.surfaceTension, [sides.control]: x };
    const asked = { ...question, pair, held, separation: isGap ? x : question.separation };
    const answer = () => {
      if (view.map === "rupture") return solver.rupture(pair, held)?.separation ?? NaN;
      const state = solver.bridge(pair, asked.separation, held);
      if (!state || !law) return state?.force ?? NaN;
      return forceOfLaw(law, asked, state, solver) / state.force - 1;
    };
    try {
      return unlessFailed(answer, NaN);
    } catch (error) {
      if (error instanceof RangeError) return NaN; // beyond the domain of the solver
      throw error;
    }
  };
}

function paint(canvas, values, name) {
  const isError = name !== "force" && name !== "rupture";
  const known = values.filter(Number.isFinite);
  const least = known.reduce((one, other) => Math.min(one, other), isError ? -MOST_ERROR : 0);
  const most = known.reduce((one, other) => Math.max(one, other), isError ? MOST_ERROR : 0);
  const [low, high] = isError ? [-MOST_ERROR, MOST_ERROR] : [least, most];
  canvas.width = COLUMNS;
  canvas.height = ROWS;
  const context = canvas.getContext("2d");
  const image = context.createImageData(COLUMNS, ROWS);
  values.forEach((value, i) => {
    const place = 4 * ((ROWS - 1 - Math.floor(i / COLUMNS)) * COLUMNS + (i % COLUMNS));
    if (Number.isFinite(value))
      // else it stays clear
      image.data.set([...colourAt(isError ? BALANCE : SEQUENCE, (value - low) / (high - low)), 255], place);
  });
  context.putImageData(image, 0, 0);
  return { low, high, isError, isEmpty: known.length === 0 };
}

function colourAt(stops, share) {
  const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(place), stops.length - 2);
  return stops[i].map((one, channel) => Math.round(one + (stops[i + 1][channel] - one) * (place - i)));
}

/** Axes over the map, and the present point, as SVG text for a size in pixels. */
export function mapFrame(answer, width, height) {
  const { left, right, top, bottom } = MAP_MARGIN;
  const sides = mapSides(answer);
  const { question } = answer;
  const [wide, high] = [width - left - right, height - top - bottom];
  const across = (share) => left + wide * share;
  const up = (degrees) => top + high * (1 - degrees / MOST_DEGREES);
  const floor = height - bottom;
  const marks = sides.isLogarithmic ? decades(sides, question) : gaps(sides);
  const below = marks.ticks.map(([share, words]) => {
    const x = across(share).toFixed(1);
    return `<path class="axis" d="M${x} ${floor}v4"/><text class="tick" x="${x}" y="${floor + 17}" text-anchor="middle">${words}</text>`;
  });
  const beside = [0, 30, 60, 90].map(
    (degrees) =>
      `<path class="axis" d="M${left} ${up(degrees).toFixed(1)}h-4"/>` +
      `<text class="tick" x="${left - 7}" y="${(up(degrees) + 4).toFixed(1)}" text-anchor="end">${degrees}°</text>`,
  );
  const value = sides.across === "separation" ? question.separation : question.held[sides.control];
  const [x, y] = [shareOf(sides, value), question.degrees[0]];
  const isSeen = x >= 0 && x <= 1 && y <= MOST_DEGREES;
  const svg = [
    `<rect class="frame" x="${left}" y="${top}" width="${wide}" height="${high}"/>`,
    ...below,
    ...beside,
    `<text class="title" x="${across(0.5)}" y="${height - 8}" text-anchor="middle">${marks.title}</text>`,
    `<text class="title" transform="translate(12 ${0.5 * (top + floor)}) rotate(-90)" text-anchor="middle">contact angle</text>`,
  ].join("");
  const now = isSeen ? `<circle class="now" cx="${across(x).toFixed(1)}" cy="${up(y).toFixed(1)}" r="5.5"/>` : "";
  return { svg, now };
}

function decades({ low, high, control }, { pair, hasSize }) {
  const [first, last] = [Math.round(Math.log10(low)), Math.round(Math.log10(high))];
  const step = last - first > 6 ? 2 : 1;
  const ticks = [];
  for (let decade = first; decade <= last; decade += step)
    ticks.push([(decade - first) / (last - first), `10<tspan class="power" dy="-5">${signed(String(decade))}</tspan>`]);
  const length = pair.solids ? (hasSize ? "r" : "D") : "R"; // that of the smaller solid, or the gap
  return { ticks, title: control === "volume" ? `volume V* = V/${length}³` : `suction H* = Δp ${length}/γ` };
}

function gaps({ high }) {
  const { factor, unit } = scaleOf(high, "m");
  const ticks = [0, 0.25, 0.5, 0.75, 1].map((share) => [
    share,
    signed(String(Number((share * high * factor).toPrecision(3)))),
  ]);
  return { ticks, title: `separation (${unit})` };
}

/** The range of the colours in words, with the bar between. */
export function mapKey({ low, high, isError }, name) {
  const stops = isError ? BALANCE : SEQUENCE;
  const bar = stops.map((stop) => `rgb(${stop.join(" ")})`).join(", ");
  const words = (value) =>
    isError ? `${signed(String(100 * value))}\u00a0%` : show(value, name === "rupture" ? "m" : "N", 3);
  return {
    bar: `linear-gradient(to right, ${bar})`,
    low: isError ? `≤ ${words(low)}` : words(low),
    high: isError ? `≥ +${words(high)}` : words(high),
  };
}
