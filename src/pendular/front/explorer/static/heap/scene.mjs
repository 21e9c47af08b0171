// The heap as a picture: grains, and the bridges between them with their true meridians.

import { canvasOf, clear, copyOf, drawBall, drawMeniscus, isHidden, tilesOf } from "./raster.mjs";
import { axesOf, placesOf, scaleIn } from "./space.mjs";

const COARSE_DETAIL = { points: 5, sides: 10 }; // of a meridian, an odd number, and of a surface of revolution
const CLEAR_DETAIL = { points: 5, sides: 8 }; // all bridges are seen
const FINE_DETAIL = { points: 13, sides: 24 };
const FEWEST_SIDES = 6;
const SIDES_A_PIXEL = 1.3; // of the radius

/** Keeps a coarse and a fine picture: grains are drawn again only where they look different. */
export function makeScene() {
  const rooms = { coarse: undefined, fine: undefined };

  /**
   * Pixels of a heap with bridges, each a row of the answers and whether history alone keeps it. They are drawn in small
   * steps, after each of which another picture may be begun instead.
   */
  return function* draw({ setting, answers, bridges, view, palette, isClear, columns, rows, isFine }, solver) {
    const fineness = isFine ? "fine" : "coarse";
    if (rooms[fineness]?.whole.columns !== columns || rooms[fineness].whole.rows !== rows)
      rooms[fineness] = { grains: canvasOf(columns, rows), whole: canvasOf(columns, rows), drawn: undefined };
    const room = rooms[fineness];
    const { heap } = setting;
    const seen = seenFrom(heap, view, columns, rows);
    const looks = looksOf(palette, seen.scale * placesOf(heap).reach, isClear);
    const key = [view.turn, view.tilt, view.zoom, isClear, ...palette.grain, ...palette.ground].join(" ");
    if (room.drawn?.heap !== heap || room.drawn.key !== key) {
      room.drawn = undefined;
      clear(room.grains);
      yield* drawGrains(room.grains, heap, seen, looks.grain);
      room.drawn = { heap, key, tiles: tilesOf(room.grains) };
    }
    copyOf(room.whole, room.grains);
    const detail = isFine ? FINE_DETAIL : isClear ? CLEAR_DETAIL : COARSE_DETAIL;
    for (const { row, isKept } of bridges) {
      const look = isKept ? looks.kept : looks.liquid;
      drawBridge(room.whole, room.drawn.tiles, setting, answers, row, seen, detail, look, solver);
      yield;
    }
    return room.whole.pixels;
  };
}

/** Places of the grains as they are seen: pixels to the right, up and to the eye. */
function seenFrom(heap, view, columns, rows) {
  const axes = axesOf(view);
  const scale = scaleIn(heap, view, columns, rows);
  const { inside } = placesOf(heap);
  const places = new Float64Array(3 * heap.count);
  for (let i = 0; i < heap.count; i++) {
    const [x, y, z] = turn(axes, inside, 3 * i, scale);
    places[3 * i] = 0.5 * columns + x;
    places[3 * i + 1] = 0.5 * rows + y;
    places[3 * i + 2] = z;
  }
  return { axes, scale, places };
}

const turn = (axes, from, at, scale) =>
  [0, 3, 6].map((k) => scale * (axes[k] * from[at] + axes[k + 1] * from[at + 1] + axes[k + 2] * from[at + 2]));

function looksOf(palette, reach, isClear) {
  const pale = (colour) => colour.map((part, k) => 0.5 * (part + palette.grain[k]));
  const look = (colour) => ({ colour, cut: pale(colour), ground: palette.ground, reach, isClear });
  return { grain: look(palette.grain), liquid: look(palette.liquid), kept: look(palette.kept) };
}

/** The nearest first: most of what lies behind is then not drawn at all. */
function* drawGrains(canvas, { count, radii }, { scale, places }, look) {
  const order = Array.from({ length: count }, (_, i) => i).sort((i, j) => places[3 * j + 2] - places[3 * i + 2]);
  if (look.isClear) order.reverse();
  for (const i of order) {
    drawBall(canvas, places[3 * i], places[3 * i + 1], places[3 * i + 2], scale * radii[i], look);
    yield;
  }
}

/** A bridge that leaves the cell is drawn as its two halves, each on its grain. */
function drawBridge(canvas, tiles, { heap, pairs }, answers, row, { axes, scale, places }, detail, look, solver) {
  const [i, j] = [pairs.first[row], pairs.second[row]];
  const axis = turn(axes, pairs.normal, 3 * row, 1);
  const poleFrom = (grain, far) => [0, 1, 2].map((k) => places[3 * grain + k] + scale * far * axis[k]);
  const first = poleFrom(i, heap.radii[i]);
  const again = poleFrom(j, heap.radii[i] - pairs.length[row]); // where the first pole is, seen from the second grain
  const isWhole = [0, 1, 2].every((k) => Math.abs(first[k] - again[k]) < 1e-3 * scale * heap.leastRadius);
  const around = scale * roundReachOf(heap.radii[i], heap.radii[j], answers, row);
  const ends = [first, again]
    .slice(0, isWhole ? 1 : 2)
    .map((pole) => ({ pole, isSeen: !isHidden(tiles, pole, around) }));
  if (!ends.some(({ isSeen }) => isSeen)) return;
  const { points } = detail;
  const sides = Math.min(detail.sides, Math.max(FEWEST_SIDES, 2 * Math.ceil(SIDES_A_PIXEL * around * 0.5)));
  const meridian = meridianOf(heap, i, j, answers, row, points, solver);
  const x = meridian.x.map((place) => scale * place);
  const y = meridian.y.map((place) => scale * place);
  const [half, last] = [(points - 1) / 2, points - 1];
  const parts = isWhole
    ? [{ start: 0, stop: last }]
    : [
        { start: 0, stop: half, disc: "last" },
        { start: half, stop: last, disc: "first" },
      ];
  for (const [k, { pole, isSeen }] of ends.entries())
    if (isSeen) drawMeniscus(canvas, pole, axis, { x, y }, sides, look, parts[k]);
}

/** Of a ball about the first pole in which the whole bridge lies, [m]. */
function roundReachOf(radius1, radius2, { number }, row) {
  const depth1 = 2 * radius1 * Math.sin(0.5 * number(row, "filling1")) ** 2;
  const depth2 = 2 * radius2 * Math.sin(0.5 * number(row, "filling2")) ** 2;
  const along = Math.max(depth1, number(row, "separation") + depth2);
  return Math.hypot(along, Math.max(number(row, "radius1"), number(row, "radius2"), number(row, "middle_radius")));
}

/** The meridian from the pole of the first grain on; of grains that overlap it is that of grains in contact. */
function meridianOf({ radii }, i, j, { number }, row, points, solver) {
  const meridian = {
    radius: number(row, "middle_radius"),
    slope: number(row, "middle_slope"),
    halfLength: number(row, "half_length"),
    curvature: number(row, "curvature"),
  };
  const state = { meridian, halfFillingAngle: [number(row, "filling1"), number(row, "filling2")] };
  return solver.profile({ radius: [radii[i], radii[j]] }, state, points);
}
