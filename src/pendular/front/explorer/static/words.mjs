// Pieces of the page as HTML: the answer in a line, the table of numbers, what can be taken away.

import { solidsInWords } from "./picture.mjs";
import { solidInPython } from "./kinds.mjs";
import { RECORDS } from "./records.mjs";
import { show, rounded } from "./units.mjs";
import { fieldOf } from "./chart.mjs";
import { optionsOf } from "./view.mjs";

/** Text that stands in HTML as it is. */
export const plainText = (text) => text.replace(/[&<>"']/g, (sign) => `&#${sign.charCodeAt(0)};`);

/** Force and rupture distance, large; the other quantity that matters beside them. */
export function tilesOf({ state, rupture, lowerEnd, view, isFailure }) {
  let nature = rupture ? "no bridge at this separation" : "no bridge between solids apart";
  if (isFailure) nature = "not known";
  if (state) nature = `${state.force >= 0 ? "attraction" : "repulsion"}, ${state.stable ? "stable" : "unstable"}`;
  const tiles = [tile("force", "Force", show(state?.force ?? (isFailure ? NaN : 0), "N", 4), nature)];
  if (rupture) {
    const begins = lowerEnd ? `begins at ${show(lowerEnd.separation, "m", 4)}` : "";
    tiles.push(tile("rupture", "Rupture at", show(rupture.separation, "m", 4), begins));
  }
  if (state) {
    const [name, unit] = view.control === "volume" ? ["suction", "Pa"] : ["volume", "m^3"];
    tiles.push(tile("other", name[0].toUpperCase() + name.slice(1), show(state[name], unit, 4), ""));
  }
  return tiles.join("");
}

export const tile = (role, name, value, note) =>
  `<div class="tile ${role}"><span class="name">${name}</span><span class="value">${value}</span><span class="note">${note}</span></div>`;

/** The answer in a sentence, for those who hear the page. */
export function spoken({ question, state, rupture }) {
  const force = state ? `Force ${show(state.force, "N", 3)}` : "No bridge";
  return `${solidsInWords(question)}. ${force} at ${show(question.separation, "m", 3)}${rupture ? `, breaks at ${show(rupture.separation, "m", 3)}` : ""}.`;
}

/** All fields of the bridge with their units and meanings, as rows of a table. */
export function numbersOf({ state, rupture, question, isFailure }) {
  const row = (name, value, meaning) =>
    `<tr><th scope="row">${name}<span class="meaning">${meaning}</span></th><td>${value}</td></tr>`;
  if (isFailure) return row("force", show(NaN, "N"), "the solver failed");
  if (!state) return row("force", show(0, "N"), "no bridge at this separation");
  const rows = [];
  for (const { name, unit, meaning, endings } of RECORDS.fields) {
    const value = valueIn(name, state, question);
    const parts = endings.length ? value.map((one) => show(one, unit)) : [inWords(value, unit)];
    const isPair = parts.length === 2 && parts[0] === parts[1] && name !== "capillary_tensor";
    rows.push(
      row(
        name.replaceAll("_", " "),
        isPair ? `<span>${parts[0]}</span> each` : parts.map((part) => `<span>${part}</span>`).join(", "),
        meaning,
      ),
    );
    if (name === "force" && rupture)
      rows.push(row("rupture distance", show(rupture.separation, "m"), "separation at which the bridge breaks"));
  }
  return rows.join("");
}

const inWords = (value, unit) =>
  typeof value === "boolean"
    ? value
      ? "yes"
      : "no"
    : unit || !Number.isInteger(value)
      ? show(value, unit)
      : String(value);

/** A field of a state; what was asked is told as it was asked. */
function valueIn(name, state, question) {
  if (name === "exists") return true;
  if (name === "separation") return question.separation;
  if (name === "suction" && question.held.suction !== undefined) return question.held.suction;
  if (name === "volume" && question.held.volume !== undefined) return question.held.volume;
  return state[fieldOf(name)];
}

// -- To take away -------------------------------------------------------------------------------------------------------

/** Command that prints the same answer. */
export const commandOf = (view) => `pendular bridge ${optionWords(optionsOf(view))}`;

/** Options as words of a shell. */
export function optionWords(options) {
  const quoted = (text) => (/^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replaceAll("'", `'"'"'`)}'`);
  return Object.entries(options)
    .map(([name, text]) => `--${name} ${quoted(text)}`)
    .join(" ");
}

/** Program that prints the same force. */
export function programOf({ question }) {
  const { control, value, separation } = question;
  return [
    "import numpy as np",
    "import pendular as pl",
    "",
    ...solidsInPython(question),
    `b = pl.bridge(pair, ${python(separation)}, ${control}=${python(value)}, liquid=liquid)`,
    'print(f"{b.force:.6e} N")',
    "",
  ].join("\n");
}

/** Lines of a program that make the pair and the liquid. */
export function solidsInPython({ pair, degrees, liquid }) {
  const both = (first, second) => (first === second ? first : `(${first}, ${second})`);
  const solids = pair.solids ?? pair.radius.map((radius) => ({ radius }));
  const radii = both(...solids.map((solid) => solidInPython(solid, python)));
  const angles = both(...degrees.map((angle) => `np.deg2rad(${python(rounded(angle, 15))})`));
  const wetting =
    liquid.temperature === undefined
      ? `pl.Liquid(surface_tension=${python(liquid.surfaceTension)})`
      : `pl.Liquid.named("${liquid.name}", temperature=${python(liquid.temperature)})`;
  return [`pair = pl.Pair(radius=${radii}, contact_angle=${angles})`, `liquid = ${wetting}`];
}

/** A number as Python has a float. */
export const python = (number) => (Number.isInteger(number) && Math.abs(number) < 1e16 ? `${number}.0` : String(number));

/** The states of a curve, in the columns of `pendular curve --csv`. */
export function csvOf(states, question) {
  const columns = RECORDS.fields.flatMap(({ name, unit, endings }) =>
    (endings.length ? endings : [""]).map((ending, i) => ({
      title: `${name}${ending && `_${ending}`}${unit && ` [${unit}]`}`,
      value: (state) =>
        endings.length
          ? state[fieldOf(name)][i]
          : name === "exists"
            ? true
            : name in question.held
              ? question.held[name]
              : state[fieldOf(name)],
    })),
  );
  const cell = (value) => (Number.isNaN(value) ? "nan" : String(value).replace("Infinity", "inf"));
  const rows = states.map((state) => columns.map(({ value }) => cell(value(state))).join(","));
  return `${[columns.map(({ title }) => title).join(","), ...rows].join("\n")}\n`;
}
