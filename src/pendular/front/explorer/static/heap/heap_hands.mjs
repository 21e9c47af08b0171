// The hand on the heap and on its curves.

import { seenAfter } from "./heap_view.mjs";
import { show } from "../units.mjs";

export const NEARER = { nearer: 1.15 };
export const FARTHER = { nearer: 1 / 1.15 };
const KEYS = {
  ArrowLeft: { by: -5 },
  ArrowRight: { by: 5 },
  ArrowUp: { up: 5 },
  ArrowDown: { up: -5 },
  "+": NEARER,
  "=": NEARER,
  "-": FARTHER,
};
const DEGREES_A_PIXEL = 0.4;

/** The heap is turned by hand and by keys: `seenNow` tells how it is seen, `turn` takes how it is to be seen. */
export function letTurn(canvas, seenNow, turn) {
  let held;
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    held = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
    canvas.classList.add("held");
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    const [x, y] = [event.clientX, event.clientY];
    turn(seenAfter(seenNow(), { by: -DEGREES_A_PIXEL * (x - held[0]), up: DEGREES_A_PIXEL * (y - held[1]) }));
    held = [x, y];
  });
  for (const name of ["pointerup", "pointercancel"])
    canvas.addEventListener(name, () => {
      held = undefined;
      canvas.classList.remove("held");
    });
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in KEYS)) return;
    event.preventDefault();
    turn(seenAfter(seenNow(), KEYS[event.key]));
  });
}

/** A place on the curves is gone to: `sides` tells the suctions and places of their ends, `go` takes a suction. */
export function letPick(svg, readout, sides, go) {
  const suctionAt = (event) => {
    const { low, high, left, right } = sides();
    const share = (event.clientX - svg.getBoundingClientRect().x - left) / (right - left);
    return low * (high / low) ** Math.min(Math.max(share, 0), 1);
  };
  svg.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    svg.setPointerCapture(event.pointerId);
    go(suctionAt(event));
  });
  svg.addEventListener("pointermove", (event) => {
    if (svg.hasPointerCapture(event.pointerId)) go(suctionAt(event));
    else readout.value = `at ${show(suctionAt(event), "Pa", 3)}`;
  });
  svg.addEventListener("pointerleave", () => (readout.value = ""));
}
