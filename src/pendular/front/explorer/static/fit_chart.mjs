// Picture of a measured curve: its points, the bridge that fits them, and what is left over its error beneath.

import { circle, pathOf, ticksBetween } from "./chart.mjs";
import { scaleOf, show, signed } from "./units.mjs";

const EDGES = { left: 62, right: 12, top: 14, bottom: 46, between: 30 };
const LOWER = 0.3; // share of the residuals
const ROOM_AROUND = 0.05;
const MOST_DOTS = 2000; // that are drawn: of more, every second or third, and so on
const LEAST_RESIDUAL = 2; // to which their axis reaches

const endsOf = (values) =>
  values.reduce(([low, high], one) => [Math.min(low, one), Math.max(high, one)], [Infinity, -Infinity]);

/** SVG text for a size in pixels of a curve alone, or with its fit, and the picture in words. */
export function fitChartOf({ separation, force }, fit, width, height) {
  const gap = scaleOf(Math.max(...endsOf(separation).map(Math.abs)), "m");
  const strength = scaleOf(Math.max(...endsOf(force).map(Math.abs)), "N");
  const reach = fit?.ruptureSeparation > 0 ? [fit.ruptureSeparation] : [];
  const across = axisOf(endsOf([...separation, ...reach]), EDGES.left, width - EDGES.right);
  const floor = height - EDGES.bottom;
  const room = floor - EDGES.top - EDGES.between;
  const middle = fit ? EDGES.top + (1 - LOWER) * room : floor;
  const seen = fit ? [...force, ...fit.line.force.filter(Number.isFinite)] : force;
  const up = axisOf(endsOf([0, ...seen]), middle, EDGES.top);
  const parts = [
    sideAxis(up, strength.factor, middle, width, `force (${strength.unit})`, EDGES.top, 52),
    footAxis(across, gap.factor, floor, `separation as measured (${gap.unit})`, width, height),
    `<path class="axis" d="M${EDGES.left} ${up(0).toFixed(1)}H${width - EDGES.right}"/>`,
  ];
  if (fit?.measuredRupture) parts.push(datumBand(fit.measuredRupture, across, EDGES.top, middle));
  parts.push(dots(separation.map(across), force.map(up)));
  if (fit) {
    const { line } = fit;
    parts.push(
      `<path class="stable" d="${pathOf(line.separation.map((one, i) => [across(one), up(line.force[i])]))}"/>`,
    );
    const end = line.force.at(-1);
    if (reach.length && Number.isFinite(end)) parts.push(circle(across(line.separation.at(-1)), up(end), 4, "rupture"));
    parts.push(residualsPart(fit, across, middle + EDGES.between, floor, width));
  }
  const words = fit
    ? `${force.length} measured points of the force with the fitted bridge up to its rupture at ${show(fit.ruptureSeparation, "m", 4)}, and the residuals beneath`
    : `${force.length} measured points of the force`;
  return { svg: parts.join(""), words };
}

/** Place in pixels of a value between two ends, with some room. */
function axisOf([low, high], from, to) {
  const room = ROOM_AROUND * (high - low) || 1;
  const [first, last] = [low - room, high + room];
  return Object.assign((value) => from + ((value - first) / (last - first)) * (to - from), { first, last });
}

function residualsPart(fit, across, top, floor, width) {
  const left = fit.residuals.map((one, i) => one / fit.forceError[i]);
  const most = Math.max(LEAST_RESIDUAL, ...endsOf(left).map(Math.abs));
  const up = axisOf([-most, most], floor, top);
  const [above, below] = [up(1), up(-1)].map((one) => one.toFixed(1));
  return [
    `<path class="band" d="M${EDGES.left} ${above}H${width - EDGES.right}V${below}H${EDGES.left}Z"/>`,
    sideAxis(up, 1, floor, width, "residual / error", top, 34),
    `<path class="axis" d="M${EDGES.left} ${up(0).toFixed(1)}H${width - EDGES.right}"/>`,
    dots(fit.separation.map(across), left.map(up)),
  ].join("");
}

function datumBand([place, error], across, top, floor) {
  const [left, right] = [across(place - error), across(place + error)];
  return `<path class="band" d="M${left.toFixed(1)} ${top}V${floor.toFixed(1)}H${Math.max(right, left + 1).toFixed(1)}V${top}Z"/>`;
}

function sideAxis(up, factor, floor, width, title, top, step) {
  const ticks = ticksBetween(up.first * factor, up.last * factor, Math.max(3, (floor - top) / step));
  const lines = ticks.map((tick) => {
    const y = up(tick / factor).toFixed(1);
    return `<path class="grid" d="M${EDGES.left} ${y}H${width - EDGES.right}"/><text class="tick" x="${EDGES.left - 7}" y="${Number(y) + 4}" text-anchor="end">${signed(String(tick))}</text>`;
  });
  return [
    ...lines,
    `<path class="axis" d="M${EDGES.left} ${top}V${floor.toFixed(1)}"/>`,
    `<text class="title" transform="translate(15 ${(0.5 * (top + floor)).toFixed(1)}) rotate(-90)" text-anchor="middle">${title}</text>`,
  ].join("");
}

function footAxis(across, factor, floor, title, width, height) {
  const ticks = ticksBetween(
    across.first * factor,
    across.last * factor,
    Math.max(3, (width - EDGES.left - EDGES.right) / 80),
  );
  const marks = ticks.map((tick) => {
    const x = across(tick / factor).toFixed(1);
    return `<path class="axis" d="M${x} ${floor}v4"/><text class="tick" x="${x}" y="${floor + 17}" text-anchor="middle">${signed(String(tick))}</text>`;
  });
  return [
    `<path class="axis" d="M${EDGES.left} ${floor}H${width - EDGES.right}"/>`,
    ...marks,
    `<text class="title" x="${0.5 * (EDGES.left + width - EDGES.right)}" y="${height - 8}" text-anchor="middle">${title}</text>`,
  ].join("");
}

/** Points as one path of dots. */
function dots(xs, ys) {
  const every = Math.ceil(xs.length / MOST_DOTS);
  const drawn = xs.map((x, i) =>
    i % every || !Number.isFinite(ys[i]) ? "" : `M${x.toFixed(1)} ${ys[i].toFixed(1)}h0`,
  );
  return `<path class="dots" d="${drawn.join("")}"/>`;
}
