// The pair with its bridge, to scale, as SVG that is light enough to be redrawn in every frame.

import { outlineOfSolid, pairInWords, seenRadii } from "./kinds.mjs";
import { show } from "./units.mjs";

const HALF = 100; // half the height of the drawing, in its own units
const ASPECT = 1.34; // width over height
const CARD = 0.27; // width of the small card over that of the picture
const TIGHTER = 0.82; // than a window for a bridge as wide as this one is in contact only
const TOO_FAR = 1.4; // over the rupture distance: beyond, the window on the bridge would lose a solid
const THINNEST = 0.05; // of its radius: of a thinner meniscus the edge is drawn, which would be a hairline
const OUTLINE_POINTS = 97;

/** The picture: SVG text, and the scale by which it is pulled. */
export function pictureOf(answer, solver) {
  const scene = sceneOf(answer.question, answer.state, answer.question.separation, solver);
  const [overview, window] = windowsOf(answer, scene, solver);
  const parts = [
    bodyOf(scene, window),
    showsAxis(window) ? measuresOf(scene, window) : distanceOf(scene),
    barOf(window),
  ];
  if (window !== overview) parts.push(cardOf(scene, overview, window));
  return {
    svg: parts.join(""),
    metre: HALF / window.half, // in units of the drawing
    upright: window.upright,
    middle: placeIn(window, 0.5 * scene.gap, window.y),
    words: wordsOf(answer),
  };
}

export const VIEW_BOX = [-ASPECT * HALF, -HALF, 2 * ASPECT * HALF, 2 * HALF];

function sceneOf({ pair, meanRadius }, state, gap, solver) {
  const outline = state ? solver.profile(pair, state, OUTLINE_POINTS) : { x: [], y: [] };
  const widest = state ? Math.max(...state.contactRadius) : gap || meanRadius;
  const radii = pair.solids ? seenRadii(pair.solids, widest) : pair.radius;
  return { radii, solids: pair.solids, gap, x: Array.from(outline.x), y: Array.from(outline.y) };
}

// -- Windows: centre and half height, [m]; 0 lies, 1 stands with the first solid below, -1 with the second ------------

const reachOf = ({ upright }) => (upright ? [1, ASPECT] : [ASPECT, 1]);
const showsAxis = (window) => Math.abs(window.y) < window.half * reachOf(window)[1];

/** Views from afar and from near, which stay while the separation changes. */
function windowsOf({ question, rupture, curve, branch }, scene, solver) {
  if (curve.length && scene.gap < TOO_FAR * rupture.separation) {
    branch.widestScene ??= widestOf(question, rupture, curve, solver);
    const largest = branch.widestScene;
    const overview = farWindow(largest);
    const window = nearWindow(largest, overview);
    if (showsAxis(window)) {
      const shift = 0.5 * (scene.gap - largest.gap);
      const moved = { ...overview, x: overview.x + shift };
      return [moved, window === overview ? moved : { ...window, x: window.x + shift }];
    }
  }
  const overview = farWindow(scene);
  return [overview, scene.x.length ? nearWindow(scene, overview) : overview];
}

/** As wide as the bridge is in contact, and as long as it is at rupture. */
function widestOf(question, rupture, curve, solver) {
  const last = sceneOf(question, rupture, rupture.separation, solver);
  const widest = Math.max(...curve.map(({ contactRadius }) => contactRadius[0]));
  const factor = (TIGHTER * widest) / Math.max(...last.y);
  const radii = last.solids ? seenRadii(last.solids, TIGHTER * widest) : last.radii;
  return { ...last, radii, y: last.y.map((y) => y * factor) };
}

/** Window on both solids; of planes, and of a far larger sphere, on the part next to the other solid. */
function farWindow({ radii, gap, y }) {
  const least = Math.min(...radii);
  const small = least === Infinity ? Math.max(gap, ...y) : least;
  const depths = radii.map((radius) => (radius === Infinity ? 0.6 * small : 2 * Math.min(radius, 2.5 * small)));
  const across = Math.max(Math.min(Math.max(...radii), 2 * small), ...y);
  const along = 0.5 * (depths[0] + depths[1] + gap);
  const upright = radii[0] === Infinity ? 1 : radii[1] === Infinity ? -1 : 0;
  const half = upright ? Math.max(along, across / ASPECT) : Math.max(across, along / ASPECT);
  return { x: 0.5 * (gap + depths[1] - depths[0]), y: 0, half: 1.08 * half, upright };
}

