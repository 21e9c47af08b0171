// Types of pendular.mjs, by Pendular ${version}. SI units, angles in radians.

export interface Pair {
  /** One for both solids, or one for each; Infinity is a plane. [m] */
  radius: number | [number, number];
  /** Through the liquid; 0 if not given. [rad] */
  contactAngle?: number | [number, number];
}

/** Suction (gas pressure minus liquid pressure, [Pa]) or volume ([m3]), one of them, and the surface tension ([N/m]). */
export type Liquid = { surfaceTension: number } & (
  | { suction: number; volume?: undefined }
  | { volume: number; suction?: undefined }
);

export interface Bridge {
  separation: number;
  suction: number;
  volume: number;
  /** Attraction. [N] */
  force: number;
  /** Rate of the force in the separation, with what is held. [N/m] */
  stiffness: number;
  /** NaN for a bridge that pushes. [m] */
  neckRadius: number;
  neckInside: boolean;
  contactRadius: [number, number];
  halfFillingAngle: [number, number];
  liquidGasArea: number;
  wettedArea: [number, number];
  /** Against dry solids. [J] */
  surfaceEnergy: number;
  /** Surface energy and suction times volume. [J] */
  grandPotential: number;
  /** Integral of n n over the meniscus: one of the two equal components across the axis, and that along it. [m2] */
  capillaryTensor: [number, number];
  /** Those that keep the axis, under the control. */
  unstableDirections: number;
  sidewaysStable: boolean;
  /** Under the control, sideways too. */
  stable: boolean;
  /** The arc from its middle: radius, slope angle, half its length, mean curvature. */
  meridian: { radius: number; slope: number; halfLength: number; curvature: number };
}

/** Numbers of many bridges: those of bridge i begin at i * fields.length; NaN where there is none. */
export interface Rows {
  /** 1 where there is a bridge. */
  exists: Uint8Array;
  /** Their names, as `Bridge` has them or nearly so, in its units; the curvature is the suction over the surface tension. */
  fields: string[];
  numbers: Float64Array;
}

/** How the force of a bridge follows each number of its question, the others held. */
export interface ForceRates {
  /** [N/m] */
  separation: number;
  /** In the suction, [N/Pa], or in the volume, [N/m3]. */
  held: number;
  /** In the logarithm of a radius, 0 for a plane. [N] */
  logRadius1: number;
  logRadius2: number;
  /** In the cosine of a contact angle, which is regular at 0. [N] */
  cosAngle1: number;
  cosAngle2: number;
}

/** What a law gives; the control is its own, a suction or a volume. NaN outside of its domain. */
export interface Law {
  /** F/(2πγR̄), 0 beyond rupture. */
  force?(
    separation: number, control: number, angle1: number, angle2: number, kappa1: number, kappa2: number,
  ): number;
  /** The rupture distance over R̄. */
  rupture?(control: number, angle1: number, angle2: number, kappa1: number, kappa2: number): number;
}

export interface Solver {
  /** The stable bridge at a separation, null where there is none. */
  bridge(pair: Pair, separation: number, liquid: Liquid): Bridge | null;
  /** Those at many separations, each sought first from the one before: give them in order. */
  bridges(pair: Pair, separations: Iterable<number>, liquid: Liquid): (Bridge | null)[];
  /** The stable bridges of many pairs at once, each pair by two radii and two contact angles. */
  rows(pairs: ArrayLike<number>, separations: ArrayLike<number>, liquid: Liquid): Rows;
  /** The bridge at the end of its stable branch, where it breaks; null where there is none. */
  rupture(pair: Pair, liquid: Liquid): Bridge | null;
  /** The bridge at which the stable branch begins, null where that is contact. */
  lowerEnd(pair: Pair, liquid: Liquid): Bridge | null;
  /** From contact, or the lower end, to rupture in the middle, and down the unstable branch; 201 points if not told. */
  curve(pair: Pair, liquid: Liquid, points?: number): (Bridge | null)[];
  /** How the force of a bridge follows the numbers of its question, which is given again. */
  forceRates(pair: Pair, bridge: Bridge, liquid: Liquid): ForceRates;
  /** The meridian to draw: the facing poles lie at x = 0 and x = separation; 161 points if not told. [m] */
  profile(pair: Pair, bridge: Bridge, points?: number): { x: Float64Array; y: Float64Array };
  /** Published laws by their names, reduced by the Derjaguin radius as in Python. */
  laws: Record<string, Law>;
}

/** The solver, from the bytes or the address of its module; else from pendular.wasm beside the script. */
export function load(source?: URL | string | BufferSource): Promise<Solver>;
