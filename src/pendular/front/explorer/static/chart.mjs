// A quantity against the separation: both branches, rupture, the present state, and laws laid over the force.

import { RECORDS } from "./records.mjs";
import { rounded, scaleOf, show, signed } from "./units.mjs";

const MARGIN = { left: 62, right: 10, top: 14, bottom: 46 };
const ROOM = 0.36; // right of the rupture point for its label, over the rupture distance
const OUTER = 0.04; // of the states at either end are left out of the range of what grows without bound at rupture
const DASHES = ["", "2 3", "7 3 2 3", "9 4"];
const LAW_COLOURS = 6; // in the style sheet

/** Names of the fields that can be drawn, as a state of the solver has them. */
export const fieldOf = (name) => name.replaceAll(/_(\w)/g, (_, letter) => letter.toUpperCase());

const unitOf = (name) => RECORDS.fields.find((field) => field.name === name).unit;

/** Class and dashes of the line of a law, by its place among all; told apart without colours as well. */
export function lawLine(place) {
  const colour = place % LAW_COLOURS;
  return `class="law colour${colour}" stroke-dasharray="${DASHES[(place + Math.floor(place / LAW_COLOURS)) % DASHES.length]}"`;
}

/** The chart as SVG text for a size in pixels, the point of the present state, and the separations at its sides. */
export function chartOf(answer, width, height) {
  const name = answer.view.plot;
  const { rupture, curve, state, question, lowerEnd } = answer;
  const field = fieldOf(name);
  if (!curve.length) {
    const words = rupture ? "no curve is known" : "no bridge between solids apart";
    return { svg: emptyChart(width, height, words), now: "", words };
  }
  const values = curve.map((one) => one[field]);
  const here = state?.[field];
  const [low, high] = rangeOf(name, values, state, question.separation < curve[0].separation ? here : undefined);
  const gap = scaleOf(Math.max(...curve.map((one) => one.separation), Math.abs(question.separation)), "m");
  const scale = scaleOf(Math.max(Math.abs(low), Math.abs(high)), unitOf(name));
  const reach = rupture.separation;
  const x0 = Math.min(0, 1.05 * question.separation);
  const x1 = Math.max(reach, question.separation - 0.2 * reach) + ROOM * reach;
  const room = 0.06 * (high - low) || 1;
  const [y0, y1] = [low - (low < 0 ? room : 0), high + room];
  const inner = { x0, x1, left: MARGIN.left, right: width - MARGIN.right };
  const across = (value) => inner.left + ((value - x0) / (x1 - x0)) * (inner.right - inner.left);
  const up = (value) => height - MARGIN.bottom - ((value - y0) / (y1 - y0)) * (height - MARGIN.bottom - MARGIN.top);
  const places = curve.map((one, i) => [across(one.separation), up(values[i]), one.stable]);
  const parts = [
    axes({ x0, x1, y0, y1, across, up, gap, scale, width, height, name }),
    `<clipPath id="inside"><rect x="${inner.left}" y="${MARGIN.top}" width="${inner.right - inner.left}" height="${height - MARGIN.bottom - MARGIN.top}"/></clipPath>`,
    '<g clip-path="url(#inside)">',
    `<path class="unstable" d="${pathOf(places.map(([x, y], i) => [x, isDashed(places, i) ? y : NaN]))}"/>`,
    name === "force" ? lawPaths(answer, across, up) : "",
    `<path class="stable" d="${pathOf(places.map(([x, y, stable]) => [x, stable ? y : NaN]))}"/>`,
    "</g>",
    name === "force" ? legend(answer, inner.right) : "",
    rupturePoint(rupture, field, across, up, inner.right),
    lowerEnd && Number.isFinite(lowerEnd[field])
      ? circle(across(lowerEnd.separation), up(lowerEnd[field]), 4, "begin")
      : "",
  ];
  const y = state ? here : name === "force" ? 0 : NaN;
  const now = Number.isFinite(y) ? circle(across(question.separation), up(y), 5.5, "now") : "";
  const words = `${name.replaceAll("_", " ")} against separation up to rupture at ${show(reach, "m", 4)}`;
  return { svg: parts.join(""), now, words, inner };
}

/** Dashes begin where the line ends. */
const isDashed = (places, i) => !places[i][2] || places[i - 1]?.[2] === false || places[i + 1]?.[2] === false;

/** Lowest and highest value to be seen, zero among them. */
function rangeOf(name, values, state, before) {
  let seen = values.filter(Number.isFinite);
  if (name === "stiffness") {
    seen = seen.sort((one, other) => one - other); // infinite at the fold
    seen = seen.slice(Math.ceil(OUTER * seen.length), Math.floor((1 - 3 * OUTER) * seen.length));
  }
  if (before !== undefined) seen.push(before);
  return [Math.min(0, ...seen), Math.max(0, ...seen)];
}

