// Sliders: which value belongs to a position, and how it is written in the field beside it.

import { rounded, show } from "./units.mjs";

const ZERO_CELSIUS = 273.15; // [K]
const FIXED = {
  radius: { low: 1e-8, high: 1e-2, steps: 600, spacing: "logarithmic" },
  radius2: { low: 1e-8, high: 1e-2, steps: 600, spacing: "logarithmic" },
  "half-angle": { low: 5, high: 90, steps: 170, spacing: "linear" },
  "half-angle2": { low: 5, high: 90, steps: 170, spacing: "linear" },
  "tip-radius": { low: 1e-9, high: 1e-2, steps: 350, spacing: "logarithmic from zero" },
  "tip-radius2": { low: 1e-9, high: 1e-2, steps: 350, spacing: "logarithmic from zero" },
  "contact-angle": { low: 0, high: 170, steps: 170, spacing: "linear" },
  "contact-angle2": { low: 0, high: 170, steps: 170, spacing: "linear" },
  temperature: { low: ZERO_CELSIUS, high: ZERO_CELSIUS + 100, steps: 200, spacing: "linear" },
  "surface-tension": { low: 1e-3, high: 1, steps: 300, spacing: "logarithmic" },
  suction: { low: 10, high: 1e8, steps: 350, spacing: "logarithmic" },
  humidity: { low: 0.5, high: 1 - 1e-6, steps: 285, spacing: "complement" },
};
const UNITS = { radius: "m", radius2: "m", "tip-radius": "m", "tip-radius2": "m", separation: "m", "surface-tension": "N/m", suction: "Pa", volume: "m^3" };
const VOLUME_STAR = [1e-8, 1]; // over the cube of the Derjaguin radius
const BETWEEN_SOLIDS = [1e-6, 1e2]; // over the cube of the size of the smaller
const WITHOUT_SIZE = [1e-27, 1e-6]; // [m^3]
const BETWEEN_PLANES = [0.1, 1e5]; // over the cube of the gap
export const BEYOND_RUPTURE = 1.25; // where the slider of the separation ends
const NO_RUPTURE_STAR = 0.2; // over the Derjaguin radius, where solids hold no bridge apart

/** Slider of a field, or of a control; those of volume and separation depend on what is shown. */
export function trackOf(name, { question, rupture }) {
  if (name in FIXED) return FIXED[name];
  const { meanRadius, arePlanes, separation, pair, hasSize } = question;
  if (name === "volume") {
    let [[low, high], unit] = arePlanes ? [BETWEEN_PLANES, separation] : [VOLUME_STAR, meanRadius];
    if (pair.solids) [[low, high], unit] = hasSize ? [BETWEEN_SOLIDS, meanRadius] : [WITHOUT_SIZE, 1];
    return { low: low * unit ** 3, high: high * unit ** 3, steps: 320, spacing: "logarithmic" };
  }
  const high = rupture ? BEYOND_RUPTURE * rupture.separation : NO_RUPTURE_STAR * meanRadius;
  return { low: arePlanes ? 0.01 * high : 0, high, steps: 250, spacing: "linear" };
}

export function valueAt({ low, high, steps, spacing }, position) {
  const part = position / steps;
  if (spacing === "linear") return low + (high - low) * part;
  if (spacing === "logarithmic from zero" && position === 0) return 0;
  if (spacing.startsWith("logarithmic")) return low * (high / low) ** part;
  return 1 - (1 - low) * ((1 - high) / (1 - low)) ** part;
}

/** Position of a value; one beyond an end has its thumb at the end. */
export function positionOf({ low, high, steps, spacing }, value) {
  if (value <= low || !(value < high)) return value <= low ? 0 : steps;
  if (spacing === "linear") return (steps * (value - low)) / (high - low);
  if (spacing.startsWith("logarithmic")) return (steps * Math.log(value / low)) / Math.log(high / low);
  return (steps * Math.log((1 - value) / (1 - low))) / Math.log((1 - high) / (1 - low));
}

/** Value of a field, or of the control, in the unit of its slider. */
export function valueOf(name, { question }) {
  const { pair, degrees, liquid, value, separation } = question;
  const values = {
    radius: pair.radius[0],
    radius2: pair.radius[1],
    "half-angle": pair.solids?.[0].degrees,
    "half-angle2": pair.solids?.[1].degrees,
    "tip-radius": pair.solids?.[0].tipRadius,
    "tip-radius2": pair.solids?.[1].tipRadius,
    "contact-angle": degrees[0],
    "contact-angle2": degrees[1],
    temperature: liquid.temperature ?? ZERO_CELSIUS,
    "surface-tension": liquid.surfaceTension,
    separation,
  };
  return values[name] ?? value;
}

/** A value as a person would write it into its field. */
export function written(name, value, digits = 3) {
  if (name === "humidity") {
    const dryness = rounded(1 - value, digits);
    return `${rounded(100 * (1 - dryness), 12)} %`;
  }
  if (name === "temperature") return `${rounded(value - ZERO_CELSIUS, 4)} °C`;
  if (/^(contact|half)-angle/.test(name)) return `${rounded(value, 4)}°`;
  return show(value, UNITS[name], digits).replace("\u00a0", " ").replace("−", "-");
}
