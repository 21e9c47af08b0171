// The picture of the heap on a canvas, in the colours of the page or of paper, and the bar that tells its scale.

import { readSeen } from "./heap_view.mjs";
import { makeScene } from "./scene.mjs";
import { scaleIn } from "./space.mjs";
import { paperColours } from "../main.mjs";
import { show } from "../units.mjs";

const PNG_SIZE = [1400, 1200];
const PAINTING = 8; // time in one go, [ms], so that a hand that begins again is not felt
const EDGE = 0.65; // of the colour of a meniscus, the rest is that of the liquid
const drawScene = makeScene();

/** Draw the heap with so many pixels. */
export function paintHeap(canvas, answer, solver, size, palette = pagePalette()) {
  const steps = stepsOf(answer, solver, size, palette);
  let step = steps.next();
  while (!step.done) step = steps.next();
  putPixels(canvas, size, step.value);
}

/** Draw it by and by; returns a function that stops it. */
export function paintSlowly(canvas, answer, solver, size) {
  const steps = stepsOf(answer, solver, size, pagePalette());
  let timer;
  const goOn = () => {
    const until = performance.now() + PAINTING;
    let step = steps.next();
    while (!step.done && performance.now() < until) step = steps.next();
    if (step.done) putPixels(canvas, size, step.value);
    else timer = setTimeout(goOn);
  };
  timer = setTimeout(goOn);
  return () => clearTimeout(timer);
}

function stepsOf({ setting, answers, bridges, view }, solver, size, palette) {
  const isClear = view.grains === "clear";
  return drawScene({ setting, answers, bridges, view: readSeen(view.seen), palette, isClear, ...size }, solver);
}

function putPixels(canvas, { columns, rows }, pixels) {
  if (canvas.width !== columns || canvas.height !== rows) Object.assign(canvas, { width: columns, height: rows });
  canvas.getContext("2d").putImageData(new ImageData(pixels, columns, rows), 0, 0);
}

/** The heap as a file, on white, whatever the page has; `done` takes its content. */
export function writePicture(answer, solver, done) {
  const canvas = document.createElement("canvas");
  const paper = paperColours();
  const palette = pictureColours((name) => paper[name === "--ball" ? "--grain" : name]);
  const [columns, rows] = PNG_SIZE;
  paintHeap(canvas, answer, solver, { columns, rows, isFine: true }, palette);
  const context = canvas.getContext("2d");
  context.globalCompositeOperation = "destination-over";
  context.fillStyle = paper["--panel"];
  context.fillRect(0, 0, columns, rows);
  canvas.toBlob(done);
}

/** Bar of a round length, with its length, as SVG text: about a fifth of the picture. */
export function lengthBar({ question, view }, width, height) {
  const metre = scaleIn(question.heap, readSeen(view.seen), width, height);
  const wanted = (0.2 * Math.min(width, height)) / metre;
  const decade = 10 ** Math.floor(Math.log10(wanted));
  const length = Math.max(...[1, 2, 5].map((step) => step * decade).filter((one) => one <= wanted));
  return `<path d="M4 24H${(4 + length * metre).toFixed(1)}"/><text x="4" y="16">${show(length, "m")}</text>`;
}

/** Colours of the picture as the style sheet has them. */
function pagePalette() {
  const style = getComputedStyle(document.documentElement);
  return pictureColours((name) => style.getPropertyValue(name));
}

function pictureColours(colour) {
  const rgb = (name) => {
    const hex = colour(name).trim().slice(1);
    return [0, 2, 4].map((i) => Number.parseInt(hex.slice(i, i + 2), 16));
  };
  const edge = rgb("--liquid-edge");
  const liquid = rgb("--liquid").map((part, k) => EDGE * edge[k] + (1 - EDGE) * part);
  return { grain: rgb("--ball"), liquid, kept: rgb("--accent"), ground: rgb("--panel") };
}
