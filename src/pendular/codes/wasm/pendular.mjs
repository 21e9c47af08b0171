// Capillary bridges between two solids, from the exact solution of the Young-Laplace equation.
// Written by Pendular ${version} (pendular export wasm), with pendular.wasm beside it.
//
//   import { load } from "./pendular.mjs";
//
//   const { bridge, rupture } = await load();
//   const grains = { radius: [50e-6, Infinity], contactAngle: 0.35 };
//   const water = { suction: 20e3, surfaceTension: 0.0728 };
//   console.log(bridge(grains, 1e-6, water)?.force, rupture(grains, water).separation);
//
// SI units, angles in radians. The separation is from surface to surface, negative where the solids overlap. A plane has
// radius Infinity. What is held is the suction, gas pressure minus liquid pressure, or the volume of the liquid.
//
// Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty.

export const FIELDS = ${fields};
const AT = Object.fromEntries(FIELDS.map((name, i) => [name, i]));
export const [FOUND, NO_BRIDGE, FAILED] = [0, 1, 2];
const CONTROLS = ["suction", "volume"];
const IMPORTS = ["acos", "asin", "atan", "atan2", "cos", "exp", "hypot", "log", "log1p", "pow", "sin", "tan"];
const PAIR_NUMBERS = 5;
const MOST_NODES = ${most_nodes}; // on the way along a branch
const NODE_NUMBERS = 4;
const RATES = ["separation", "held", "logRadius1", "cosAngle1", "logRadius2", "cosAngle2"];
export const BYTES = 8;
const LAW = /^law_(.+)_(force|rupture)$$/;

/** The solver, from the bytes or the address of its module; else from the file beside this one. */
export async function load(source = new URL("pendular.wasm", import.meta.url)) {
  return solver(await exportsOf(source));
}

/** What a module answers, from its bytes or its address. */
export async function exportsOf(source) {
  const bytes = source instanceof URL || typeof source === "string" ? await bytesAt(source) : source;
  const env = Object.fromEntries(IMPORTS.map((name) => [name, Math[name]]));
  const { instance } = await WebAssembly.instantiate(bytes, { env });
  return instance.exports;
}

async function bytesAt(source) {
  const url = new URL(source, import.meta.url);
  if (url.protocol === "file:") {
    const { readFile } = await import("node:fs/promises");
    return readFile(url);
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`$${url}: $${response.status} $${response.statusText}`);
  return response.arrayBuffer();
}