/** Window on the bridge, or on its edge if it is too thin; the overview itself if that is near enough. */
function nearWindow({ x, y }, overview) {
  const [left, right] = [Math.min(...x), Math.max(...x)];
  const widest = Math.max(...y);
  const thickness = right - left;
  const { upright } = overview;
  if (Math.max(thickness, widest - Math.min(...y)) < THINNEST * widest) {
    const mean = y.reduce((sum, one) => sum + one, 0) / y.length;
    return { x: 0.5 * (left + right), y: mean, half: 1.6 * thickness, upright };
  }
  // upright, the gap's label stands on one side of the bridge and the card on the other
  const half = Math.max((upright ? 2.1 : 2.2) * widest, 1.2 * thickness);
  if (half > 0.65 * overview.half) return overview;
  return { x: 0.5 * (left + right) + 0.3 * upright * half, y: 0, half, upright };
}

/** A point of the meridian plane in the drawing; what lies far outside is pulled to just beyond the frame. */
function placeIn(window, x, y) {
  const [alongReach, acrossReach] = reachOf(window);
  const along = clip((x - window.x) / window.half, 1.2 * alongReach);
  const across = clip((y - window.y) / window.half, 1.2 * acrossReach);
  return window.upright ? [HALF * across, -HALF * window.upright * along] : [HALF * along, -HALF * across];
}

const clip = (value, most) => Math.min(Math.max(value, -most), most);

// -- What is drawn ----------------------------------------------------------------------------------------------------

function bodyOf(scene, window) {
  const both = scene.solids ?? scene.radii.map((radius) => ({ kind: "sphere", radius }));
  const solids = [
    [both[0], 0, -1],
    [both[1], scene.gap, 1],
  ].map((solid, i) => shapeOf("polygon", `solid solid${i + 1}`, window, outlineOf(...solid, window)));
  if (!scene.x.length) return solids.join("");
  const upper = scene.x.map((x, i) => [x, scene.y[i]]);
  const lower = scene.x.map((x, i) => [x, -scene.y[i]]);
  const menisci = [upper, lower].map((points) => shapeOf("polyline", "meniscus", window, points));
  return [shapeOf("polygon", "liquid", window, [...upper, ...lower.reverse()]), ...solids, ...menisci].join("");
}

/** Closed outline of a solid with its pole on the axis and its body to one side, fine in the window. */
function outlineOf(solid, pole, side, window) {
  const margin = 1.5 * window.half * reachOf(window)[1];
  if (solid.kind !== "sphere") {
    const upper = outlineOfSolid(solid, window.y + margin, 4 * window.half).map(([x, y]) => [pole + side * x, y]);
    return [...upper, ...upper.map(([x, y]) => [x, -y]).reverse()];
  }
  const { radius } = solid;
  if (radius === Infinity) {
    const far = pole + side * 4 * window.half;
    const high = window.y + margin;
    return [
      [pole, high],
      [far, high],
      [far, -high],
      [pole, -high],
    ];
  }
  const turns = Array.from({ length: 49 }, (_, i) => (Math.PI * i) / 48);
  for (let i = 0; i <= 48; i++) turns.push(Math.asin(clip01((window.y - margin + (2 * margin * i) / 48) / radius)));
  turns.sort((one, other) => one - other);
  const upper = turns.map((turn) => [pole + side * 2 * radius * Math.sin(0.5 * turn) ** 2, radius * Math.sin(turn)]);
  return [...upper, ...upper.map(([x, y]) => [x, -y]).reverse()];
}

const clip01 = (value) => Math.min(Math.max(value, 0), 1);

function shapeOf(tag, name, window, points) {
  let before = "";
  const places = [];
  for (const [x, y] of points) {
    const place = placeIn(window, x, y)
      .map((number) => number.toFixed(2))
      .join(",");
    if (place !== before) places.push(place);
    before = place;
  }
  return `<${tag} class="${name}" points="${places.join(" ")}"/>`;
}

