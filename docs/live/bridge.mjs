// The bridge that moves on the front page: a pair to scale, its force curve, and what a reader changes.

const RADIUS = 50e-6; // of the first grain [m]
const WATER = 0.0728; // [N/m]
const MOST_RATIO = 20; // of the second radius; above, a plane
const CURVE_POINTS = 48;
const ARC_POINTS = 60;
const BEYOND = 1.25; // of the rupture distance, to which a grain may be pulled
const PERIOD = 9000; // of a pull by itself [ms]
const SCALE = 48 / RADIUS; // of the picture [1/m]

export function show({ bridge, bridges, rupture }) {
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
    drawScene(at, pair, gap, state);
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

function drawScene(at, pair, gap, state) {
  const shift = -0.5 * gap; // the middle of the gap stays in the middle
  const place = (x, y) => `${(SCALE * (x + shift)).toFixed(2)} ${(-SCALE * y).toFixed(2)}`;
  at("solid1").setAttribute("d", solid(-1, pair.radius[0], 0, place));
  at("solid2").setAttribute("d", solid(1, pair.radius[1], gap, place));
  at("liquid").setAttribute("d", state ? liquid(pair, gap, state, place) : "");
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

function liquid(pair, gap, state, place) {
  const [depth1, depth2] = state.halfFillingAngle.map((angle, i) =>
    pair.radius[i] === Infinity ? 0 : pair.radius[i] * (1 - Math.cos(angle)),
  );
  const arc = meridian(state.meridian);
  const from = -depth1;
  const stretch = (gap + depth2 - from) / arc.at(-1).x; // 1 but for the rounding of the sum
  const upper = arc.map(({ x, y }) => place(from + stretch * x, y));
  const lower = arc.map(({ x, y }) => place(from + stretch * x, -y)).reverse();
  const cap = (i, x, y) => {
    const r = (SCALE * pair.radius[i]).toFixed(2);
    return pair.radius[i] === Infinity ? `L${place(x, y)}` : `A${r} ${r} 0 0 0 ${place(x, y)}`;
  };
  const [first, last] = [arc[0], arc.at(-1)];
  return `M${upper.join("L")}${cap(1, from + stretch * last.x, -last.y)}L${lower.join("L")}${cap(0, from, first.y)}Z`;
}

// Points of the arc from its first end: ζ(s) = Y exp(iφ) is (1 + Hζ(s)) = (1 + Hζm) exp(iHs), and dx = cos φ ds.
function meridian({ radius, slope, halfLength, curvature }) {
  const points = [];
  let x = 0;
  let before;
  for (let i = 0; i <= ARC_POINTS; i++) {
    const s = halfLength * ((2 * i) / ARC_POINTS - 1);
    const [cos, sin] = [Math.cos(curvature * s), Math.sin(curvature * s)];
    const half = 0.5 * curvature * s;
    const chord = half === 0 ? s : (s * Math.sin(half)) / half; // (exp(iHs) - 1)/(iH) = chord exp(iHs/2)
    const [real, imaginary] = [radius * Math.cos(slope), radius * Math.sin(slope)];
    const re = real * cos - imaginary * sin - chord * Math.sin(half);
    const im = real * sin + imaginary * cos + chord * Math.cos(half);
    const y = Math.hypot(re, im);
    const run = re / y;
    if (before !== undefined) x += (0.5 * (run + before) * 2 * halfLength) / ARC_POINTS;
    before = run;
    points.push({ x, y });
  }
  return points;
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

const PREFIXES = [[1e-15, "f"], [1e-12, "p"], [1e-9, "n"], [1e-6, "µ"], [1e-3, "m"], [1, ""], [1e3, "k"], [1e6, "M"]];

function quantity(value, unit) {
  const [size, prefix] = PREFIXES.findLast(([least]) => Math.abs(value) >= least) ?? PREFIXES[0];
  return `${Number((value / size).toPrecision(3))}\u00a0${prefix}${unit}`;
}

function tell(at, pair, water, end, gap, state) {
  const ratio = pair.radius[1] / pair.radius[0];
  at("gap-told").value = quantity(gap, "m");
  at("suction-told").value = quantity(water.suction, "Pa");
  at("angle-told").value = `${Math.round((pair.contactAngle * 180) / Math.PI)}°`;
  at("size-told").value = ratio === Infinity ? "a plane" : ratio === 1 ? "equal" : `${Number(ratio.toPrecision(2))} times`;
  at("told").textContent = state
    ? `Force ${quantity(state.force, "N")}, liquid ${quantity(1e3 * state.volume, "L")}, breaks at ${quantity(end.separation, "m")}.`
    : `No bridge: it broke at ${quantity(end.separation, "m")}, where its force was ${quantity(end.force, "N")}.`;
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
