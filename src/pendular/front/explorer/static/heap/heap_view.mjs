// What the heap shows: options as texts, the address that carries them, and what they ask.

import { grainsOf, packingNamed, packingNames } from "./grains.mjs";
import { HEAP_RECORDS } from "./heap_records.mjs";
import { PATHS } from "./curves.mjs";
import { FIRST_TURN, turned } from "./space.mjs";
import { RECORDS } from "../records.mjs";
import { readQuantity, show } from "../units.mjs";
import { bare, oneOf, readContactAngle, readLiquid, spaced } from "../view.mjs";

export const OWN = "own";

/** All that a person can set; an empty text is an option that is left out. */
export const FIRST_HEAP = Object.freeze({
  packing: "loose",
  radius: "50 µm",
  "contact-angle": "20°",
  liquid: "water",
  temperature: "20 °C",
  "surface-tension": "", // if given, instead of liquid and temperature
  suction: "15 kPa",
  path: "drying",
  condensation: "yes",
  plot: "saturation",
  grains: "solid",
  seen: seenText(FIRST_TURN),
});
const CHOICES = {
  packing: () => [...packingNames(), OWN],
  path: () => PATHS,
  condensation: () => ["yes", "no"],
  plot: () => plotted(),
  grains: () => ["solid", "clear"],
};

/** What can be drawn against the suction. */
export const plotted = () => HEAP_RECORDS.quantities.map(({ name }) => name);

export const quantityNamed = (wanted) => HEAP_RECORDS.quantities.find(({ name }) => name === wanted);

function seenText({ turn, tilt, zoom }) {
  return [turn, tilt, zoom].join(",");
}

/** The view of an address; RangeError for a parameter that the heap does not have. */
export function heapAt(hash) {
  const texts = Object.fromEntries(new URLSearchParams(hash.replaceAll("+", "%2B")));
  delete texts.view;
  const view = { ...FIRST_HEAP };
  for (const [name, text] of Object.entries(texts)) {
    oneOf("address", name, Object.keys(FIRST_HEAP));
    const isText = name in CHOICES || name === "seen";
    view[name] = isText ? text : spaced(name === "contact-angle" && /\d$/.test(text) ? `${text}°` : text);
  }
  for (const [name, known] of Object.entries(CHOICES)) oneOf(name, view[name], known());
  readSeen(view.seen);
  return view;
}

/** What stands after the # of an address. */
export function heapHashOf(view) {
  const parts = { packing: view.packing };
  if (view.packing !== OWN) parts.radius = bare(view.radius);
  parts["contact-angle"] = bare(view["contact-angle"]);
  if (view["surface-tension"]) parts["surface-tension"] = bare(view["surface-tension"]);
  else Object.assign(parts, { liquid: view.liquid, temperature: bare(view.temperature) });
  parts.suction = bare(view.suction);
  for (const name of ["path", "condensation", "plot", "grains", "seen"])
    if (view[name] !== FIRST_HEAP[name]) parts[name] = view[name];
  const words = Object.entries(parts).map(
    ([name, text]) => `${name}=${encodeURIComponent(text).replaceAll("%2C", ",")}`,
  );
  return ["view=heap", ...words].join("&");
}

/** How the heap is seen, from its text. */
export function readSeen(text) {
  const [turn, tilt, zoom] = text.split(",").map(Number);
  if (![turn, tilt, zoom].every(Number.isFinite) || text.split(",").length !== 3 || !(zoom > 0))
    throw new RangeError(`seen: '${text}' is not a turn and a tilt in degrees and a zoom; write it like 35,25,1`);
  return turned({ turn, tilt, zoom }, {});
}

/** The text of a view that is turned on. */
export const seenAfter = (text, change) => seenText(turned(readSeen(text), change));

/** The question of a view in SI units; `own` are the grains that were pasted. RangeError for what cannot be meant. */
export function heapQuestionOf(view, own) {
  const degrees = readContactAngle("contact-angle", view["contact-angle"]);
  const liquid = readLiquid(view);
  const suction = readQuantity("suction", view.suction, "Pa", "20kPa");
  if (!(suction > 0)) throw new RangeError(`suction: ${suction} Pa is not > 0; at saturation no bridge stands alone`);
  const heap = view.packing === OWN ? ownHeap(own) : readPacking(view);
  const most = (RECORDS.domain.mostSuction * liquid.surfaceTension) / heap.mostRadius;
  if (suction > most)
    throw new RangeError(`suction: '${view.suction}' is not <= ${show(most, "Pa", 3)} for these grains`);
  return {
    heap,
    degrees,
    angle: (degrees * Math.PI) / 180,
    liquid,
    suction,
    condensation: view.condensation === "yes",
  };
}

function ownHeap(own) {
  if (!own) throw new RangeError("packing: own grains are not in an address; paste them, or drop their file");
  own.heap ??= grainsOf(own.text, own.unit);
  return own.heap;
}

const kept = { key: "", heap: undefined };

function readPacking({ packing, radius }) {
  const size = readQuantity("radius", radius, "m", "50um");
  if (!(size > 0)) throw new RangeError(`radius: '${radius}' is not > 0; write it like 50um`);
  const key = `${packing} ${size}`;
  if (kept.key !== key) Object.assign(kept, { key, heap: packingNamed(packing, size) });
  return kept.heap;
}
