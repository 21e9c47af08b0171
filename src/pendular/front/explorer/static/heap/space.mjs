// How a heap is seen: turned, tilted, from afar, and in pixels.

export const FIRST_TURN = Object.freeze({ turn: 35, tilt: 25, zoom: 1 }); // [°], as the package draws a heap
const MOST_TILT = 90;
const ZOOMS = [0.5, 6];
const ROOM = 1.02;

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

/** Centres of the grains in their cell, about its middle, [m]; found once for a heap. */
export function placesOf(heap) {
  if (heap.places) return heap.places;
  const { count, positions, cell, box } = heap;
  const inside = Float64Array.from(positions);
  for (let k = 0; k < 3; k++) {
    let [low, high] = [Infinity, -Infinity];
    for (let i = k; i < 3 * count; i += 3) {
      if (cell) inside[i] -= cell[k] * Math.floor(inside[i] / cell[k]);
      low = Math.min(low, inside[i]);
      high = Math.max(high, inside[i]);
    }
    const middle = cell ? 0.5 * cell[k] : 0.5 * (low + high);
    for (let i = k; i < 3 * count; i += 3) inside[i] -= middle;
  }
  heap.places = { inside, reach: ROOM * (0.5 * Math.hypot(...box) + (cell ? heap.mostRadius : 0)) };
  return heap.places;
}

/** Pixels of a metre, in a picture of so many columns and rows. */
export const scaleIn = (heap, { zoom }, columns, rows) =>
  (0.5 * zoom * Math.min(columns, rows)) / (0.8 * placesOf(heap).reach);
