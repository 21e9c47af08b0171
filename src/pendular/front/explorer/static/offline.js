// Keeps the page of the last visit, and the solver of other solids once it was used, for when there is no network.
const KEPT = "pendular {digest}";
const FILES = ["./", "heap.js"];

addEventListener("install", (event) => {
  event.waitUntil(
    caches
      .open(KEPT)
      .then((cache) => cache.addAll(FILES))
      .then(() => self.skipWaiting()),
  );
});

addEventListener("activate", (event) => {
  const drop = (names) =>
    Promise.all(
      names.filter((name) => name.startsWith("pendular ") && name !== KEPT).map((name) => caches.delete(name)),
    );
  event.waitUntil(
    caches
      .keys()
      .then(drop)
      .then(() => self.clients.claim()),
  );
});

async function solids(request) {
  const cache = await caches.open(KEPT);
  try {
    const found = await fetch(request);
    if (found.ok) await cache.put(request, found.clone());
    return found;
  } catch (error) {
    const kept = await cache.match(request);
    if (!kept) throw error;
    return kept;
  }
}

addEventListener("fetch", (event) => {
  if (event.request.url.endsWith("/solids.js")) event.respondWith(solids(event.request));
  const isHeap = new URL(event.request.url).pathname.endsWith("/heap.js");
  if (event.request.mode !== "navigate" && !isHeap) return;
  event.respondWith(fetch(event.request).catch(() => caches.match(isHeap ? "heap.js" : "./", { ignoreSearch: true })));
});
