// What the page shows: the options of the command line as texts, the address that carries them, and what they ask.

import {
  ENDINGS,
  FIRST_SOLIDS,
  hasOthers,
  optionOfSolid,
  readSolid,
  refuseSeparation,
  sizeOfSolids,
  solidAt,
} from "./kinds.mjs";
import { liquidNamed, suctionFromHumidity } from "./liquids.mjs";
import { RECORDS } from "./records.mjs";
import { readDegrees, readFraction, readQuantity, rounded } from "./units.mjs";

export const HELD = ["suction", "volume", "humidity"];
const PLANE = "plane";
const ANY_LENGTH = 1e-6; // where a question has none

/** All that a person can set; an empty text is an option that is left out. */
export const FIRST_VIEW = Object.freeze({
  radius: "50 µm",
  radius2: "50 µm",
  ...FIRST_SOLIDS,
  "contact-angle": "20°",
  "contact-angle2": "", // as the first
  liquid: "water",
  temperature: "20 °C",
  "surface-tension": "", // if given, instead of liquid and temperature
  control: "suction",
  value: "5 kPa",
  separation: "3 µm",
  plot: "force",
  laws: Object.freeze([]),
  map: "force",
  across: "control",
});
const FIRST_VALUES = { suction: "5 kPa", volume: "1 pL", humidity: "99.9 %" };

export const isPlane = (text) => text.trim().toLowerCase() === PLANE;

/** Options by which the command line asks what a view shows. */
export function optionsOf(view) {
  const given = { "contact-angle": view["contact-angle"] };
  if (view["contact-angle2"]) given["contact-angle2"] = view["contact-angle2"];
  if (view["surface-tension"]) given["surface-tension"] = view["surface-tension"];
  else Object.assign(given, { liquid: view.liquid, temperature: view.temperature });
  Object.assign(given, { [view.control]: view.value, separation: view.separation });
  const solids = ENDINGS.map((ending) => optionOfSolid(view, ending));
  const others = Object.entries(given).map(([name, text]) => [name, name === "liquid" ? text : bare(text)]);
  return Object.fromEntries([...solids, ...others]);
}

/** What stands after the # of an address. */
export function hashOf(view) {
  const parts = optionsOf(view);
  for (const name of ["plot", "map", "across"]) if (view[name] !== FIRST_VIEW[name]) parts[name] = view[name];
  if (view.laws.length) parts.laws = view.laws.join(",");
  return Object.entries(parts)
    .map(([name, text]) => `${name}=${encodeURIComponent(text).replaceAll("%2C", ",").replaceAll("%3A", ":")}`)
    .join("&");
}

/** The view of an address; RangeError for a parameter that no view has. */
export function viewAt(hash) {
  const texts = Object.fromEntries(new URLSearchParams(hash.replaceAll("+", "%2B")));
  const view = { ...FIRST_VIEW };
  const held = HELD.filter((name) => name in texts);
  if (held.length > 1) throw new RangeError(`control: ${held.join(" and ")} given; only one of the three can be held`);
  for (const name of held) {
    view.control = name;
    view.value = spaced(texts[name]);
    delete texts[name];
  }
  if ("laws" in texts) view.laws = texts.laws.split(",").filter(Boolean);
  for (const name of view.laws)
    oneOf(
      "laws",
      name,
      RECORDS.laws.map((law) => law.name),
    );
  delete texts.laws;
  takeSolids(texts, view);
  for (const [name, text] of Object.entries(texts)) {
    oneOf(
      "address",
      name,
      Object.keys(FIRST_VIEW).filter((own) => !["control", "value", "laws"].includes(own) && !(own in FIRST_SOLIDS)),
    );
    view[name] = spaced(/^contact-angle/.test(name) && /\d$/.test(text) ? `${text}°` : text);
  }
  oneOf("plot", view.plot, RECORDS.plotted);
  oneOf("across", view.across, ["control", "separation"]);
  return view;
}

/** Put the solids of an address into a view; the second is as the first, if that is no sphere and none is told. */
function takeSolids(texts, view) {
  if ("solid" in texts && !("solid2" in texts || "radius2" in texts)) texts.solid2 = texts.solid;
  for (const ending of ENDINGS) {
    const [radius, solid] = [`radius${ending}`, `solid${ending}`];
    if (!(solid in texts)) continue;
    if (radius in texts) throw new RangeError(`${solid}: given together with ${radius}; one of the two is needed`);
    Object.assign(view, solidAt(texts[solid], ending));
    delete texts[solid];
  }
}

export function oneOf(name, value, known) {
  if (!known.includes(value)) throw new RangeError(`${name}: '${value}' is not one of ${known.join(", ")}`);
}

const QUANTITY = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*([^\d\s.+-].*)$/i;
const isNumber = (text) => text !== "" && Number.isFinite(Number(text));

/** A quantity as it is typed in a shell. */
export function bare(text) {
  const simple = text.trim().replaceAll(/[µμ]/g, "u").replace("°C", "degC").replace(/°$/, "").replace("−", "-");
  return isNumber(simple) ? simple : simple.replace(QUANTITY, "$1$2");
}

/** A quantity as it is shown to people, the inverse of `bare`. */
export function spaced(text) {
  const found = isNumber(text) ? null : QUANTITY.exec(text);
  if (!found || found[2] === "°") return text;
  return `${found[1]} ${found[2].replace("degC", "°C").replace(/^u/, "µ")}`;
}