export function pathOf(points) {
  let path = "";
  let isOn = false;
  for (const [x, y] of points) {
    const isSeen = Number.isFinite(y);
    if (isSeen) path += `${isOn ? "L" : "M"}${x.toFixed(1)} ${Math.max(-1e4, Math.min(1e4, y)).toFixed(1)}`;
    isOn = isSeen;
  }
  return path;
}

/** Round numbers between two ends, about so many. */
export function ticksBetween(low, high, count) {
  const wanted = (high - low) / count;
  const decade = 10 ** Math.floor(Math.log10(wanted));
  const step = decade * [1, 2, 5, 10].find((one) => one * decade >= wanted);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) ticks.push(rounded(i * step, 12) + 0);
  return ticks;
}

function axes({ x0, x1, y0, y1, across, up, gap, scale, width, height, name }) {
  const floor = height - MARGIN.bottom;
  const right = width - MARGIN.right;
  const xs = ticksBetween(x0 * gap.factor, x1 * gap.factor, Math.max(3, (right - MARGIN.left) / 80));
  const ys = ticksBetween(y0 * scale.factor, y1 * scale.factor, Math.max(3, (floor - MARGIN.top) / 52));
  const below = xs.map((tick) => {
    const x = across(tick / gap.factor).toFixed(1);
    return `<path class="axis" d="M${x} ${floor}v4"/><text class="tick" x="${x}" y="${floor + 17}" text-anchor="middle">${signed(String(tick))}</text>`;
  });
  const beside = ys.map((tick) => {
    const y = up(tick / scale.factor).toFixed(1);
    return `<path class="grid" d="M${MARGIN.left} ${y}H${right}"/><text class="tick" x="${MARGIN.left - 7}" y="${Number(y) + 4}" text-anchor="end">${signed(String(tick))}</text>`;
  });
  const middle = 0.5 * (MARGIN.top + floor);
  return [
    ...beside,
    `<path class="axis" d="M${MARGIN.left} ${MARGIN.top}V${floor}H${right}"/>`,
    y0 < 0 ? `<path class="axis" d="M${MARGIN.left} ${up(0).toFixed(1)}H${right}"/>` : "",
    ...below,
    `<text class="title" x="${0.5 * (MARGIN.left + right)}" y="${height - 8}" text-anchor="middle">separation (${gap.unit})</text>`,
    `<text class="title" transform="translate(15 ${middle}) rotate(-90)" text-anchor="middle">${name.replaceAll("_", " ")} (${scale.unit})</text>`,
  ].join("");
}

function rupturePoint(rupture, field, across, up, right) {
  if (!Number.isFinite(rupture[field])) return "";
  const [x, y] = [across(rupture.separation), up(rupture[field])];
  const isTight = x + 80 > right;
  const place = isTight ? `x="${(x - 10).toFixed(1)}" text-anchor="end"` : `x="${(x + 10).toFixed(1)}"`;
  const upper = Math.max(y - 12, MARGIN.top + 10);
  return (
    circle(x, y, 4, "rupture") +
    `<text class="end" ${place} y="${upper.toFixed(1)}">rupture</text>` +
    `<text class="end" ${place} y="${(upper + 15).toFixed(1)}">${show(rupture.separation, "m", 4)}</text>`
  );
}

export const circle = (x, y, radius, name) =>
  `<circle class="${name}" cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="${radius}"/>`;

function lawPaths(answer, across, up) {
  const pathsOf = ({ curve, place }) => [pathOf(curve.map(([gap, force]) => [across(gap), up(force)])), place];
  return answer.drawn
    .map(pathsOf)
    .map(([path, place]) => (path ? `<path ${lawLine(place)} d="${path}"/>` : ""))
    .join("");
}

function legend(answer, right) {
  return answer.drawn
    .filter(({ curve }) => curve.some(([, force]) => Number.isFinite(force)))
    .map(({ law, place }, row) => {
      const y = MARGIN.top + 10 + 17 * row;
      return (
        `<path ${lawLine(place)} d="M${right - 28} ${y - 4}H${right - 2}"/>` +
        `<text class="key" x="${right - 34}" y="${y}" text-anchor="end">${law.name}</text>`
      );
    })
    .join("");
}

const emptyChart = (width, height, words) =>
  `<text class="title" x="${0.5 * width}" y="${0.5 * height}" text-anchor="middle">${words}</text>`;
