// Other solids than spheres and planes: how they are typed and asked, their names, and their outlines.

import { depthAt, loadSolids } from "./solids.mjs";
import { readDegrees, readQuantity, rounded, show } from "./units.mjs";
import { bare, spaced } from "./view.mjs";

export const ENDINGS = ["", "2"]; // of the names of what belongs to a solid
const SPHERE = "sphere";
const CONE = "cone";
const PARABOLOID = "paraboloid";
const DISC = "disc";
const PINNED = "pinned disc";
export const KINDS_OF_SOLIDS = [SPHERE, "plane", CONE, PARABOLOID, DISC, PINNED];
const SOLID_FORMS = "cone:30deg, cone:30deg:20nm with a round tip, paraboloid:1um, disc:1mm, disc:1mm:pinned, sphere:50um, plane";
const ABOUT_FLAT = 1e-15; // slope of a cone that is a plane, to rounding
const SEEN = 1.5; // of what has no end, over the widest contact circle
const SOLID_POINTS = 97;
const CAP_POINTS = 24;

/** What a view holds of its solids, beside their radii; the first is a sphere, as is the second. */
export const FIRST_SOLIDS = Object.freeze({
  kind: SPHERE,
  "half-angle": "60°",
  "tip-radius": "0 m",
  kind2: SPHERE,
  "half-angle2": "60°",
  "tip-radius2": "0 m",
});

/** Whether a view has a solid that is neither a sphere nor a plane. */
export const hasOthers = (view) => view.kind !== SPHERE || view.kind2 !== SPHERE;

/** Fields of a view that a kind of solid has. */
export const fieldsOfKind = (kind) => (kind === CONE ? ["half-angle", "tip-radius"] : ["radius"]);

export const labelOfRadius = (kind) => (kind === PARABOLOID ? "Tip radius" : "Radius");

/** The option that asks for a solid of a view, and its text. */
export function optionOfSolid(view, ending) {
  const kind = view[`kind${ending}`];
  if (kind === SPHERE) return [`radius${ending}`, bare(view[`radius${ending}`])];
  const [half, tip, radius] = ["half-angle", "tip-radius", "radius"].map((name) => bare(view[name + ending]));
  const texts = {
    [CONE]: ["cone", half, ...(Number.parseFloat(tip) === 0 ? [] : [tip])],
    [PARABOLOID]: ["paraboloid", radius],
    [DISC]: ["disc", radius],
    [PINNED]: ["disc", radius, "pinned"],
  };
  return [`solid${ending}`, texts[kind].join(":")];
}

/** What a view holds of a solid that is told by an option. */
export function solidAt(text, ending) {
  const [kind, ...sizes] = text.split(":").map((part) => part.trim());
  const told = (name, values) => ({
    [`kind${ending}`]: name,
    ...Object.fromEntries(Object.entries(values).map(([key, value]) => [key + ending, value])),
  });
  const name = kind.toLowerCase();
  if (name === "plane" && sizes.length === 0) return told(SPHERE, { radius: "plane" });
  if (name === CONE && (sizes.length === 1 || sizes.length === 2)) {
    const half = sizes[0].replace(/(?<=\d)\s*(deg)?$/, "°");
    return told(CONE, { "half-angle": spaced(half), "tip-radius": sizes[1] ? spaced(sizes[1]) : "0 m" });
  }
  if (name === DISC && sizes.length === 2 && sizes[1].toLowerCase() === "pinned")
    return told(PINNED, { radius: spaced(sizes[0]) });
  if (sizes.length === 1 && [SPHERE, PARABOLOID, DISC].includes(name)) return told(name, { radius: spaced(sizes[0]) });
  throw new RangeError(`solid${ending}: '${text}' is not one of ${SOLID_FORMS}`);
}

/** A solid of a view as the solver is asked for it; `readRadius` reads a radius or a plane. */
export function readSolid(view, ending, readRadius) {
  const kind = view[`kind${ending}`];
  if (kind === CONE) return readCone(view, ending);
  const radius = readRadius(`radius${ending}`, view[`radius${ending}`]);
  if (kind === SPHERE) return { kind: SPHERE, radius };
  if (radius === Infinity) throw new RangeError(`radius${ending}: 'plane' is no length; write it like 50um`);
  return kind === PARABOLOID ? { kind, tipRadius: radius } : { kind: DISC, radius, pinned: kind === PINNED };
}

function readCone(view, ending) {
  const text = view[`half-angle${ending}`];
  const degrees = readDegrees(`half-angle${ending}`, text);
  if (!(degrees > 0 && degrees <= 90))
    throw new RangeError(`half-angle${ending}: '${text}' is not in (0, 90] degrees; write it like 60deg`);
  const tip = view[`tip-radius${ending}`];
  const tipRadius = readQuantity(`tip-radius${ending}`, tip, "m", "20nm");
  if (!(tipRadius >= 0)) throw new RangeError(`tip-radius${ending}: '${tip}' is not >= 0; write it like 20nm`);
  return { kind: CONE, halfAngle: degrees * (Math.PI / 180), tipRadius, degrees };
}

