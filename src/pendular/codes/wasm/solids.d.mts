// Types of solids.mjs, by Pendular ${version}. SI units, angles in radians.

import type { Bridge, Liquid } from "./pendular.mjs";

/** Infinity is a plane; a sharp cone has no tip radius. [m], [rad] */
export type Solid =
  | { kind: "sphere"; radius: number }
  | { kind: "cone"; halfAngle: number; tipRadius?: number }
  | { kind: "paraboloid"; tipRadius: number }
  | { kind: "disc"; radius: number; pinned?: boolean };

export interface SolidPair {
  solids: [Solid, Solid];
  /** One for both, or one for each, through the liquid; 0 if not given. [rad] */
  contactAngle?: number | [number, number];
}

export interface SolidsSolver {
  /** The stable bridge at a separation, null where there is none. */
  bridge(pair: SolidPair, separation: number, liquid: Liquid): Bridge | null;
  /** Those at many separations. */
  bridges(pair: SolidPair, separations: Iterable<number>, liquid: Liquid): (Bridge | null)[];
  /** The bridge at the end of its stable branch, where it breaks; null where there is none. */
  rupture(pair: SolidPair, liquid: Liquid): Bridge | null;
  /** The bridge at which the stable branch begins, null where that is contact. */
  lowerEnd(pair: SolidPair, liquid: Liquid): Bridge | null;
  /** From contact, or the lower end, to rupture in the middle, and down the unstable branch; 201 points if not told. */
  curve(pair: SolidPair, liquid: Liquid, points?: number): (Bridge | null)[];
  /** The meridian to draw: the tips lie at x = 0 and x = separation; 161 points if not told. [m] */
  profile(pair: SolidPair, bridge: Bridge, points?: number): { x: Float64Array; y: Float64Array };
}

/** The solver for other solids, from the bytes or the address of its module; else from solids.wasm beside the script. */
export function loadSolids(source?: URL | string | BufferSource): Promise<SolidsSolver>;
