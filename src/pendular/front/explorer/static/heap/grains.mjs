// Grains of a heap: packings that the page brings, and grains that are pasted.

import { PACKINGS } from "./heap_records.mjs";
import { readQuantity } from "../units.mjs";

export const MOST_GRAINS = 2000; // beyond, a hand on the slider would be felt
const FEWEST_GRAINS = 2;
const MANY = 100; // grains of which the digits are looked at; a few may be placed by hand
const TOUCHING = 1e-9; // of the smallest radius, as in the package

export const packingNames = () => Object.keys(PACKINGS);

/** A packing of the page in a cube that repeats, with a mean radius, [m]. */
export function packingNamed(name, radius) {
  const { side, radii, positions } = PACKINGS[name];
  const count = positions.length / 3;
  return heapOf(
    Float64Array.from(positions, (place) => place * radius),
    Float64Array.from({ length: count }, (_, i) => (radii[i] ?? radii[0]) * radius),
    [side * radius, side * radius, side * radius],
  );
}

/**
 * Grains of a text, one a line as x, y, z and radius, in a unit of length. A line "cell a b c" lets an upright box of
 * these sides repeat in all directions; without it the heap is open.
 */
export function grainsOf(text, unitText) {
  const unit = readQuantity("unit", `1 ${unitText}`, "m", "1mm");
  const rows = [];
  const places = []; // as they are written
  let cell = null;
  for (const [i, line] of text.split(/\r\n?|\n/).entries()) {
    const words = line
      .trim()
      .split(/[\s,;]+/)
      .filter(Boolean);
    const start = words[0] === "#" ? 1 : 0;
    if (/^#?cell$/i.test(words[start] ?? "")) cell = numbersOf(words.slice(start + 1), 3, i, line, "cell a b c", unit);
    else if (words.length && !words[0].startsWith("#") && !(rows.length === 0 && /^["']?x\b/i.test(words[0]))) {
      rows.push(numbersOf(words, 4, i, line, "x y z r", unit));
      places.push(...words.slice(0, 3));
    }
  }
  if (rows.length < FEWEST_GRAINS || rows.length > MOST_GRAINS)
    throw new RangeError(
      `grains: ${rows.length} lines are not ${FEWEST_GRAINS} to ${MOST_GRAINS} of x y z r; pendular packing takes more`,
    );
  const wrong = rows.findIndex(([, , , radius]) => !(radius > 0));
  if (wrong >= 0) throw new RangeError(`grains: the radius of grain ${wrong}, ${rows[wrong][3]} m, is not > 0`);
  if (cell !== null && !cell.every((side) => side > 0)) throw new RangeError("cell: one of its sides is not > 0");
  return heapOf(
    Float64Array.from(rows.flatMap((row) => row.slice(0, 3))),
    Float64Array.from(rows, ([, , , radius]) => radius),
    cell,
    unit * cutOf(places),
  );
}

/** Half a unit of the last digit of the largest coordinates; 0 for a few grains, and for those of a lattice. */
function cutOf(places) {
  const sizes = places.map((place) => Math.abs(Number(place)));
  if (places.length < 3 * MANY || new Set(sizes).size < 0.5 * sizes.length) return 0;
  const most = sizes.reduce((one, other) => Math.max(one, other));
  const least = 10 ** Math.floor(Math.log10(most));
  const ends = places.filter((_, i) => sizes[i] >= least).map(lastPlaceOf);
  return 0.5 * 10 ** ends.reduce((one, other) => Math.min(one, other));
}

/** Power of ten of the last digit of a number as it is written. */
function lastPlaceOf(text) {
  const [, decimals = "", power = "0"] = /^[+-]?\d*\.?(\d*)(?:e([+-]?\d+))?$/i.exec(text) ?? [];
  return Number(power) - decimals.length;
}

function numbersOf(words, count, i, line, wanted, unit) {
  const numbers = words.map(Number);
  if (numbers.length !== count || !numbers.every(Number.isFinite))
    throw new RangeError(`grains: line ${i + 1}, '${line.trim().slice(0, 40)}', is not ${wanted}`);
  return numbers.map((number) => number * unit);
}

function heapOf(positions, radii, cell, cut = 0) {
  const box = cell ?? boxAround(positions, radii);
  const [least, most] = [radii.reduce((a, b) => Math.min(a, b)), radii.reduce((a, b) => Math.max(a, b))];
  return {
    count: radii.length,
    positions,
    radii,
    cell,
    box,
    volume: box[0] * box[1] * box[2],
    leastRadius: least,
    mostRadius: most,
    meanRadius: radii.reduce((sum, radius) => sum + radius, 0) / radii.length,
    rounding: TOUCHING * least,
    cut, // largest error of a coordinate by its digits, [m]
  };
}

/** Sides of the smallest upright box around the grains. */
function boxAround(positions, radii) {
  return [0, 1, 2].map((k) => {
    let [low, high] = [Infinity, -Infinity];
    for (let i = 0; i < radii.length; i++) {
      low = Math.min(low, positions[3 * i + k] - radii[i]);
      high = Math.max(high, positions[3 * i + k] + radii[i]);
    }
    return high - low;
  });
}

/** The grains as lines of x y z r in metres, with all digits, as they are read again here and by numpy.loadtxt. */
export function linesOf({ count, positions, radii, cell }) {
  const lines = ["# x y z r, in m"];
  if (cell) lines.push(`# cell ${cell.join(" ")}`);
  for (let i = 0; i < count; i++) lines.push([...positions.subarray(3 * i, 3 * i + 3), radii[i]].join(" "));
  return `${lines.join("\n")}\n`;
}
