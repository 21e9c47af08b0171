// Quantities as people write and read them: "50um" into SI numbers, and SI numbers into "50 µm".

const NUMBER = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*?)\s*$/i;
const DECADES = { "": 0, f: -15, p: -12, n: -9, u: -6, µ: -6, μ: -6, m: -3, c: -2, d: -1, h: 2, k: 3, M: 6, G: 9 };
const PREFIXED = /^(f|p|n|u|µ|μ|m|c|d|h|k|M|G)?(m|L|l|Pa|bar|N|dyn|s)$/;

// SI unit of each base, and its size in it.
const BASES = {
  m: ["m", 1],
  L: ["m^3", 1e-3],
  l: ["m^3", 1e-3],
  Pa: ["Pa", 1],
  bar: ["Pa", 1e5],
  N: ["N", 1],
  dyn: ["N", 1e-5],
  s: ["s", 1],
};
const SINGLE = {
  Å: ["m", 1e-10],
  angstrom: ["m", 1e-10],
  in: ["m", 0.0254],
  inch: ["m", 0.0254],
  micron: ["m", 1e-6],
  atm: ["Pa", 101325],
  psi: ["Pa", 6894.757293168361],
  mmHg: ["Pa", 133.322387415],
  torr: ["Pa", 101325 / 760],
  "dyn/cm": ["N/m", 1e-3],
  min: ["s", 60],
  h: ["s", 3600],
  d: ["s", 86400],
  deg: ["deg", 1],
  rad: ["deg", 180 / Math.PI],
  K: ["K", 1],
};

// SI units as they are shown: the base that carries the prefix, the rest, its power, and its size in the SI unit.
const SHOWN = {
  m: ["m", "", 1, 1],
  "m^2": ["m", "²", 2, 1],
  "m^3": ["L", "", 1, 1e-3],
  Pa: ["Pa", "", 1, 1],
  N: ["N", "", 1, 1],
  "N/m": ["N", "/m", 1, 1],
  J: ["J", "", 1, 1],
};
const PREFIXES = ["y", "z", "a", "f", "p", "n", "µ", "m", "", "k", "M", "G"]; // from 1e-24 on

export const rounded = (value, digits) => Number(value.toPrecision(digits));

/** SI number of a text such as "50um"; zero needs no unit, but for a temperature. */
export function readQuantity(name, text, unit, example) {
  const [number, own] = split(name, text, example);
  if (!own) {
    if (number === 0 && unit !== "K") return 0;
    throw new RangeError(`${name}: '${text}' has no unit; write it like ${example}`);
  }
  if (unit === "K" && own === "degC") return rounded(number + 273.15, 15);
  if (unit === "K" && own === "degF") return rounded((number + 459.67) / 1.8, 15);
  const found = sizeOf(own);
  if (!found) throw new RangeError(`${name}: '${text}' has the unknown unit '${own}'; write it like ${example}`);
  if (found[0] !== unit)
    throw new RangeError(`${name}: '${text}' is not a quantity in ${unit}; write it like ${example}`);
  return rounded(number * found[1], 15);
}

/** Degrees of a text such as "20" or "0.35 rad". */
export function readDegrees(name, text) {
  const [number, own] = split(name, text, "20deg");
  return own ? readQuantity(name, text, "deg", "20deg") : number;
}

/** Pure number of a text such as "0.9" or "90%". */
export function readFraction(name, text) {
  const [number, own] = split(name, text, "90%");
  if (own !== "" && own !== "%")
    throw new RangeError(`${name}: '${text}' is not a pure number; write it like 90% or 0.9`);
  if (!own && number > 1) throw new RangeError(`${name}: '${text}' is above 1; per cent have their sign, 90%`);
  return own ? number / 100 : number;
}

function split(name, text, example) {
  const found = NUMBER.exec(text.replace("°C", "degC").replace("°F", "degF").replace("°", "deg").replace("−", "-"));
  if (!found) throw new RangeError(`${name}: '${text}' does not begin with a number; write it like ${example}`);
  return [Number(found[1]), found[2]];
}

/** SI unit and size of a unit as it is written, undefined for one that is not known. */
export function sizeOf(own) {
  if (Object.hasOwn(SINGLE, own)) return SINGLE[own];
  const cube = /^(.*?)(?:\^3|\*\*3|³)$/.exec(own);
  const perMetre = /^(.*)\/m$/.exec(own);
  const inner = PREFIXED.exec(cube?.[1] ?? perMetre?.[1] ?? own);
  if (!inner) return undefined;
  const [unit, size] = BASES[inner[2]];
  const power = cube ? 3 : 1;
  const whole = size ** power * 10 ** (power * DECADES[inner[1] ?? ""]);
  if (cube) return unit === "m" ? ["m^3", whole] : undefined;
  if (perMetre) return unit === "N" ? ["N/m", whole] : undefined;
  return [unit, whole];
}

/** Factor and name of the unit with the SI prefix in which a value is from 1 to 1000, or nearly so. */
export function scaleOf(value, unit) {
  if (!Object.hasOwn(SHOWN, unit)) return unit === "rad" ? { factor: 180 / Math.PI, unit: "°" } : { factor: 1, unit };
  const [base, rest, power, size] = SHOWN[unit];
  const amount = Math.abs(value) / size;
  const decades = Number.isFinite(amount) && amount > 0 ? Math.log10(amount) : 0;
  const step = Math.min(Math.max(Math.floor((decades + 1e-9) / (3 * power)), -8), 3);
  return { factor: 10 ** (-3 * step * power) / size, unit: PREFIXES[step + 8] + base + rest };
}

/** A value with its unit, for people. */
export function show(value, unit, digits = 5) {
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const scale = scaleOf(rounded(value, digits), unit);
  const number = signed(String(rounded(value * scale.factor, digits) + 0));
  return (scale.unit === "°" ? number + scale.unit : `${number}\u00a0${scale.unit}`).trimEnd();
}

/** A number with a minus sign of the length of a plus. */
export const signed = (text) => text.replaceAll("-", "−");
