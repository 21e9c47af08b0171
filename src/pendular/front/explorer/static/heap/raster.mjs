// Balls and surfaces of revolution as pixels, the nearer before the farther: by the processor, so that every browser
// shows the same, with a graphics card or without.

const LIGHT = [-0.4193, 0.5125, 0.7493].map((part) => part / Math.hypot(0.4193, 0.5125, 0.7493));
const SHADE = 0.5; // brightness of what turns away from the light
const RIM = 0.08; // a rim sets grains apart
const RIM_SHADE = 0.84;
const CLEAR_RIM = 0.05; // what is left of grains that are seen through
const HAZE = 0.42; // by which what is farthest fades
const CLEAR_HAZE = 0.72;
const GLOSS = 0.4;
const TILE = 8; // pixels
const FILM = 0.5; // pixels by which a meniscus may lie behind a grain

/** Room for a picture: colours as RGBA, and the depth of what is there. */
export function canvasOf(columns, rows) {
  const pixels = new Uint8ClampedArray(4 * columns * rows);
  return { columns, rows, pixels, words: new Uint32Array(pixels.buffer), depth: new Float32Array(columns * rows) };
}

export function clear({ words, depth }) {
  words.fill(0);
  depth.fill(-Infinity);
}

export function copyOf(to, from) {
  to.words.set(from.words);
  to.depth.set(from.depth);
}

const packed = (r, g, b) => (0xff000000 | (b << 16) | (g << 8) | r) >>> 0; // little endian, as all browsers are

/** Draw a ball; places in pixels from the lower left, z to the eye. A clear one is its rim, and hides nothing. */
export function drawBall(canvas, x, y, z, radius, look) {
  const { columns, rows, words, depth } = canvas;
  const { red, green, blue, fogRed, fogGreen, fogBlue } = tintOf(look, z);
  const square = radius * radius;
  const [l0, l1, l2] = LIGHT.map((part) => ((1 - SHADE) * part) / radius);
  const clear = packed(red * RIM_SHADE + fogRed, green * RIM_SHADE + fogGreen, blue * RIM_SHADE + fogBlue);
  const top = Math.min(rows - 1, Math.floor(y + radius));
  for (let row = Math.max(0, Math.ceil(y - radius)); row <= top; row++) {
    const v = row + 0.5 - y;
    const chord = square - v * v;
    if (chord <= 0) continue;
    const half = Math.sqrt(chord);
    const last = Math.min(columns - 1, Math.floor(x + half - 0.5));
    const first = Math.max(0, Math.ceil(x - half - 0.5));
    const line = (rows - 1 - row) * columns;
    for (let column = first; column <= last; column++) {
      const place = line + column;
      const u = column + 0.5 - x;
      const rest = chord - u * u;
      if (rest <= 0) continue;
      if (look.isClear) {
        if (rest < CLEAR_RIM * square) words[place] = clear;
        continue;
      }
      const bulge = Math.sqrt(rest);
      if (z + bulge <= depth[place]) continue;
      depth[place] = z + bulge;
      const lit = SHADE + Math.max(0, u * l0 + v * l1 + bulge * l2);
      const bright = rest < RIM * square ? lit * RIM_SHADE : lit;
      words[place] = packed(red * bright + fogRed, green * bright + fogGreen, blue * bright + fogBlue);
    }
  }
}

let ring = new Float64Array(0); // x, y, z and brightness of each corner
const turns = new Map(); // cosines and sines by the number of sides

/**
 * Draw a surface of revolution. The meridian is x along the axis from the pole and y away from it, in pixels, from
 * `start` to `stop` of its points; where it is cut off in the middle a disc closes it.
 */
export function drawMeniscus(canvas, pole, axis, meridian, sides, look, { start, stop, disc }) {
  const [across, other] = spokesOf(axis);
  const count = stop - start + 1;
  if (!turns.has(sides)) turns.set(sides, turnsOf(sides));
  if (ring.length < 4 * sides * (count + 1)) ring = new Float64Array(4 * sides * (count + 1));
  for (let i = 0; i < count; i++) layRing(i, start + i, pole, axis, across, other, meridian, turns.get(sides));
  const tint = tintOf(look, pole[2]);
  for (let i = 0; i + 1 < count; i++)
    for (let j = 0; j < sides; j++) {
      const [a, b] = [4 * (i * sides + j), 4 * (i * sides + ((j + 1) % sides))];
      const [c, d] = [a + 4 * sides, b + 4 * sides];
      // seen from outside these turn to the left
      drawTriangle(canvas, ring, a, b, c, tint);
      drawTriangle(canvas, ring, b, d, c, tint);
    }
  if (disc) drawDisc(canvas, disc === "first" ? 0 : count - 1, pole, axis, meridian, start, sides, look, disc);
}

/** Two directions across an axis. */
function spokesOf([x, y, z]) {
  const across = Math.abs(z) < 0.9 ? [-y, x, 0] : [0, -z, y];
  const size = Math.hypot(...across);
  const [a, b, c] = across.map((part) => part / size);
  return [
    [a, b, c],
    [y * c - z * b, z * a - x * c, x * b - y * a],
  ];
}

