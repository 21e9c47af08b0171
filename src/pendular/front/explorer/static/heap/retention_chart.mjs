// A quantity of the heap against the suction, on drying and on wetting, with the present state; below it wetting over
// drying, since the two branches lie close together.

import { quantityNamed } from "./heap_view.mjs";
import { circle, pathOf, ticksBetween } from "../chart.mjs";
import { scaleOf, show, signed } from "../units.mjs";

const MARGIN = { left: 62, right: 14, top: 16, bottom: 46 };
const STRIP = 0.22; // of the height, for wetting over drying
const GAP = 26;
const LOGARITHMIC = ["saturation", "water_content", "liquid_volume", "chi", "mean_force"];
const LABEL_ROOM = 0.08;

/** The chart as SVG text for a size in pixels, the point of the present state, and the suctions at its sides. */
export function retentionChartOf({ view, question, values }, curves, range, width, height) {
  const { unit, meaning } = quantityNamed(view.plot);
  const title = view.plot.replaceAll("_", " ");
  const words = `${title} (${meaning}) against suction, on drying and on wetting`;
  const [left, right] = [MARGIN.left, width - MARGIN.right];
  const inner = { ...range, left, right };
  if (!curves) return { svg: following(width, height), now: "", words, inner };
  const bottom = height - MARGIN.bottom;
  const frame = { left, right, top: MARGIN.top, floor: bottom - STRIP * height - GAP };
  const strip = { left, right, top: bottom - STRIP * height, floor: bottom };
  const across = (suction) =>
    left + ((right - left) * Math.log(suction / range.low)) / Math.log(range.high / range.low);
  const [drying, wetting] = ["drying", "wetting"].map((path) => curves.branches[path].map((state) => state[view.plot]));
  const lineOf = (name, list, up) =>
    `<path class="${name}" d="${pathOf(list.map((value, i) => [across(curves.suctions[i]), up(value)]))}"/>`;
  const seen = [...drying, ...wetting, values[view.plot]].filter(Number.isFinite);
  const isLog = LOGARITHMIC.includes(view.plot) && seen.every((value) => value > 0);
  const up = isLog ? upLog(seen, frame) : upLinear(seen, frame);
  const scale = isLog ? { factor: 1, unit } : scaleOf(Math.max(...seen.map(Math.abs)), unit);
  const limit = curves.limits[view.path];
  const isLimited = Number.isFinite(limit);
  const svg = [
    isLimited ? meetingBand(across(limit), frame) + meetingBand(across(limit), strip) : "",
    isLog ? logAxis(seen, up, frame) : linearAxis(seen, up, frame, scale),
    leftAxis(frame, scale.unit ? `${title} (${scale.unit})` : title),
    lineOf("drying", drying, up),
    lineOf("wetting", wetting, up),
    ratioStrip(drying, wetting, strip, lineOf),
    suctionAxis(range, across, strip, height),
    isLimited ? meetingWords(limit, across(limit), frame) : "",
  ].join("");
  const [x, y] = [across(question.suction), up(values[view.plot])];
  const isIn = Number.isFinite(y) && x >= left - 1 && x <= right + 1;
  return { svg, now: isIn ? circle(x, y, 5.5, "now") : "", words, inner };
}

function ratioStrip(drying, wetting, strip, lineOf) {
  const ratios = wetting.map((value, i) => value / drying[i]);
  const seen = ratios.filter(Number.isFinite);
  if (!seen.length) return "";
  const low = Math.min(...seen, 1);
  const high = Math.max(...seen, 1);
  const room = 0.1 * (high - low) || 0.01;
  const [y0, y1] = [low - room, high + room];
  const up = (value) => strip.floor - ((value - y0) / (y1 - y0)) * (strip.floor - strip.top);
  const ticks = ticksBetween(y0, y1, 3).map((tick) => mark(up(tick), signed(String(tick)), strip));
  return ticks.join("") + leftAxis(strip, "over drying") + lineOf("wetting", ratios, up);
}

function leftAxis({ left, right, top, floor }, title) {
  return (
    `<path class="axis" d="M${left} ${top}V${floor}H${right}"/>` +
    `<text class="title" transform="translate(15 ${0.5 * (top + floor)}) rotate(-90)" text-anchor="middle">${title}</text>`
  );
}

const following = (width, height) =>
  `<text class="title" x="${0.5 * width}" y="${0.5 * height}" text-anchor="middle">following both branches</text>`;

function upLinear(seen, { top, floor }) {
  const [low, high] = [Math.min(0, ...seen), Math.max(0, ...seen)];
  const room = LABEL_ROOM * (high - low || 1);
  return (value) => floor - ((value - low) / (high + room - low)) * (floor - top);
}

/** Whole decades below and above. */
function decadesOf(seen) {
  return [Math.floor(Math.log10(Math.min(...seen)) + 1e-9), Math.ceil(Math.log10(Math.max(...seen)) - 1e-9)];
}

function upLog(seen, { top, floor }) {
  const [first, last] = decadesOf(seen);
  return (value) => floor - ((Math.log10(value) - first) / (last - first || 1)) * (floor - top);
}

const power = (decade) => `10<tspan class="power" dy="-5">${signed(String(decade))}</tspan>`;

function mark(y, words, { left, right }) {
  return `<path class="grid" d="M${left} ${y.toFixed(1)}H${right}"/><text class="tick" x="${left - 7}" y="${(y + 4).toFixed(1)}" text-anchor="end">${words}</text>`;
}

function logAxis(seen, up, frame) {
  const [first, last] = decadesOf(seen);
  const step = Math.ceil((last - first) / Math.max(3, (frame.floor - frame.top) / 40));
  const decades = Array.from({ length: last - first + 1 }, (_, i) => first + i).filter((one) => one % step === 0);
  return decades.map((decade) => mark(up(10 ** decade), power(decade), frame)).join("");
}

function linearAxis(seen, up, frame, { factor }) {
  const [low, high] = [Math.min(0, ...seen) * factor, Math.max(0, ...seen) * factor];
  const ticks = ticksBetween(low, high || 1, Math.max(3, (frame.floor - frame.top) / 52));
  return ticks.map((tick) => mark(up(tick / factor), signed(String(tick)), frame)).join("");
}

function suctionAxis({ low, high }, across, { left, right, floor }, height) {
  const decades = Array.from({ length: 40 }, (_, i) => 10 ** (i - 20)).filter((one) => one >= low && one <= high);
  const ticks = decades.map((decade) => {
    const x = across(decade).toFixed(1);
    const words = show(decade, "Pa", 3);
    return `<path class="axis" d="M${x} ${floor}v4"/><text class="tick" x="${x}" y="${floor + 17}" text-anchor="middle">${words}</text>`;
  });
  return [
    ...ticks,
    `<text class="title" x="${0.5 * (left + right)}" y="${height - 8}" text-anchor="middle">suction</text>`,
  ].join("");
}

/** Where bridges meet: numbers there are those of bridges that overlap. */
const meetingBand = (x, { left, top, floor }) =>
  `<rect class="meeting" x="${left}" y="${top}" width="${Math.max(0, x - left).toFixed(1)}" height="${floor - top}"/>`;

function meetingWords(limit, x, { right, floor }) {
  const isTight = x + 110 > right;
  const place = isTight ? `x="${(x - 6).toFixed(1)}" text-anchor="end"` : `x="${(x + 6).toFixed(1)}"`;
  return (
    `<text class="key" ${place} y="${floor - 22}">bridges meet</text>` +
    `<text class="key" ${place} y="${floor - 7}">below ${show(limit, "Pa", 3)}</text>`
  );
}
