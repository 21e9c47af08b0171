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
  /** Integral of n n over the meniscus: one of the two equal components across the axis, and that along it. [m2] */
  capillaryTensor: [number, number];
  /** Those that keep the axis, under the control. */
  unstableDirections: number;
  sidewaysStable: boolean;
  /** The arc from its middle: radius, slope angle, half its length, mean curvature. */
  meridian: { radius: number; slope: number; halfLength: number; curvature: number };
}

export interface Solver {
  /** The stable bridge at a separation, null where there is none. */
  bridge(pair: Pair, separation: number, liquid: Liquid): Bridge | null;
  /** Those at many separations, each sought first from the one before: give them in order. */
  bridges(pair: Pair, separations: Iterable<number>, liquid: Liquid): (Bridge | null)[];
  /** The bridge at the end of its stable branch, where it breaks; null where there is none. */
  rupture(pair: Pair, liquid: Liquid): Bridge | null;
}

/** The solver, from the bytes or the address of its module; else from pendular.wasm beside the script. */
export function load(source?: URL | string | BufferSource): Promise<Solver>;
