// The service worker: it keeps the page for use without a network.
//
// A page is of one version, all of it. The build lists every file of a version with its digest in files.json,
// and writes the version into this file. A browser that finds this file changed fetches the whole list into a
// cache of its own; one file that is not as listed ends that, and the old version stays. The new one takes
// over when no window shows the old one any more, or when the only window is loaded anew. Addresses name the
// version, so what the window has loaded is not loaded again.

const VERSION = "";

const worker = /** @type {ServiceWorkerGlobalScope} */ (/** @type {unknown} */ (self));
// Other pages may live on the same server, and their caches beside ours.
const OURS = `mediant ${worker.registration.scope} `;
const CACHE = OURS + VERSION;

/** Fetches all files of this version. */
async function store() {
  const listed = await fetch("files.json", { cache: "no-store" });
  const { version, files } = await listed.json();
  if (version !== VERSION) {
    throw new Error(`The server has version ${version} of the page and the service worker of ${VERSION}.`);
  }
  const cache = await caches.open(CACHE);
  await Promise.all(
    Object.entries(files).map(async ([path, integrity]) => {
      // A digest that differs is a failure of the request.
      const address = `${path}?v=${VERSION}`;
      const response = await fetch(address, { cache: "force-cache", integrity }).catch(() =>
        fetch(address, { cache: "reload", integrity }),
      );
      if (!response.ok) {
        throw new Error(`${path}: ${response.status}`);
      }
      // Made anew: browsers refuse to show a page from a response that was redirected.
      const type = response.headers.get("content-type") ?? "application/octet-stream";
      const kept = new Response(await response.arrayBuffer(), { headers: { "content-type": type } });
      await cache.put(path, kept);
    }),
  );
}

/** Removes the caches of other versions, and serves windows that were opened before this one was there. */
async function takeOver() {
  const names = await caches.keys();
  const old = names.filter((name) => name.startsWith(OURS) && name !== CACHE);
  await Promise.all(old.map((name) => caches.delete(name)));
  await worker.clients.claim();
}

/**
 * Whether this reload is of the only window, so that a new version can take over. Browsers that do not say
 * what is reloaded let the new version wait until all windows are closed.
 * @param {FetchEvent} event
 */
async function isLastOfOld(event) {
  if (event.request.mode !== "navigate" || !worker.registration.waiting) return false;
  const { isReloadNavigation } = /** @type {Request & { isReloadNavigation?: boolean }} */ (event.request);
  const { replacesClientId } = /** @type {FetchEvent & { replacesClientId?: string }} */ (event);
  const windows = await worker.clients.matchAll({ includeUncontrolled: true, type: "window" });
  if (windows.length > 1) return false;
  return isReloadNavigation || windows.some(({ id }) => id === replacesClientId);
}

/** A page that loads itself anew; a header cannot do that where the address has a `#`. */
const AGAIN = "<!doctype html><title>Mediant</title><script>location.reload()</script>";
/** Whether a new version was told to take over. */
let isLeaving = false;

/**
 * Answers from the cache, or from the network what is not in the list.
 * @param {FetchEvent} event
 */
async function answer(event) {
  isLeaving ||= await isLastOfOld(event);
  if (isLeaving && event.request.mode === "navigate") {
    // The new version cannot begin while this one answers: the window asks again, until it gets that one.
    worker.registration.waiting?.postMessage("take over");
    return new Response(AGAIN, { headers: { "content-type": "text/html" } });
  }
  const address = new URL(event.request.url);
  const path = address.pathname.endsWith("/") ? `${address.pathname}index.html` : address.pathname;
  const cache = await caches.open(CACHE);
  return (await cache.match(path, { ignoreSearch: true })) ?? fetch(event.request);
}

worker.addEventListener("install", (event) => event.waitUntil(store()));
worker.addEventListener("activate", (event) => event.waitUntil(takeOver()));
worker.addEventListener("message", (event) => {
  if (event.data === "take over") {
    worker.skipWaiting();
  }
});
worker.addEventListener("fetch", (event) => {
  const { request } = event;
  if (request.method === "GET" && request.url.startsWith(worker.registration.scope)) {
    event.respondWith(answer(event));
  }
});
