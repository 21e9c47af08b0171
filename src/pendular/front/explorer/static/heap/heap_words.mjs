// Pieces of the heap's view as HTML and as files: the state in a line, the numbers, what can be taken away.

import { quantityNamed } from "./heap_view.mjs";
import { HEAP_RECORDS } from "./heap_records.mjs";
import { membersOf } from "./wetted.mjs";
import { rounded, show } from "../units.mjs";
import { python, tile } from "../words.mjs";

const PERCENT = ["saturation", "water_content", "meeting_grains", "meeting_liquid"];

const percent = (share) => `${rounded(100 * share, 4)}\u00a0%`;

/** A quantity with its unit, for people. */
function shown(name, value) {
  if (PERCENT.includes(name)) return percent(value);
  return show(value, quantityNamed(name)?.unit ?? "", 4);
}

/** Water, bridges and stress, large. */
export function heapTilesOf({ view, values, bridges, answers }) {
  const kept = bridges.filter(({ isKept }) => isKept).length;
  const onDrying = kept ? `${kept} on drying alone` : "as on wetting";
  const other = view.path === "drying" ? onDrying : `${membersOf(answers, "drying").length} on drying`;
  const meeting = `bridges meet on ${percent(values.meeting_grains)}`; // of the grains: then bridges overlap
  const liquid = `${show(values.liquid_volume, "m^3", 4)} of liquid`;
  return [
    tile("saturation", "Saturation", percent(values.saturation), values.meeting_grains ? meeting : liquid),
    tile("bridges", "Bridges", String(values.bridges), other),
    tile(
      "force",
      "Suction stress",
      show(values.suction_stress, "Pa", 4),
      `mean force ${show(values.mean_force, "N", 4)}`,
    ),
  ].join("");
}

/** The state in a sentence, for those who hear the page. */
export function heapSpoken({ question, values, view }) {
  return (
    `${question.heap.count} grains, on ${view.path}, suction ${show(question.suction, "Pa", 3)}: ` +
    `${values.bridges} bridges, saturation ${percent(values.saturation)}, suction stress ${show(values.suction_stress, "Pa", 3)}.`
  );
}

/** What the picture shows, for those who cannot see it. */
export const heapInWords = ({ question, values }) =>
  `${question.heap.count} grains of radius ${radiiInWords(question.heap)} and ${values.bridges} bridges between them`;

export function radiiInWords({ leastRadius, mostRadius }) {
  const [least, most] = [leastRadius, mostRadius].map((radius) => show(radius, "m", 4));
  return least === most ? least : `${least} to ${most}`;
}

/** All quantities with their units and meanings, as rows of a table. */
export function heapNumbersOf({ question, values }, curves) {
  const row = (name, value, meaning) =>
    `<tr><th scope="row">${name}<span class="meaning">${meaning}</span></th><td><span>${value}</span></td></tr>`;
  const rows = HEAP_RECORDS.quantities.map(({ name, meaning }) =>
    row(name.replaceAll("_", " "), shown(name, values[name]), meaning),
  );
  const limits = curves ? Object.values(curves.limits).map((limit) => show(limit, "Pa", 5)) : ["…"];
  rows.push(
    row("porosity", show(values.porosity, "", 4), `pores over the cell, of ${question.heap.count} grains`),
    row("pendular limit", [...new Set(limits)].join(", "), "bridges meet below it, on drying and on wetting"),
  );
  return rows.join("");
}

// -- To take away -----------------------------------------------------------------------------------------------------

const STRESS = [
  ["11", 0],
  ["22", 1],
  ["33", 2],
  ["23", 5],
  ["13", 4],
  ["12", 3],
];

/** Both branches, in the columns of `pendular packing --retention --csv`. */
export function heapCsvOf({ suctions, branches }) {
  const names = HEAP_RECORDS.quantities.filter(({ isOfCurve }) => isOfCurve).map(({ name }) => name);
  const titles = ["path", "suction", ...names, ...STRESS.map(([axes]) => `stress_${axes}`)];
  const rows = Object.entries(branches).flatMap(([path, states]) =>
    states.map((state, k) => [
      path,
      suctions[k],
      ...names.map((name) => state[name] ?? NaN),
      ...STRESS.map(([, place]) => state.stress[place]),
    ]),
  );
  return `${[titles, ...rows].map((row) => row.join(",")).join("\n")}\n`;
}

/** Program that prints the same numbers for the grains of a file, and the same curves. */
export function heapProgramOf({ question, view }, range, points) {
  const { heap, degrees, liquid, suction } = question;
  const dry = question.condensation ? "" : ", condensation=False";
  const wetting =
    liquid.temperature === undefined
      ? `pl.Liquid(surface_tension=${python(liquid.surfaceTension)})`
      : `pl.Liquid.named("${liquid.name}", temperature=${python(liquid.temperature)})`;
  const cell = heap.cell ? `, cell=(${heap.cell.map(python).join(", ")})` : "";
  return [
    "import numpy as np",
    "import pendular as pl",
    "",
    'grains = np.loadtxt("grains.txt")  # x y z r, from the button above',
    `heap = pl.Packing(grains[:, :3], grains[:, 3]${cell})`,
    `liquid = ${wetting}`,
    `angle = np.deg2rad(${python(rounded(degrees, 15))})`,
    `w = pl.wet(heap, angle, suction=${python(suction)}, liquid=liquid, path="${view.path}"${dry})`,
    'print(f"{len(w.bridges)} bridges, saturation {w.saturation:.6e}, suction stress {w.suction_stress:.6e} Pa")',
    "",
    `suctions = np.geomspace(${python(range.low)}, ${python(range.high)}, ${points})`,
    `curves = pl.retention(heap, angle, suctions, liquid=liquid, reversals=[]${dry})`,
    "print(curves.saturation.values)",
    "",
  ].join("\n");
}
