// A fit in words: values with errors to the digits that they have, as fitting.words; and what can be taken away.

import { general } from "./general.mjs";
import { RECORDS } from "./records.mjs";
import { scaleOf, show, signed } from "./units.mjs";
import { optionsOf } from "./view.mjs";
import { optionWords, plainText, python, solidsInPython } from "./words.mjs";

const FIT_UNITS = RECORDS.fitting.UNITS;
const MOST_PLACES = 12;

/** Value and error of a free number, as texts with their units. */
export function valueWords(fit, name) {
  const [value, error, bound] = [fit.values[name], fit.errors[name], fit.upper[name]];
  const { factor, unit } = scaleOfNumber(name, Math.max(Math.abs(value), Number.isFinite(error) ? error : 0));
  const told = (number, places) => `${(factor * number).toFixed(places)}${unit}`;
  if (bound !== undefined) {
    const places = Math.max(1 - Math.floor(Math.log10(factor * bound)), 0);
    return [told(value, places), `below ${told(bound, places)} (95 %)`];
  }
  if (!Number.isFinite(error)) return [`${general(factor * value, 4)}${unit}`, "not fixed by these data"];
  if (error === 0) return [`${general(factor * value, 6)}${unit}`, `± 0${unit}`];
  const places = 1 - Math.floor(Math.log10(factor * error));
  if (places > MOST_PLACES) return [`${general(factor * value, 12)}${unit}`, `± ${general(factor * error, 2)}${unit}`];
  if (places >= 0) return [told(value, places), `± ${told(error, places)}`];
  const whole = (number) => `${Math.round(factor * number * 10 ** places) / 10 ** places}${unit}`;
  return [whole(value), `± ${whole(error)}`];
}

/** Factor and unit, with the room before it, in which a number of a fit is shown. */
function scaleOfNumber(name, size) {
  if (name.startsWith("contact_angle")) return { factor: 180 / Math.PI, unit: "°" };
  if (!FIT_UNITS[name]) return { factor: 1, unit: "" };
  const perSecond = FIT_UNITS[name].endsWith("/s");
  const { factor, unit } = scaleOf(size, FIT_UNITS[name].replace("/s", ""));
  return { factor, unit: `\u00a0${unit}${perSecond ? "/s" : ""}` };
}

/** What was found, as the rows of a table, and lines below it. */
export function fitWords(fit) {
  const row = (name, value, note) =>
    `<tr><th scope="row">${name}</th><td>${signed(value)}</td><td>${signed(note)}</td></tr>`;
  const rows = fit.names.map((name) => row(name.replaceAll("_", " "), ...valueWords(fit, name)));
  const { ruptureSeparation: rupture, measuredRupture: measured, rms } = fit;
  if (rupture > 0) {
    const datum = measured ? `measured ${show(measured[0], "m", 4)} ± ${show(measured[1], "m", 2)}` : "";
    rows.push(row("rupture", show(rupture, "m", 4), datum));
  }
  const largest = Math.max(...fit.force.map(Math.abs));
  rows.push(row("residuals, rms", show(rms, "N", 3), `${general((100 * rms) / largest, 2)} % of the largest force`));
  const pairs = fit.correlation.flatMap((line, i) =>
    line.slice(0, i).flatMap((value, j) => (Number.isFinite(value) ? [pairWords(fit.names, i, j, value)] : [])),
  );
  const { length } = fit.force;
  const lines = [`${length} points, ${fit.degreesOfFreedom} degrees of freedom, χ² ${general(fit.chiSquare, 4)}.`];
  if (pairs.length) lines.push(`Correlation: ${pairs.join("; ")}.`);
  return { rows: rows.join(""), lines: lines.map(signed), notes: fit.notes.map(noteWords) };
}

const pairWords = (names, i, j, value) =>
  `${names[i]} and ${names[j]} ${value < 0 ? "" : "+"}${value.toFixed(3)}`.replaceAll("_", " ");

const noteWords = (note) => signed(note[0].toUpperCase() + note.slice(1).replaceAll("_", " "));

// -- To take away ----------------------------------------------------------------------------------------------------

const dashed = (name) => name.replaceAll("_", "-");

/** Command that finds the same. */
export function fitCommandOf({ view, columns, attraction, free, rupture, ruptureText, loss, forceErrorText }) {
  const { separation, ...asked } = optionsOf(view);
  const options = { ...asked, free: free.map(dashed).join(",") };
  if (columns) options.columns = columns.join(",");
  if (attraction === "negative") options.attraction = attraction;
  if (rupture !== null) options.rupture = ruptureText;
  if (forceErrorText) options["force-error"] = forceErrorText;
  if (loss !== "linear") options.loss = loss;
  return `pendular fit curve.csv ${optionWords(options)}`;
}

/** Program that finds the same. */
export function fitProgramOf({ question, columns, attraction, free, rupture, loss, forceError, isGivenError }) {
  const text = (value) => JSON.stringify(value);
  const reading = [
    ...(columns ? [`, columns=(${columns.map(text).join(", ")})`] : []),
    ...(attraction === "negative" ? [', attraction="negative"'] : []),
  ].join("");
  const options = [
    `${question.control}=${python(question.value)}`,
    "liquid=liquid",
    `free=(${free.map(text).join(", ")}${free.length === 1 ? "," : ""})`,
    ...(isGivenError ? [`force_error=${python(forceError[0])}`] : forceError ? ["force_error=curve.force_error"] : []),
    ...(free.includes("evaporation_rate") ? ["time=curve.time"] : []),
    ...(rupture === null ? [] : [`rupture=${typeof rupture === "string" ? text(rupture) : python(rupture)}`]),
    ...(loss === "linear" ? [] : [`loss=${text(loss)}`]),
  ];
  return [
    "import numpy as np",
    "import pendular as pl",
    "",
    `curve = pl.read_curve("curve.csv"${reading})`,
    ...solidsInPython(question),
    "fit = pl.fit(",
    "    curve.separation,",
    "    curve.force,",
    "    pair,",
    ...options.map((option) => `    ${option},`),
    ")",
    "for name in fit.free:",
    '    print(f"{name} {fit.values[name]:.6g} +- {fit.errors[name]:.2g}")',
    "",
  ].join("\n");
}

/** The curve, the fit and what is left, in the columns of `pendular fit --csv`. */
export function fitCsvOf(fit) {
  const columns = ["separation", "force", "forceError", "fitted", "residuals"];
  const titles = ["separation [m]", "force [N]", "force_error [N]", "fitted [N]", "residuals [N]"];
  const rows = fit.separation.map((_, i) => columns.map((name) => String(fit[name][i])).join(","));
  return `${[titles.join(","), ...rows].join("\n")}\n`;
}

/** Lines as paragraphs. */
export const paragraphs = (lines, role) => lines.map((line) => `<p class="${role}">${plainText(line)}</p>`).join("");
