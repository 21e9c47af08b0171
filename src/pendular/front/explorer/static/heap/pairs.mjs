// Pairs of grains that are near enough for a bridge, and the pores that the grains leave.

import { rounded, show } from "../units.mjs";

const SAME_PLACE = 1e-12; // of a radius

/** Pairs whose gap is within a reach, in the order of their grains: the second is taken in its nearest image. */
export function pairsOf(heap, reach) {
  const { count, positions, radii, cell } = heap;
  refuseSmallCell(heap, reach);
  const first = [];
  const second = [];
  const arms = [];
  for (let i = 0; i < count; i++) {
    for (let j = i + 1; j < count; j++) {
      const most = radii[i] + radii[j] + reach;
      let x = positions[3 * j] - positions[3 * i];
      let y = positions[3 * j + 1] - positions[3 * i + 1];
      let z = positions[3 * j + 2] - positions[3 * i + 2];
      if (cell) {
        x -= cell[0] * Math.round(x / cell[0]);
        y -= cell[1] * Math.round(y / cell[1]);
        z -= cell[2] * Math.round(z / cell[2]);
      }
      if (x * x + y * y + z * z > most * most) continue;
      first.push(i);
      second.push(j);
      arms.push(x, y, z);
    }
  }
  return measured(heap, first, second, arms);
}

function measured({ radii }, first, second, arms) {
  const count = first.length;
  const pairs = {
    count,
    first: Int32Array.from(first),
    second: Int32Array.from(second),
    gap: new Float64Array(count),
    length: new Float64Array(count),
    normal: new Float64Array(3 * count),
  };
  for (let row = 0; row < count; row++) {
    const [x, y, z] = [arms[3 * row], arms[3 * row + 1], arms[3 * row + 2]];
    const length = Math.sqrt(x * x + y * y + z * z);
    refuseInside(radii, first[row], second[row], length);
    pairs.length[row] = length;
    pairs.gap[row] = length - (radii[first[row]] + radii[second[row]]);
    for (let k = 0; k < 3; k++) pairs.normal[3 * row + k] = arms[3 * row + k] / length;
  }
  return pairs;
}

/** Some of the pairs, by their rows. */
export function takenOf(pairs, rows) {
  const some = (from) => from.constructor.from(rows, (row) => from[row]);
  const normal = new Float64Array(3 * rows.length);
  for (const [k, row] of rows.entries()) normal.set(pairs.normal.subarray(3 * row, 3 * row + 3), 3 * k);
  const [first, second, gap, length] = [pairs.first, pairs.second, pairs.gap, pairs.length].map(some);
  return { count: rows.length, first, second, gap, length, normal };
}

function refuseSmallCell({ cell, mostRadius }, reach) {
  if (!cell) return;
  const [side, least] = [Math.min(...cell), 2 * (2 * mostRadius + reach)];
  if (side < least)
    throw new RangeError(
      `cell: its side of ${show(side, "m", 4)} is less than twice the reach of a bridge between centres, ${show(least, "m", 4)}`,
    );
}

function refuseInside(radii, i, j, distance) {
  const [small, large] = radii[i] <= radii[j] ? [i, j] : [j, i];
  if (distance > radii[large] - radii[small] + SAME_PLACE * radii[i]) return;
  if (distance <= SAME_PLACE * radii[small])
    throw new RangeError(`grains: ${i} and ${j} (counted from 0) have the same centre`);
  throw new RangeError(`grains: ${small} lies inside ${large} (counted from 0)`);
}

/** Volume of the cell without the grains, the lens of each overlap counted once, [m³]. */
export function poresOf({ radii, volume }, pairs) {
  let solid = 0;
  for (const radius of radii) solid += (4 / 3) * Math.PI * radius ** 3;
  for (let row = 0; row < pairs.count; row++) {
    const depth = -pairs.gap[row];
    if (!(depth > 0)) continue;
    const [r1, r2] = [radii[pairs.first[row]], radii[pairs.second[row]]];
    const d = r1 + r2 - depth;
    solid -= (Math.PI * depth ** 2 * (d ** 2 + 2 * d * (r1 + r2) - 3 * (r1 - r2) ** 2)) / (12 * d);
  }
  const pores = volume - solid;
  if (!(pores > 0))
    throw new RangeError(
      `grains: they fill ${rounded(solid, 6)} m³ of a cell of ${rounded(volume, 6)} m³; there are no pores`,
    );
  return pores;
}