function solver(module) {
  const pairAt = Math.ceil(module.__heap_base.value / BYTES);
  const stateAt = pairAt + PAIR_NUMBERS;
  const roomAt = stateAt + FIELDS.length;
  let numbers = new Float64Array(0);
  makeRoom(0);

  function makeRoom(count) {
    const missing = BYTES * (roomAt + count) - module.memory.buffer.byteLength;
    if (missing > 0) module.memory.grow(Math.ceil(missing / 65536));
    if (numbers.buffer !== module.memory.buffer) numbers = new Float64Array(module.memory.buffer);
  }

  function statusOf(pair, liquid, ask) {
    const { control, held } = heldBy(liquid);
    numbers.set([...both("radius", pair.radius), ...both("contactAngle", pair.contactAngle ?? 0)], pairAt);
    numbers[pairAt + 4] = liquid.surfaceTension;
    const status = ask(control, held, BYTES * pairAt, BYTES * stateAt);
    if (status !== FOUND && status !== NO_BRIDGE) throw refusalOf(status);
    return status;
  }

  function stateIn(at, pair, liquid) {
    const angles = both("contactAngle", pair.contactAngle ?? 0);
    return stateOf(numbers.subarray(at, at + FIELDS.length), angles, liquid.surfaceTension);
  }

  const asked = (pair, liquid, ask) => (statusOf(pair, liquid, ask) === FOUND ? stateIn(stateAt, pair, liquid) : null);

  function curve(pair, liquid, points = 201) {
    if (!(Number.isInteger(points) && points >= 5)) throw new RangeError("points: give a whole number, 5 or more");
    const size = points * FIELDS.length;
    makeRoom(size + MOST_NODES * NODE_NUMBERS);
    const status = statusOf(pair, liquid, (control, held, pairBytes) =>
      module.pendular_curve(
        control, held, pairBytes, BigInt(points), BYTES * roomAt, BigInt(MOST_NODES), BYTES * (roomAt + size),
      ),
    );
    if (status === NO_BRIDGE) return [];
    const states = Array.from({ length: points }, (_, i) => stateIn(roomAt + i * FIELDS.length, pair, liquid));
    return states.map((state) => (Number.isNaN(state.separation) ? null : state));
  }

  function forceRates(pair, bridge, liquid) {
    makeRoom(RATES.length);
    const { radius, slope, halfLength, curvature } = bridge.meridian;
    numbers[stateAt + AT.separation] = bridge.separation;
    numbers[stateAt + AT.middle_radius] = radius;
    numbers[stateAt + AT.middle_slope] = slope;
    numbers[stateAt + AT.half_length] = halfLength;
    numbers[stateAt + AT.curvature] = curvature;
    statusOf(pair, liquid, (...places) => module.pendular_force_rates(...places, BYTES * roomAt));
    return Object.fromEntries(RATES.map((name, i) => [name, numbers[roomAt + i]]));
  }

  function profile(pair, state, points = 161) {
    if (!(Number.isInteger(points) && points >= 3)) throw new RangeError("points: give a whole number, 3 or more");
    const { radius, slope, halfLength, curvature } = state.meridian;
    makeRoom(2 * points);
    numbers.set([radius, slope, halfLength, curvature], stateAt);
    module.pendular_meridian(BYTES * stateAt, BigInt(points), BYTES * roomAt, BYTES * (roomAt + points));
    const [first] = both("radius", pair.radius);
    const depth = first === Infinity ? 0 : 2 * first * Math.sin(0.5 * state.halfFillingAngle[0]) ** 2;
    const x = numbers.slice(roomAt, roomAt + points).map((place) => place - depth);
    return { x, y: numbers.slice(roomAt + points, roomAt + 2 * points) };
  }

  /** Stable bridges of many pairs, each by its two radii and two angles, as rows of numbers. */
  function rows(pairs, separations, liquid) {
    const count = separations.length;
    if (pairs.length !== 4 * count) throw new RangeError("pairs: give two radii and two angles for each separation");
    const { control, held } = heldBy(liquid);
    const [heldAt, pairsAt] = [roomAt + count, roomAt + 2 * count];
    const statesAt = pairsAt + PAIR_NUMBERS * count;
    const statusesAt = statesAt + FIELDS.length * count;
    makeRoom(statusesAt + count - roomAt);
    numbers.set(separations, roomAt);
    numbers.fill(held, heldAt, pairsAt);
    for (let i = 0; i < count; i++) {
      for (let k = 0; k < 4; k++) numbers[pairsAt + PAIR_NUMBERS * i + k] = pairs[4 * i + k];
      numbers[pairsAt + PAIR_NUMBERS * i + 4] = liquid.surfaceTension;
    }
    const places = [roomAt, heldAt, pairsAt, statesAt, statusesAt].map((place) => BYTES * place);
    const worst = module.pendular_bridges(control, BigInt(count), ...places);
    if (worst > NO_BRIDGE) throw refusalOf(worst);
    const statuses = new Int32Array(module.memory.buffer, places[4], count);
    const exists = Uint8Array.from(statuses, (status) => Number(status === FOUND));
    return { exists, fields: FIELDS, numbers: numbers.slice(statesAt, statesAt + FIELDS.length * count) };
  }

  return {
    rows,
    bridge: (pair, separation, liquid) =>
      asked(pair, liquid, (control, held, ...places) => module.pendular_bridge(control, separation, held, ...places)),
    bridges: (pair, separations, liquid) => {
      numbers.fill(NaN, stateAt, stateAt + FIELDS.length); // no bridge to start from
      return Array.from(separations, (separation) =>
        asked(pair, liquid, (control, held, ...places) =>
          module.pendular_bridge_near(control, separation, held, ...places),
        ),
      );
    },
    rupture: (pair, liquid) => asked(pair, liquid, module.pendular_rupture),
    lowerEnd: (pair, liquid) => asked(pair, liquid, module.pendular_lower_end),
    curve,
    forceRates,
    profile,
    laws: lawsOf(module),
  };
}

const refusalOf = (status) =>
  status === FAILED
    ? new Error("the solver did not find, or exclude, the bridge")
    : new RangeError("pair, separation, suction or volume: out of range");

function lawsOf(module) {
  const laws = {};
  for (const [name, answer] of Object.entries(module)) {
    const found = LAW.exec(name);
    if (found) (laws[found[1]] ??= {})[found[2]] = answer;
  }
  return laws;
}

export function heldBy(liquid) {
  const given = CONTROLS.filter((name) => liquid[name] !== undefined);
  if (given.length !== 1) throw new TypeError("give suction or volume, one of them");
  return { control: CONTROLS.indexOf(given[0]), held: liquid[given[0]] };
}

export function both(name, value) {
  const values = Array.isArray(value) ? value : [value, value];
  if (values.length !== 2 || values.some((each) => typeof each !== "number"))
    throw new TypeError(`$${name}: give a number, or one for each solid`);
  return values;
}

export function stateOf(row, angles, surfaceTension) {
  const energy = row[AT.area] - Math.cos(angles[0]) * row[AT.wetted_area1] - Math.cos(angles[1]) * row[AT.wetted_area2];
  return {
    separation: row[AT.separation],
    suction: row[AT.curvature] * surfaceTension,
    volume: row[AT.volume],
    force: row[AT.force],
    stiffness: row[AT.stiffness],
    neckRadius: row[AT.neck_radius],
    neckInside: row[AT.neck_inside] === 1,
    contactRadius: [row[AT.radius1], row[AT.radius2]],
    halfFillingAngle: [row[AT.filling1], row[AT.filling2]],
    liquidGasArea: row[AT.area],
    wettedArea: [row[AT.wetted_area1], row[AT.wetted_area2]],
    surfaceEnergy: surfaceTension * energy,
    grandPotential: surfaceTension * (energy + row[AT.curvature] * row[AT.volume]),
    capillaryTensor: [row[AT.across_tensor], row[AT.axial_tensor]],
    unstableDirections: row[AT.unstable_directions],
    sidewaysStable: row[AT.sideways_stable] === 1,
    stable: row[AT.unstable_directions] === 0 && row[AT.sideways_stable] === 1,
    meridian: {
      radius: row[AT.middle_radius],
      slope: row[AT.middle_slope],
      halfLength: row[AT.half_length],
      curvature: row[AT.curvature],
    },
  };
}
