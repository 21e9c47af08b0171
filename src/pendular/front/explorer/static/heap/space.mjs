// How a heap is seen: turned, tilted, from afar, and in pixels.

export const FIRST_TURN = Object.freeze({ turn: 35, tilt: 25, zoom: 1 }); // [°], as the package draws a heap
const MOST_TILT = 90;
const ZOOMS = [0.5, 6];
const ROOM = 1.03;
const USUAL_TILTS = [0, 0.25, 0.5]; // at which the whole heap is in sight, [rad]

/** A view that is turned on, with its angles in their ranges. */
export function turned({ turn, tilt, zoom }, { by = 0, up = 0, nearer = 1 }) {
  const angle = (((turn + by + 180) % 360) + 360) % 360;
  return {
    turn: Math.round(10 * (angle - 180)) / 10,
    tilt: Math.round(10 * Math.min(Math.max(tilt + up, -MOST_TILT), MOST_TILT)) / 10,
    zoom: Math.round(1000 * Math.min(Math.max(zoom * nearer, ZOOMS[0]), ZOOMS[1])) / 1000,
  };
}

/** Rows that point to the right, up and to the eye. */
export function axesOf({ turn, tilt }) {
  const [a, b] = [turn, tilt].map((angle) => (angle * Math.PI) / 180);
  const right = [Math.cos(a), Math.sin(a), 0];
  const up = [-Math.sin(a) * Math.sin(b), Math.cos(a) * Math.sin(b), Math.cos(b)];
  const eye = [
    right[1] * up[2] - right[2] * up[1],
    right[2] * up[0] - right[0] * up[2],
    right[0] * up[1] - right[1] * up[0],
  ];
  return [...right, ...up, ...eye];
}

/** Centres of the grains in their cell, about their middle, and how far they reach, [m]; found once for a heap. */
export function placesOf(heap) {
  if (heap.places) return heap.places;
  const { count, positions, cell } = heap;
  const inside = Float64Array.from(positions);
  for (let k = 0; k < 3; k++) {
    let [low, high] = [Infinity, -Infinity];
    for (let i = k; i < 3 * count; i += 3) {
      if (cell) inside[i] -= cell[k] * Math.floor(inside[i] / cell[k]);
      low = Math.min(low, inside[i]);
      high = Math.max(high, inside[i]);
    }
    for (let i = k; i < 3 * count; i += 3) inside[i] -= 0.5 * (low + high);
  }
  heap.places = { inside, ...reachesOf(heap, inside) };
  return heap.places;
}

/** How far the grains reach from their middle: at most, to the side however they are turned, and upwards. */
function reachesOf({ count, radii }, inside) {
  const reaches = { reach: 0, aside: 0, up: 0 };
  for (let i = 0; i < count; i++) {
    const [x, y, z] = inside.subarray(3 * i, 3 * i + 3);
    const aside = Math.hypot(x, y);
    reaches.reach = Math.max(reaches.reach, Math.hypot(x, y, z) + radii[i]);
    reaches.aside = Math.max(reaches.aside, aside + radii[i]);
    for (const tilt of USUAL_TILTS)
      reaches.up = Math.max(reaches.up, Math.abs(z) * Math.cos(tilt) + aside * Math.sin(tilt) + radii[i]);
  }
  return reaches;
}

/** Pixels of a metre, in a picture of so many columns and rows. */
export function scaleIn(heap, { zoom }, columns, rows) {
  const { aside, up } = placesOf(heap);
  return (0.5 * zoom * Math.min(columns / aside, rows / up)) / ROOM;
}
