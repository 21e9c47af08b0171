// A heap at a suction: which pairs hold a bridge on drying and on wetting, its water, and the stress it carries.
//
// As `wet` and `retention` of the package have it: a bridge stands up to its rupture; a new one forms where grains
// touch, or, where bridges condense, where its grand potential is not above that of dry grains. Grains that overlap
// count as touching.

import { pairsOf, poresOf, takenOf } from "./pairs.mjs";

const ROUNDING = 1e-12; // of the cosine of an angle
const REACH_MARGIN = 1.05; // over the rupture distance between the largest grains

/** What stays the same at every suction from the least one on: the pairs that may hold a bridge, and the pores. */
export function settingOf(heap, angle, surfaceTension, leastSuction, solver, condensation = true) {
  const largest = { radius: heap.mostRadius, contactAngle: angle };
  const end = solver.rupture(largest, { surfaceTension, suction: leastSuction });
  const pairs = pairsOf(heap, REACH_MARGIN * Math.max(0, end?.separation ?? 0));
  return withPairs({ heap, angle, surfaceTension, leastSuction, condensation, pores: poresOf(heap, pairs) }, pairs);
}

/** The same with some of the pairs alone. */
export const settingOfRows = (setting, rows) => withPairs(setting, takenOf(setting.pairs, rows));

function withPairs(setting, pairs) {
  const { radii } = setting.heap;
  const solids = new Float64Array(4 * pairs.count);
  for (let row = 0; row < pairs.count; row++)
    solids.set([radii[pairs.first[row]], radii[pairs.second[row]], setting.angle, setting.angle], 4 * row);
  return { ...setting, pairs, solids, gaps: pairs.gap.map((gap) => Math.max(0, gap)) };
}

/** What a bridge of each pair would be at a suction, from the exact solver. */
export function answersAt(setting, suction, solver) {
  const { pairs, solids, gaps, surfaceTension, angle, heap, condensation } = setting;
  const rows = solver.rows(solids, gaps, { surfaceTension, suction });
  const at = Object.fromEntries(rows.fields.map((name, i) => [name, i]));
  const width = rows.fields.length;
  const number = (row, name) => rows.numbers[width * row + at[name]];
  const forms = new Uint8Array(pairs.count);
  const cosine = Math.cos(angle);
  for (let row = 0; row < pairs.count; row++) {
    if (!rows.exists[row]) continue;
    const wetted = number(row, "wetted_area1") + number(row, "wetted_area2");
    const energy = number(row, "area") - cosine * wetted + number(row, "curvature") * number(row, "volume");
    // in an overlap the potential goes on with the force of contact
    const potential = surfaceTension * energy + number(row, "force") * Math.min(0, pairs.gap[row]);
    forms[row] = Number(pairs.gap[row] <= heap.rounding || (condensation && potential <= 0));
  }
  return { suction, exists: rows.exists, forms, number };
}

/** Rows of the pairs that hold a bridge on a main branch. */
export function membersOf({ exists, forms }, path) {
  const holds = (row) => exists[row] && (path === "drying" || forms[row]);
  return Array.from(exists.keys()).filter(holds);
}

/** Water and stress of a heap with some of its bridges, by the names of the package. */
export function wettedOf(setting, answers, members) {
  const { heap, pairs, pores } = setting;
  const sums = { volume: 0, force: 0, area: 0 };
  const stress = [0, 0, 0, 0, 0, 0]; // xx, yy, zz, xy, xz, yz
  for (const row of members) {
    const force = answers.number(row, "force");
    sums.volume += answers.number(row, "volume");
    sums.force += force;
    sums.area += answers.number(row, "area");
    const [x, y, z] = pairs.normal.subarray(3 * row, 3 * row + 3);
    const size = (force * pairs.length[row]) / heap.volume;
    for (const [k, dyad] of [x * x, y * y, z * z, x * y, x * z, y * z].entries()) stress[k] += size * dyad;
  }
  const suctionStress = (stress[0] + stress[1] + stress[2]) / 3;
  const met = meetingsOf(setting, answers, members);
  return {
    bridges: members.length,
    liquid_volume: sums.volume,
    saturation: sums.volume / pores,
    water_content: sums.volume / heap.volume,
    mean_force: sums.force / members.length, // NaN without a bridge
    suction_stress: suctionStress,
    chi: suctionStress / answers.suction,
    interface_area: sums.area / heap.volume,
    coordination: (2 * members.length) / heap.count,
    meeting_grains: met.grains / heap.count,
    meeting_liquid: met.grains ? met.liquid / sums.volume : 0,
    porosity: pores / heap.volume,
    stress,
  };
}

/** Two bridges meet on a grain where their half-filling angles add up to the angle between them. */
export function meetingsOf({ heap, pairs }, answers, members) {
  const ends = Array.from({ length: heap.count }, () => []);
  for (const row of members) {
    const normal = pairs.normal.subarray(3 * row, 3 * row + 3);
    ends[pairs.first[row]].push({ row, normal, sign: 1, filling: answers.number(row, "filling1") });
    ends[pairs.second[row]].push({ row, normal, sign: -1, filling: answers.number(row, "filling2") });
  }
  const meeting = new Set();
  let grains = 0;
  for (const own of ends) {
    let isMet = false;
    for (let a = 0; a < own.length; a++)
      for (let b = a + 1; b < own.length; b++)
        if (meet(own[a], own[b])) {
          isMet = true;
          meeting.add(own[a].row).add(own[b].row);
        }
    grains += Number(isMet);
  }
  let liquid = 0;
  for (const row of meeting) liquid += answers.number(row, "volume");
  return { grains, liquid, rows: [...meeting].sort((a, b) => a - b) };
}

function meet(one, other) {
  const [a, b] = [one.normal, other.normal];
  const cosine = one.sign * other.sign * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
  const together = one.filling + other.filling;
  return together >= Math.PI || Math.cos(together) <= cosine + ROUNDING;
}
