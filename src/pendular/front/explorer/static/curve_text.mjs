// A measured curve from its text: a table with units in its header, read as codes.measured_curve reads it.

import { sizeOf } from "./units.mjs";

const COLUMN_UNITS = { separation: "m", force: "N", error: "N", time: "s" };
const COLUMN_NAMES = {
  separation: ["separation", "distance", "gap", "d", "tip position", "tip sample separation", "displacement", "z"],
  force: ["force", "f", "load", "pull", "adhesion"],
  error: ["force error", "error", "sigma", "standard error", "uncertainty", "std"],
  time: ["time", "t"],
};
const LINE_ENDS = /\r\n|[\n\r\v\f\x1c-\x1e\x85\u2028\u2029]/;
const MOST_HEAD = 500; // lines before the numbers
const IS_NUMBER = /^[+-]?(?:(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?|inf|infinity|nan)$/i;
const DECIMAL_COMMAS = /^\s*[-+\d,eE]+(?:\s+[-+\d,eE]+)+\s*$/;

/** Columns of a table: their names, units and numbers. */
export function tableOf(text) {
  const lines = text.split(LINE_ENDS).filter((line) => line.trim());
  const first = lines.slice(0, MOST_HEAD).findIndex((line) => numbersIn(line) !== null);
  if (first < 0) throw new RangeError(`curve: holds no row of numbers in its first ${MOST_HEAD} lines`);
  const mark = markOf(lines[first]);
  const rows = [];
  for (const [i, line] of lines.slice(first).entries()) {
    const row = numbersIn(line, mark);
    if (row !== null && (!rows.length || row.length === rows[0].length)) rows.push(row);
    else if (!line.trimStart().startsWith("#"))
      throw new RangeError(
        `curve: has no ${rows[0].length} numbers in its row ${first + i + 1}, '${line.trim().slice(0, 40)}'`,
      );
  }
  const count = rows[0].length;
  const heads = lines.slice(0, first).map((line) => cellsOf(line.replace(/^[# ]+/, ""), mark));
  const names = heads.findLast((head) => head.length === count) ?? Array(count).fill("");
  return names.map((name, i) => ({ ...nameAndUnit(name), values: rows.map((row) => row[i]) }));
}

/** What stands between the cells; nothing but room where it is undefined. */
function markOf(line) {
  const mark = ["\t", ";"].find((one) => line.trim().includes(one));
  return mark ?? (line.includes(",") && !DECIMAL_COMMAS.test(line) ? "," : undefined);
}

function cellsOf(line, mark) {
  if (mark === undefined)
    return line
      .replaceAll(/\s+(?=[[(/])|(?<=\/)\s+/g, "") // a unit stays with its name
      .split(/\s+/)
      .filter(Boolean);
  const cells = [];
  let cell = "";
  let isQuoted = false;
  for (let i = 0; i < line.length; i++) {
    const sign = line[i];
    if (isQuoted && sign === '"' && line[i + 1] === '"')
      cell += line[++i]; // two are one
    else if (sign === '"' && (isQuoted || cell === "")) isQuoted = !isQuoted;
    else if (sign === mark && !isQuoted) {
      cells.push(cell.trim());
      cell = "";
    } else cell += sign;
  }
  return [...cells, cell.trim()];
}

/** Numbers of a row; null if it is not one. */
function numbersIn(line, given) {
  const mark = given ?? markOf(line);
  const cells = mark === undefined ? line.split(/\s+/).filter(Boolean) : cellsOf(line, mark);
  while (cells.length > 1 && !cells.at(-1)) cells.pop();
  const texts = cells.map((cell) => (mark === "," ? cell : cell.replaceAll(",", ".")));
  if (!texts.length || !texts.every((text) => IS_NUMBER.test(text))) return null;
  return texts.map((text) => Number(text.replace(/inf(?:inity)?/i, "Infinity")));
}

/** Name of a column and its unit, empty if it tells none. */
function nameAndUnit(head) {
  const found = /^(.*?)\s*[[(]\s*([^\])]+?)\s*[\])]\s*$/.exec(head) ?? /^(.*?)\s*\/\s*(\S+)\s*$/.exec(head);
  if (found) return { name: found[1], unit: found[2] };
  const parts = head.split("_");
  const at = parts.findIndex(
    (part, i) => i > 0 && part.length < 4 && ["m", "N", "s"].some((unit) => sizeIn(part, unit)),
  );
  if (at < 0) return { name: head, unit: "" };
  return { name: parts.filter((_, i) => i !== at).join("_"), unit: parts[at] };
}

/** Size of a unit in an SI unit; 0 if it is of another dimension or none. */
function sizeIn(own, unit) {
  const found = own ? sizeOf(own) : undefined;
  return found?.[0] === unit ? found[1] : 0;
}

/** The curve of a table in SI units, attraction positive; `columns` are the places of separation and force if chosen. */
export function curveOf(table, columns, sign) {
  const found = {};
  for (const [i, what] of ["separation", "force"].entries()) {
    const column = columns[i] === undefined ? likelyColumn(table, what) : table[columns[i]];
    if (!column.unit)
      throw new RangeError(`units: column '${column.name}' has none; write ${column.name || what} (um) in its header`);
    const size = sizeIn(column.unit, COLUMN_UNITS[what]);
    if (!size) throw new RangeError(`units: '${column.unit}' of column '${column.name}' is not a unit of ${what}`);
    found[what] = column.values.map((value) => value * size);
  }
  for (const what of ["error", "time"]) {
    const unit = COLUMN_UNITS[what];
    const likely = table.filter((one) => COLUMN_NAMES[what].includes(keyOf(one.name)) && sizeIn(one.unit, unit));
    if (likely.length === 1) found[what] = likely[0].values.map((value) => value * sizeIn(likely[0].unit, unit));
  }
  for (const [what, values] of Object.entries(found)) {
    const wrong = values.findIndex((value) => !Number.isFinite(value));
    if (wrong >= 0) throw new RangeError(`curve: has no number in row ${wrong + 1} of ${what}`);
  }
  return {
    separation: found.separation,
    force: found.force.map((one) => sign * one),
    forceError: found.error ?? null,
    time: found.time ?? null,
  };
}

const keyOf = (name) =>
  name
    .replaceAll(/[\s_-]+/g, " ")
    .trim()
    .toLowerCase();

/** The one column of a quantity by its name, or by its unit. */
function likelyColumn(table, what) {
  const byName = table.filter(({ name }) => COLUMN_NAMES[what].includes(keyOf(name)));
  const byUnit = table.filter(
    ({ name, unit }) => sizeIn(unit, COLUMN_UNITS[what]) && !COLUMN_NAMES.error.includes(keyOf(name)),
  );
  const likely = [byName, byUnit].find((columns) => columns.length === 1);
  if (likely) return likely[0];
  const names = table.flatMap(({ name }) => (name ? [`'${name}'`] : []));
  const known = names.join(", ") || `${table.length} columns without names`;
  throw new RangeError(`columns: which is the ${what} is not told by its header, ${known}; choose both columns`);
}