/** The smaller of the lengths of two solids; NaN if they have none. */
export function sizeOfSolids(solids) {
  const sizes = solids.map((solid) => solid.radius ?? solid.tipRadius).filter((size) => size > 0 && size < Infinity);
  return sizes.length ? Math.min(...sizes) : NaN;
}

const isFlat = ({ kind, radius, halfAngle }) =>
  kind === DISC || radius === Infinity || (kind === CONE && Math.cos(halfAngle) < ABOUT_FLAT);

/** RangeError for a separation that these solids cannot have. */
export function refuseSeparation(solids, separation) {
  if (!(separation >= 0))
    throw new RangeError(`separation: ${separation} m is not >= 0; only spheres and planes may overlap`);
  if (solids.every(isFlat) && separation === 0)
    throw new RangeError("separation: 0 m is not > 0; two flat ends in contact leave no room for liquid");
}

// -- In words and in Python ---------------------------------------------------------------------------------------------

/** A solid in a few words, as the command has them. */
function solidInWords({ kind, radius, tipRadius, degrees, pinned }) {
  const size = (length) => show(length, "m", 4);
  if (kind === CONE) return `cone of half angle ${rounded(degrees, 4)}°${tipRadius ? ` and tip radius ${size(tipRadius)}` : ""}`;
  if (kind === PARABOLOID) return `paraboloid of tip radius ${size(tipRadius)}`;
  if (kind === DISC) return `${pinned ? "pinned disc" : "disc"} of radius ${size(radius)}`;
  return radius === Infinity ? "plate" : `sphere of radius ${size(radius)}`;
}

/** Two solids in a few words. */
export function pairInWords(solids) {
  const [one, other] = solids.map(solidInWords);
  const words = one === other ? `${one} on both sides` : `${one} and ${other}`;
  return words[0].toUpperCase() + words.slice(1);
}

/** A solid in the place of a radius in Python; `number` writes a number. */
export function solidInPython({ kind, radius, tipRadius, degrees, pinned }, number) {
  if (kind === CONE) {
    const tip = tipRadius ? `, tip_radius=${number(tipRadius)}` : "";
    return `pl.Cone(np.deg2rad(${number(rounded(degrees, 15))})${tip})`;
  }
  if (kind === PARABOLOID) return `pl.Paraboloid(${number(tipRadius)})`;
  if (kind === DISC) return `pl.Disc(${number(radius)}${pinned ? ", pinned=True" : ""})`;
  return radius === Infinity ? "np.inf" : number(radius);
}

// -- To be drawn --------------------------------------------------------------------------------------------------------

/** Radii of spheres that take as much room in a picture, for a widest contact circle. */
export const seenRadii = (solids, widest) =>
  solids.map(({ kind, radius }) => (kind === CONE || kind === PARABOLOID ? SEEN * widest : radius));

/** Upper half of the outline of a solid from its tip out to a distance from its axis or, of a cylinder, to a depth. */
export function outlineOfSolid(solid, reach, far) {
  if (solid.kind === DISC)
    return [
      [0, 0],
      [0, solid.radius],
      [far, solid.radius],
    ];
  const cap = solid.kind === CONE ? Math.min(solid.tipRadius * Math.cos(solid.halfAngle), reach) : 0;
  const distances = [
    ...Array.from({ length: cap > 0 ? CAP_POINTS : 0 }, (_, i) => (cap * i) / CAP_POINTS),
    ...Array.from({ length: SOLID_POINTS }, (_, i) => cap + ((reach - cap) * i) / (SOLID_POINTS - 1)),
  ];
  const upper = distances.map((distance) => [depthAt(solid, distance), distance]);
  const [depth, last] = upper.at(-1);
  return [...upper, [Math.max(far, depth), last]];
}

// -- Solved -------------------------------------------------------------------------------------------------------------

/** A solver of all pairs, which loads that of other solids when it is to learn of them. */
export function solverOfAll(spheres) {
  let others;
  let learning;
  const ask = (name) => (pair, ...rest) => (pair.solids ? others : spheres)[name](pair, ...rest);
  const names = ["bridge", "bridges", "rupture", "lowerEnd", "curve", "profile"];
  return {
    ...spheres,
    ...Object.fromEntries(names.map((name) => [name, ask(name)])),
    knows: (view) => others !== undefined || !hasOthers(view),
    async learn() {
      learning ??= bytesBeside().then(loadSolids);
      try {
        others = await learning;
      } catch (error) {
        learning = undefined; // to be tried again
        throw error;
      }
    },
  };
}

/** The module of other solids from the script beside the page: one that opens from a disk may load nothing else. */
function bytesBeside() {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = "solids.js";
    script.onload = () => resolve(Uint8Array.from(atob(globalThis.PENDULAR_SOLIDS), (letter) => letter.charCodeAt(0)));
    script.onerror = () => {
      script.remove();
      reject(new Error("Other solids need solids.js, which stands beside this page and could not be loaded."));
    };
    document.head.append(script);
  });
}
