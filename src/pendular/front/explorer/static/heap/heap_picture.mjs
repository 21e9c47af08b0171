// The picture of the heap on a canvas, in the colours of the page or of paper, and the bar that tells its scale.

import { readSeen } from "./heap_view.mjs";
import { makeScene } from "./scene.mjs";
import { scaleIn } from "./space.mjs";
import { paperColours } from "../main.mjs";
import { show } from "../units.mjs";

const PNG_SIZE = [1400, 1200];
const EDGE = 0.65; // of the colour of a meniscus, the rest is that of the liquid
const drawScene = makeScene();

/** Draw the heap with so many pixels. */
export function paintHeap(canvas, answer, solver, size, palette = pagePalette()) {
  const { setting, answers, bridges, view } = answer;
  const isClear = view.grains === "clear";
  const { columns, rows } = size;
  const pixels = drawScene({ setting, answers, bridges, view: readSeen(view.seen), palette, isClear, ...size }, solver);
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
