// Capillary bridges between any two of: spheres, planes, cones, paraboloids, and flat ends of cylinders.
// Written by Pendular ${version} (pendular export wasm), with solids.wasm and pendular.mjs beside it.
//
//   import { loadSolids } from "./solids.mjs";
//
//   const { bridge, rupture } = await loadSolids();
//   const tip = { kind: "cone", halfAngle: Math.PI / 3, tipRadius: 20e-9 };
//   const pair = { solids: [tip, { kind: "sphere", radius: Infinity }], contactAngle: [0.5, 0.2] };
//   console.log(bridge(pair, 1e-9, { volume: 1e-23, surfaceTension: 0.0728 })?.force);
//
// SI units, angles in radians. The separation is that of the nearest points, and not negative.
//
// Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty.

import { both, BYTES, exportsOf, FAILED, FIELDS, FOUND, heldBy, NO_BRIDGE, stateOf } from "./pendular.mjs";

const SOLID_KINDS = ${kinds};
const ROOM_TO_WRITE = ${room}; // rows and columns of what the solver writes in on its way
const SOLID_PAIR_NUMBERS = ${pair_numbers};
const SPILLED = 4;
const AT_EDGE = 1e-9;

/** The solver for other solids, from the bytes or the address of its module; else from the file beside this one. */
export async function loadSolids(source = new URL("solids.wasm", import.meta.url)) {
  return solidsSolver(await exportsOf(source));
}

function solidsSolver(module) {
  const pairAt = Math.ceil(module.__heap_base.value / BYTES);
  const stateAt = pairAt + SOLID_PAIR_NUMBERS;
  const room = [];
  let free = stateAt + FIELDS.length;
  for (const [rows, columns] of ROOM_TO_WRITE) {
    room.push(BigInt(rows), BYTES * free);
    free += rows * columns;
  }
  let numbers = new Float64Array(0);
  makeRoom(0);

  function makeRoom(count) {
    const missing = BYTES * (free + count) - module.memory.buffer.byteLength;
    if (missing > 0) module.memory.grow(Math.ceil(missing / 65536));
    if (numbers.buffer !== module.memory.buffer) numbers = new Float64Array(module.memory.buffer);
  }

  function statusOf({ solids, contactAngle = 0 }, liquid, ask) {
    const { control, held } = heldBy(liquid);
    const angles = both("contactAngle", contactAngle);
    const row = solids.flatMap((solid, i) => [...numbersOfSolid(solid), angles[i]]);
    numbers.set([...row, liquid.surfaceTension], pairAt);
    const status = ask(control, held, BYTES * pairAt);
    if (status === FAILED) throw new Error("the solver did not find, or exclude, the bridge");
    if (status === SPILLED) throw new Error("the liquid would run over the edges of two discs, which is not answered");
    if (status !== FOUND && status !== NO_BRIDGE)
      throw new RangeError("solids, separation, suction or volume: out of range");
    return status;
  }

  function stateIn(at, { contactAngle = 0 }, liquid) {
    return stateOf(numbers.subarray(at, at + FIELDS.length), both("contactAngle", contactAngle), liquid.surfaceTension);
  }

  const asked = (pair, liquid, ask) => (statusOf(pair, liquid, ask) === FOUND ? stateIn(stateAt, pair, liquid) : null);
  const end = (answer) => (pair, liquid) =>
    asked(pair, liquid, (...question) => answer(...question, BYTES * stateAt, ...room));

  function bridge(pair, separation, liquid) {
    return asked(pair, liquid, (control, held, bytes) =>
      module.solids_bridge(control, separation, held, bytes, BYTES * stateAt, ...room),
    );
  }

  function curve(pair, liquid, points = 201) {
    if (!(Number.isInteger(points) && points >= 5)) throw new RangeError("points: give a whole number, 5 or more");
    const size = points * FIELDS.length;
    makeRoom(size + points); // of statuses, which are half as long
    const status = statusOf(pair, liquid, (control, held, bytes) =>
      module.solids_curve(control, held, bytes, BigInt(points), BYTES * free, BYTES * (free + size), ...room),
    );
    if (status === NO_BRIDGE) return [];
    const states = Array.from({ length: points }, (_, i) => stateIn(free + i * FIELDS.length, pair, liquid));
    return states.map((state) => (Number.isNaN(state.separation) ? null : state));
  }

  function profile(pair, state, points = 161) {
    if (!(Number.isInteger(points) && points >= 3)) throw new RangeError("points: give a whole number, 3 or more");
    const { radius, slope, halfLength, curvature } = state.meridian;
    makeRoom(2 * points);
    numbers.set([radius, slope, halfLength, curvature], stateAt);
    module.pendular_meridian(BYTES * stateAt, BigInt(points), BYTES * free, BYTES * (free + points));
    const depth = depthOfLine(pair.solids[0], state);
    const x = numbers.slice(free, free + points).map((place) => place - depth);
    return { x, y: numbers.slice(free + points, free + 2 * points) };
  }

  return {
    bridge,
    bridges: (pair, separations, liquid) =>
      Array.from(separations, (separation) => bridge(pair, separation, liquid)),
    rupture: end(module.solids_rupture),
    lowerEnd: end(module.solids_lower_end),
    curve,
    profile,
  };
}

/** Kind, radius and half angle of a solid, as the module is told. */
function numbersOfSolid({ kind, radius, tipRadius = 0, halfAngle = 0, pinned = false }) {
  const name = pinned ? "pinned disc" : kind;
  if (!Object.hasOwn(SOLID_KINDS, name)) throw new TypeError(`solids: '$${kind}' is not one of $${Object.keys(SOLID_KINDS)}`);
  return [SOLID_KINDS[name], kind === "cone" || kind === "paraboloid" ? tipRadius : radius, halfAngle];
}

/** Depth of a solid behind its tip at a distance from its axis. */
export function depthAt({ kind, radius, tipRadius = 0, halfAngle }, distance) {
  if (kind === "paraboloid") return (distance * distance) / (2 * tipRadius);
  if (kind === "cone") {
    const start = tipRadius * Math.cos(halfAngle);
    const inside = Math.min(distance, start);
    const cap = tipRadius - Math.sqrt(tipRadius * tipRadius - inside * inside);
    return cap + Math.max(distance - start, 0) / Math.tan(halfAngle);
  }
  if (kind === "disc" || radius === Infinity) return 0;
  return radius - Math.sqrt(radius * radius - distance * distance);
}

/** Depth of the first contact line of a bridge: on a sphere its half-filling angle tells it, on a side its area. */
function depthOfLine(solid, { contactRadius: [distance], halfFillingAngle: [filling], wettedArea: [wetted] }) {
  if (solid.kind === "sphere") return solid.radius === Infinity ? 0 : 2 * solid.radius * Math.sin(0.5 * filling) ** 2;
  if (solid.kind !== "disc") return depthAt(solid, distance);
  if (distance < solid.radius * (1 - AT_EDGE)) return 0;
  return Math.max(wetted / (2 * Math.PI * solid.radius) - 0.5 * solid.radius, 0);
}