/** Axis of symmetry, contact circles seen from the side, and the gap between the poles. */
function measuresOf(scene, window) {
  const beyond = 2 * window.half;
  const parts = [
    shapeOf("polyline", "axis", window, [
      [-beyond, 0],
      [beyond, 0],
    ]),
  ];
  for (const end of scene.x.length ? [0, scene.x.length - 1] : []) {
    const [x, y] = [scene.x[end], scene.y[end]];
    parts.push(
      shapeOf("polyline", "rim", window, [
        [x, -y],
        [x, y],
      ]),
    );
  }
  const far = (window.upright ? -0.5 : -0.8) * window.half * reachOf(window)[1];
  for (const pole of [0, scene.gap])
    parts.push(
      shapeOf("polyline", "measure", window, [
        [pole, 0],
        [pole, far],
      ]),
    );
  const [u, v] = placeIn(window, 0.5 * scene.gap, 1.03 * far);
  const [place, anchor] = window.upright ? [[u, v + 3], "end"] : [[u, v + 8], "middle"];
  return parts.join("") + textAt(...place, gapWords(scene), anchor);
}

/** In words, how far away the axis is that lies out of sight, and the gap on it. */
function distanceOf(scene) {
  return (
    textAt(128, 83, `axis ${show(Math.min(...scene.y), "m", 4)} away`, "end") +
    textAt(128, 93, `${gapWords(scene)} there`, "end")
  );
}

const gapWords = ({ gap }) => `D = ${show(gap, "m", 4)}`;

/** Bar of a round length, with its length: 1, 2 or 5 times a power of ten, about a fifth of the width. */
function barOf(window) {
  const wanted = 0.5 * window.half;
  const decade = 10 ** Math.floor(Math.log10(wanted));
  const length = Math.max(...[1, 2, 5].map((step) => step * decade).filter((one) => one <= wanted));
  const start = HALF * (0.07 - ASPECT);
  const end = start + (HALF * length) / window.half;
  return (
    `<path class="bar" d="M${start.toFixed(2)} ${0.93 * HALF}H${end.toFixed(2)}"/>` +
    textAt(0.5 * (start + end), 89, show(length, "m"), "middle")
  );
}

const textAt = (x, y, words, anchor) =>
  `<text x="${x.toFixed(2)}" y="${y.toFixed(2)}" text-anchor="${anchor}">${words}</text>`;

/** The pair from afar in a corner deep inside a solid, with the window marked in it. */
function cardOf(scene, overview, window) {
  const atRight = window.upright !== 0 || scene.radii[0] < scene.radii[1];
  const atBottom = window.upright !== 0 && showsAxis(window);
  const inset = 0.05 * HALF;
  const [wide, high] = [ASPECT * HALF, HALF];
  const across = (1 - CARD) * wide - inset;
  const down = (1 - CARD) * high - inset;
  const [u, v] = placeIn(overview, window.x, window.y);
  const half = Math.max(window.half / overview.half, 0.05) * HALF; // smaller than that it could not be seen
  const frame = `<rect class="frame" x="${(u - ASPECT * half).toFixed(2)}" y="${(v - half).toFixed(2)}" width="${(2 * ASPECT * half).toFixed(2)}" height="${(2 * half).toFixed(2)}"/>`;
  const place = `translate(${(atRight ? across : -across).toFixed(2)} ${(atBottom ? down : -down).toFixed(2)}) scale(${CARD})`;
  const box = `x="${-wide}" y="${-high}" width="${2 * wide}" height="${2 * high}"`;
  return (
    `<g class="small" transform="${place}"><clipPath id="card"><rect ${box}/></clipPath><rect class="card" ${box}/>` +
    `<g clip-path="url(#card)">${bodyOf(scene, overview)}</g>${frame}<rect class="edge" ${box}/></g>`
  );
}

/** What the picture shows, for those who cannot see it. */
function wordsOf({ question, state }) {
  return `${solidsInWords(question)}, ${state ? "a bridge" : "no bridge"} at a separation of ${show(question.separation, "m")}`;
}

export function solidsInWords({ pair, degrees }) {
  if (pair.solids) return `${pairInWords(pair.solids)}, ${anglesInWords(degrees)}`;
  const [first, second] = pair.radius;
  const size = (radius) => show(radius, "m", 4);
  let solids = `Spheres of radius ${size(first)} and ${size(second)}`;
  if (first === Infinity && second === Infinity) solids = "Two plates";
  else if (first === Infinity) solids = `Plate and sphere of radius ${size(second)}`;
  else if (second === Infinity) solids = `Sphere of radius ${size(first)} on a plate`;
  else if (first === second) solids = `Two spheres of radius ${size(first)}`;
  return `${solids}, ${anglesInWords(degrees)}`;
}

function anglesInWords(degrees) {
  const [one, other] = degrees.map((angle) => `${Number(angle.toPrecision(4))}°`);
  return `contact angle${one === other ? ` ${one}` : `s ${one} and ${other}`}`;
}