/** The question of a view in SI units; RangeError in one line for what cannot be meant. */
export function questionOf(view) {
  const solids = ENDINGS.map((ending) => readSolid(view, ending, readRadius));
  const radius = solids.map((solid) => solid.radius ?? solid.tipRadius);
  const first = readContactAngle("contact-angle", view["contact-angle"]);
  const second = view["contact-angle2"] ? readContactAngle("contact-angle2", view["contact-angle2"]) : first;
  const liquid = readLiquid(view);
  const control = view.control;
  const value = readHeld(control, view.value);
  const suction = control === "humidity" ? suctionFromHumidity(value, liquid) : value;
  const degrees = [first, second];
  const contactAngle = degrees.map((angle) => angle * (Math.PI / 180));
  const separation = readQuantity("separation", view.separation, "m", "3um");
  const [small, large] = [Math.min(...radius), Math.max(...radius)];
  const question = {
    pair: { radius, contactAngle },
    degrees,
    liquid,
    control,
    value,
    held: { surfaceTension: liquid.surfaceTension, ...(control === "volume" ? { volume: value } : { suction }) },
    separation,
    meanRadius: small === Infinity ? Infinity : (2 * small) / (1 + small / large),
    arePlanes: small === Infinity,
  };
  if (hasOthers(view)) return { ...question, ...betweenSolids(question, solids) };
  refuseBeyondDomain(question);
  return question;
}

/** What of a question is another between solids of which one is neither a sphere nor a plane. */
function betweenSolids({ pair, held, separation }, solids) {
  refuseSeparation(solids, separation);
  const size = sizeOfSolids(solids);
  const own = held.volume ? Math.cbrt(held.volume) : held.surfaceTension / Math.abs(held.suction);
  return {
    pair: { ...pair, solids },
    meanRadius: size > 0 ? size : own < Infinity ? own : separation || ANY_LENGTH,
    hasSize: size > 0,
    arePlanes: false,
  };
}

function readRadius(name, text) {
  if (isPlane(text)) return Infinity;
  const size = readQuantity(name, text, "m", "50um");
  if (!(size > 0)) throw new RangeError(`${name}: '${text}' is not > 0; write it like 50um`);
  return size;
}

export function readContactAngle(name, text) {
  const degrees = readDegrees(name, text);
  if (!(degrees >= 0 && degrees < 180))
    throw new RangeError(`${name}: '${text}' is not in [0, 180) degrees; write it like 20, 20deg or 0.35rad`);
  return degrees;
}

export function readLiquid(view) {
  if (!view["surface-tension"])
    return liquidNamed(view.liquid, readQuantity("temperature", view.temperature, "K", "20degC"));
  const surfaceTension = readQuantity("surface-tension", view["surface-tension"], "N/m", "72.8mN/m");
  if (!(surfaceTension > 0)) throw new RangeError(`surface-tension: ${surfaceTension} N/m is not > 0`);
  return { surfaceTension };
}

function readHeld(control, text) {
  if (control === "suction") return readQuantity("suction", text, "Pa", "20kPa");
  if (control === "volume") {
    const volume = readQuantity("volume", text, "m^3", "5pL");
    if (!(volume > 0)) throw new RangeError(`volume: ${volume} m^3 is not > 0`);
    return volume;
  }
  const humidity = readFraction("humidity", text);
  if (!(humidity > 0 && humidity < 1))
    throw new RangeError(`humidity: ${humidity} is not in (0, 1); saturation is a suction of 0`);
  return humidity;
}

function refuseBeyondDomain({ pair, held, control, separation, meanRadius, arePlanes }) {
  const { deepestOverlap, narrowest, leastVolume, mostVolume, mostSuction } = RECORDS.domain;
  const brief = (value) => rounded(value, 6);
  if (arePlanes) {
    if (control !== "volume")
      throw new RangeError(
        `${control}: holds no stable bridge between two planes, which dries up or floods the gap; hold a volume`,
      );
    const least = narrowest * Math.cbrt(held.volume);
    if (!(separation > 0))
      throw new RangeError(`separation: ${separation} m is not > 0; two planes in contact leave no room for liquid`);
    if (separation < least)
      throw new RangeError(`separation: ${brief(separation)} m is not >= ${brief(least)} between two planes`);
    return;
  }
  const deepest = -deepestOverlap * Math.min(...pair.radius);
  if (!(separation > deepest))
    throw new RangeError(
      `separation: ${separation} m is not > ${brief(deepest)}; an overlap may reach half the smaller radius`,
    );
  const unit = control === "volume" ? meanRadius ** 3 : held.surfaceTension / meanRadius;
  const [low, high] =
    control === "volume" ? [leastVolume * unit, mostVolume * unit] : [-mostSuction * unit, mostSuction * unit];
  const asked = control === "volume" ? held.volume : held.suction;
  if (!(asked >= low && asked <= high)) {
    const symbol = control === "volume" ? "m^3" : "Pa";
    throw new RangeError(
      `${control}: ${brief(asked)} ${symbol} is not in [${brief(low)}, ${brief(high)}] ${symbol} for these solids`,
    );
  }
}

/** The view with another control, of a value for it. */
export const startingValue = (control) => FIRST_VALUES[control];