function layRing(i, point, pole, axis, across, other, { x, y }, spokes) {
  const [before, after] = [Math.max(0, point - 1), Math.min(x.length - 1, point + 1)];
  const [run, rise] = [x[after] - x[before], y[after] - y[before]];
  const steep = Math.hypot(run, rise) || 1;
  const sides = spokes.length / 2;
  for (let j = 0; j < sides; j++) {
    const at = 4 * (i * sides + j);
    let lit = 0;
    let toEye = 0;
    for (let k = 0; k < 3; k++) {
      const spoke = spokes[2 * j] * across[k] + spokes[2 * j + 1] * other[k];
      ring[at + k] = pole[k] + x[point] * axis[k] + y[point] * spoke;
      toEye = (run * spoke - rise * axis[k]) / steep; // a part of the normal, the last of which points to the eye
      lit += toEye * LIGHT[k];
    }
    const shine = Math.max(0, 2 * lit * toEye - LIGHT[2]); // of the light in the mirror of the surface
    ring[at + 3] = SHADE + (1 - SHADE) * Math.max(0, lit) + GLOSS * shine ** 12;
  }
}

/** Cosine and sine of each side of a round body. */
const turnsOf = (sides) =>
  Float64Array.from({ length: 2 * sides }, (_, i) => Math[i % 2 ? "sin" : "cos"]((2 * Math.PI * (i >> 1)) / sides));

/** A flat end where the meniscus is cut off, in the middle between two grains of which only one is drawn. */
function drawDisc(canvas, i, pole, axis, { x }, start, sides, look, disc) {
  const middle = 4 * sides * (i + 1);
  const bright = 1;
  const tint = tintOf({ ...look, colour: look.cut }, pole[2]);
  const corners = new Float64Array(4 * (sides + 1));
  corners.set(ring.subarray(4 * sides * i, middle));
  for (let j = 0; j < sides; j++) corners[4 * j + 3] = bright;
  for (let k = 0; k < 3; k++) corners[4 * sides + k] = pole[k] + x[start + i] * axis[k];
  corners[4 * sides + 3] = bright;
  for (let j = 0; j < sides; j++) {
    const [a, b] = [4 * j, 4 * ((j + 1) % sides)];
    if (disc === "first") drawTriangle(canvas, corners, a, 4 * sides, b, tint);
    else drawTriangle(canvas, corners, a, b, 4 * sides, tint);
  }
}

/** Fill a triangle that turns to the left as it is seen; one that turns to the right is seen from behind. */
function drawTriangle(canvas, corners, a, b, c, tint) {
  const ax = corners[a];
  const ay = corners[a + 1];
  const bx = corners[b];
  const by = corners[b + 1];
  const cx = corners[c];
  const cy = corners[c + 1];
  const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  if (!(area > 0)) return;
  const { columns, rows, words, depth } = canvas;
  const left = Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.5));
  const right = Math.min(columns - 1, Math.floor(Math.max(ax, bx, cx) - 0.5));
  const low = Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.5));
  const high = Math.min(rows - 1, Math.floor(Math.max(ay, by, cy) - 0.5));
  for (let row = low; row <= high; row++) {
    const y = row + 0.5;
    for (let column = left; column <= right; column++) {
      const x = column + 0.5;
      const u = (bx - x) * (cy - y) - (by - y) * (cx - x);
      const v = (cx - x) * (ay - y) - (cy - y) * (ax - x);
      const w = area - u - v;
      if (u < 0 || v < 0 || w < 0) continue;
      const z = (u * corners[a + 2] + v * corners[b + 2] + w * corners[c + 2]) / area;
      const place = (rows - 1 - row) * columns + column;
      if (z <= depth[place] - FILM) continue;
      if (z > depth[place]) depth[place] = z;
      const bright = (u * corners[a + 3] + v * corners[b + 3] + w * corners[c + 3]) / area;
      words[place] = packed(
        Math.min(255, tint.red * bright + tint.fogRed),
        Math.min(255, tint.green * bright + tint.fogGreen),
        Math.min(255, tint.blue * bright + tint.fogBlue),
      );
    }
  }
}

/** A colour, faded by its depth. */
function tintOf({ colour, ground, reach, isClear }, z) {
  const haze = (isClear ? CLEAR_HAZE : HAZE) * Math.min(Math.max(0.5 - (0.5 * z) / reach, 0), 1);
  const [red, green, blue] = colour.map((part) => part * (1 - haze));
  const [fogRed, fogGreen, fogBlue] = ground.map((part) => part * haze);
  return { red, green, blue, fogRed, fogGreen, fogBlue };
}

/** The least depth in each tile of a picture: what lies behind it in all of them is not seen. */
export function tilesOf({ columns, rows, depth }) {
  const [across, down] = [Math.ceil(columns / TILE), Math.ceil(rows / TILE)];
  const least = new Float32Array(across * down).fill(Infinity);
  for (let line = 0, place = 0; line < rows; line++) {
    const start = Math.floor(line / TILE) * across;
    for (let column = 0; column < columns; column++, place++) {
      const tile = start + ((column / TILE) | 0);
      if (depth[place] < least[tile]) least[tile] = depth[place];
    }
  }
  return { across, down, rows, least };
}

/** Whether a ball is hidden wholly behind what fills the tiles before it. */
export function isHidden({ across, down, rows, least }, [x, y, z], radius) {
  const [left, right] = [x - radius, x + radius].map((place) => Math.floor(place / TILE));
  const [top, low] = [y + radius, y - radius].map((place) => Math.floor((rows - place) / TILE));
  for (let row = Math.max(0, top); row <= Math.min(down - 1, low); row++)
    for (let column = Math.max(0, left); column <= Math.min(across - 1, right); column++)
      if (least[row * across + column] < z + radius + FILM) return false;
  return true;
}
