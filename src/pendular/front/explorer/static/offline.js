// Keeps the page of the last visit for when there is no network.
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

addEventListener("fetch", (event) => {
  const isHeap = new URL(event.request.url).pathname.endsWith("/heap.js");
  if (event.request.mode !== "navigate" && !isHeap) return;
  event.respondWith(fetch(event.request).catch(() => caches.match(isHeap ? "heap.js" : "./", { ignoreSearch: true })));
});
