// The bridge that moves on the front page: a pair to scale, its force curve, and what a reader changes.

import { show } from "./units.mjs";

const RADIUS = 50e-6; // of the first grain [m]
const WATER = 0.0728; // [N/m]
const MOST_RATIO = 20; // of the second radius; above, a plane
const CURVE_POINTS = 48;
const ARC_POINTS = 61;
const BEYOND = 1.25; // of the rupture distance, to which a grain may be pulled
const PERIOD = 9000; // of a pull by itself [ms]
const SCALE = 48 / RADIUS; // of the picture [1/m]

export function begin({ bridge, bridges, rupture, profile }) {
  const at = (name) => document.getElementById(`live-${name}`);
  const sliders = { gap: at("gap"), suction: at("suction"), angle: at("angle"), size: at("size") };
  Object.assign(sliders.suction, { value: 3.3 });
  Object.assign(sliders.angle, { value: 20 });
  Object.assign(sliders.size, { value: 0 });
  let moves = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  let known; // the pair and its curve, until a slider other than the separation moves

  function pairAsked() {
    const size = Number(sliders.size.value);
    const radius2 = size === 1 ? Infinity : RADIUS * MOST_RATIO ** size;
    const angle = (Number(sliders.angle.value) * Math.PI) / 180;
    const pair = { radius: [RADIUS, radius2], contactAngle: angle };
    const water = { suction: 10 ** Number(sliders.suction.value), surfaceTension: WATER };
    const end = rupture(pair, water);
    const share = (i) => 1 - (1 - i / CURVE_POINTS) ** 2; // dense at rupture, where the curve is steep
    const gaps = Array.from({ length: CURVE_POINTS }, (_, i) => end.separation * share(i));
    return { pair, water, end, curve: [...bridges(pair, gaps, water), end] };
  }

  function draw() {
    known ??= pairAsked();
    const { pair, water, end, curve } = known;
    const gap = Number(sliders.gap.value) * BEYOND * end.separation;
    const state = bridge(pair, gap, water);
    drawScene(at, pair, gap, state, profile);
    drawCurve(at, curve, end, gap, state);
    tell(at, pair, water, end, gap, state);
  }

  for (const [name, slider] of Object.entries(sliders))
    slider.addEventListener("input", () => {
      moves = false;
      if (name !== "gap") known = undefined;
      draw();
    });
  letPull(at("solid2"), sliders.gap, () => known, () => { moves = false; draw(); });
  sliders.gap.value = 0.3;
  at("bridge").hidden = false;
  draw();

  const started = performance.now();
  function frame(now) {
    if (!moves) return;
    sliders.gap.value = 0.5 - 0.5 * Math.cos((2 * Math.PI * (now - started + 1500)) / PERIOD);
    draw();
    requestAnimationFrame(frame);
  }
  if (moves) requestAnimationFrame(frame);
}

// -- Pictures --------------------------------------------------------------------------------------------------------

function drawScene(at, pair, gap, state, profile) {
  const shift = -0.5 * gap; // the middle of the gap stays in the middle
  const place = (x, y) => `${(SCALE * (x + shift)).toFixed(2)} ${(-SCALE * y).toFixed(2)}`;
  at("solid1").setAttribute("d", solid(-1, pair.radius[0], 0, place));
  at("solid2").setAttribute("d", solid(1, pair.radius[1], gap, place));
  at("liquid").setAttribute("d", state ? liquid(pair, profile(pair, state, ARC_POINTS), place) : "");
}

function solid(side, radius, pole, place) {
  if (radius === Infinity) {
    const far = pole + side * 8 * RADIUS;
    const high = 8 * RADIUS;
    return `M${place(pole, high)}L${place(far, high)}L${place(far, -high)}L${place(pole, -high)}Z`;
  }
  const r = (SCALE * radius).toFixed(2);
  return `M${place(pole, 0)}A${r} ${r} 0 1 1 ${place(pole + 2 * side * radius, 0)}A${r} ${r} 0 1 1 ${place(pole, 0)}Z`;
}

function liquid(pair, { x, y }, place) {
  const points = Array.from(x, (along, i) => [along, y[i]]);
  const upper = points.map(([along, across]) => place(along, across));
  const lower = points.map(([along, across]) => place(along, -across)).reverse();
  const cap = (i, end) => {
    const r = (SCALE * pair.radius[i]).toFixed(2);
    return pair.radius[i] === Infinity ? `L${end}` : `A${r} ${r} 0 0 0 ${end}`;
  };
  return `M${upper.join("L")}${cap(1, lower[0])}L${lower.join("L")}${cap(0, upper[0])}Z`;
}

function drawCurve(at, curve, end, gap, state) {
  const most = Math.max(...curve.map(({ force }) => force));
  const x = (value) => 30 + (174 * value) / (BEYOND * end.separation);
  const y = (value) => 112 - (92 * value) / most;
  const points = curve.map(({ separation, force }) => `${x(separation).toFixed(1)} ${y(force).toFixed(1)}`);
  at("curve").setAttribute("d", `M${points.join("L")}L${x(end.separation).toFixed(1)} 112L${x(BEYOND * end.separation)} 112`);
  at("end").setAttribute("x1", x(end.separation));
  at("end").setAttribute("x2", x(end.separation));
  at("end-word").setAttribute("x", x(end.separation));
  at("point").setAttribute("cx", x(gap));
  at("point").setAttribute("cy", y(state?.force ?? 0));
}

// -- Words -----------------------------------------------------------------------------------------------------------

const DIGITS = 3;

function tell(at, pair, water, end, gap, state) {
  const ratio = pair.radius[1] / pair.radius[0];
  at("gap-told").value = show(gap, "m", DIGITS);
  at("suction-told").value = show(water.suction, "Pa", DIGITS);
  at("angle-told").value = `${Math.round((pair.contactAngle * 180) / Math.PI)}°`;
  at("size-told").value = ratio === Infinity ? "a plane" : ratio === 1 ? "equal" : `${Number(ratio.toPrecision(2))} times`;
  at("told").textContent = state
    ? `Force ${show(state.force, "N", DIGITS)}, liquid ${show(state.volume, "m^3", DIGITS)}, breaks at ${show(end.separation, "m", DIGITS)}.`
    : `No bridge: it broke at ${show(end.separation, "m", DIGITS)}, where its force was ${show(end.force, "N", DIGITS)}.`;
}

// -- Hands -----------------------------------------------------------------------------------------------------------

function letPull(grain, slider, known, pulled) {
  let held;
  grain.addEventListener("pointerdown", (event) => {
    grain.setPointerCapture(event.pointerId);
    held = { x: event.clientX, share: Number(slider.value) };
    event.preventDefault();
  });
  grain.addEventListener("pointermove", (event) => {
    if (!held) return;
    const unit = grain.ownerSVGElement.getScreenCTM().a * SCALE; // pixels a metre
    slider.value = held.share + (2 * (event.clientX - held.x)) / (unit * BEYOND * known().end.separation);
    pulled();
  });
  for (const name of ["pointerup", "pointercancel"]) grain.addEventListener(name, () => (held = undefined));
}
