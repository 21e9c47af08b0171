// Which view of the page is open: the pair, or the heap of grains, whose script is loaded when it is first asked for.

import { SHARED } from "./records.mjs";

const HEAP_SCRIPT = "heap.js";
let heap; // the view of the heap, once it is there
let loading;
let isHeapOpen = false;

export const asksForHeap = (hash) => new URLSearchParams(hash).get("view") === "heap";

/** Address of what the heap shows, if that is open. */
export const heapLink = () => (isHeapOpen ? (heap?.hash() ?? location.hash.slice(1)) : undefined);

/** Show the heap of an address. */
export async function openHeap(hash) {
  turnTo(true);
  try {
    heap ??= await loaded();
  } catch {
    loading = undefined; // it may be tried again
    document.getElementById("view-notice").textContent =
      `The file ${HEAP_SCRIPT} beside this page could not be loaded.`;
    return;
  }
  document.getElementById("view-notice").textContent = "";
  if (isHeapOpen) heap.open(hash);
  turnTo(isHeapOpen);
}

export function closeHeap() {
  document.getElementById("view-notice").textContent = "";
  if (isHeapOpen) heap?.close();
  turnTo(false);
}

function turnTo(isHeap) {
  isHeapOpen = isHeap;
  document.getElementById("pair-view").hidden = isHeap;
  const own = document.getElementById("heap-view");
  if (own) own.hidden = !isHeap;
  for (const [id, isHere] of [
    ["to-pair", !isHeap],
    ["to-heap", isHeap],
  ]) {
    const link = document.getElementById(id);
    if (isHere) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
}

/** A plain script, since browsers load no modules from a disk. */
function loaded() {
  loading ??= new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = HEAP_SCRIPT;
    script.addEventListener("load", () => resolve(window.explorer.makeHeap(SHARED())));
    script.addEventListener("error", reject);
    document.head.append(script);
  });
  return loading;
}
