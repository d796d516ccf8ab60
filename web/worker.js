// Keeps the page for visits without a network. `cargo xtask dist` writes the two constants, and makes `sw.js` at the root of the site of it.
//
// Files have hashes of themselves in their names, so each build asks for names of its own: this worker takes over at once, and serves the pages of other
// builds beside those of its own. Pages come from the network first, and so does a new build. Of what a page opens nothing is kept.

/** The build that this worker belongs to; its pages name it too. */
const BUILD = "";
/** What it consists of: `shell` is what each visit uses; each program is kept once it was used. */
const FILES = { shell: [], full: [], webgpu: [] };

const { scope } = registration;
/** Other sites may share the origin. */
const KEPT = `bindpose-${BUILD} ${scope}`;
const SHARED = `shared ${scope}`;

/** A line that is there but does not answer is none. */
const PATIENCE_MS = 5000;

const addressOf = (name) => new URL(name, scope).href;
const hashIn = (address) => /\.([0-9a-f]{16})\.\w+$/.exec(address)?.[1];

addEventListener("install", (event) => event.waitUntil(install()));
addEventListener("activate", (event) => event.waitUntil(Promise.all([clients.claim(), forgetOthers()])));
addEventListener("message", (event) => {
  event.source.postMessage({ build: BUILD });
  // Where there is no room for it, visits go on as they did.
  // Other builds are forgotten now: this page holds its lock, and pages that were closed hold none.
  event.waitUntil(keep(filesOf(event.data.programs)).catch(() => {}).then(forgetOthers));
});
addEventListener("fetch", (event) => {
  const { request } = event;
  const { origin, pathname } = new URL(request.url);
  const address = origin + pathname;
  if (request.method === "POST" && address === addressOf("share")) return event.respondWith(share(request));
  if (request.method !== "GET" || !address.startsWith(scope)) return;
  const page = address === addressOf("index.html") ? scope : address;
  if (hashIn(address)) {
    event.respondWith(keptOrAsked(request));
  } else if (FILES.shell.some((name) => addressOf(name) === page)) {
    event.respondWith(askedOrKept(request, page));
  }
});

/** All or nothing: until the last file is there, the build before this one stays. */
async function install() {
  try {
    await keep([...FILES.shell, ...filesOf(await usedPrograms())]);
  } catch (error) {
    await caches.delete(KEPT);
    throw error;
  }
  await skipWaiting();
}

const filesOf = (programs) => programs.flatMap((program) => FILES[program] ?? []);

/** The programs that are kept of other builds. */
async function usedPrograms() {
  const names = (await caches.keys()).filter(isBuild);
  const requests = await Promise.all(names.map(async (name) => (await caches.open(name)).keys()));
  const folders = { webgpu: addressOf("pkg/webgpu/"), full: addressOf("pkg/") };
  const of = ({ url }) => Object.keys(folders).find((program) => url.startsWith(folders[program]));
  return Array.from(new Set(requests.flat().map(of))).filter(Boolean);
}

const isBuild = (cache) => cache.startsWith("bindpose-") && cache.endsWith(` ${scope}`);

/** Keeps those of the files that are not there yet. */
async function keep(names) {
  const cache = await caches.open(KEPT);
  await Promise.all(names.map(addressOf).map(async (address) => {
    if (await cache.match(address, { ignoreVary: true })) return;
    const known = hashIn(address) && (await caches.match(address, { ignoreVary: true })); // Of another build.
    await cache.put(address, known || (await download(address, "default").catch(() => download(address, "reload"))));
  }));
}

/** A file that is whole and of this build, whatever a host answers. */
async function download(address, cache) {
  const response = await fetch(address, { cache });
  const body = await response.blob();
  const isOwn = hashIn(address) ? hashOf(await body.arrayBuffer()) === hashIn(address) : (await body.text()).includes(BUILD);
  if (response.status !== 200 || response.type !== "basic" || !isOwn) throw new Error(`${address} is not of build ${BUILD}`);
  // A copy may answer a navigation also where the host came to it by a redirection.
  return new Response(body, { headers: response.headers });
}

/** FNV-1a with 64 bits, as in the names: the prime is 2^40 + 435. */
function hashOf(buffer) {
  let [high, low] = [0xcbf29ce4, 0x84222325];
  for (const byte of new Uint8Array(buffer)) {
    low = (low ^ byte) >>> 0;
    const product = low * 435;
    high = (high * 435 + Math.floor(product / 2 ** 32) + ((low << 8) >>> 0)) >>> 0;
    low = product >>> 0;
  }
  return [high, low].map((half) => half.toString(16).padStart(8, "0")).join("");
}

/** A file of whichever build. */
async function keptOrAsked(request) {
  return (await caches.match(request.url, { ignoreVary: true })) ?? fetch(request);
}

/** A page of the newest build that can be reached. Many hosts let a browser take it for new for minutes: so they are asked each time. */
async function askedOrKept(request, page) {
  const asked = fetch(request, { cache: "no-cache" });
  const late = new Promise((done) => setTimeout(done, PATIENCE_MS));
  const answer = await Promise.race([asked, late]).catch(() => null);
  if (answer && answer.status < 500) return answer;
  return (await caches.match(page, { cacheName: KEPT, ignoreVary: true })) ?? asked;
}

/** Forgets other builds, but for those that a page still runs: each page holds a lock. */
async function forgetOthers() {
  // A newer worker may be filling its own.
  if (registration.installing || registration.waiting) return;
  const { held } = await navigator.locks.query();
  const isRun = (cache) => held.some(({ name }) => name === cache.split(" ")[0]);
  const others = (await caches.keys()).filter((cache) => isBuild(cache) && cache !== KEPT && !isRun(cache));
  await Promise.all(others.map((cache) => caches.delete(cache)));
}

/** Puts what another program shares where the page finds it, by the address that it is opened at. */
async function share(request) {
  const address = addressOf(`?shared=${crypto.randomUUID()}`);
  const headers = { "Content-Type": request.headers.get("Content-Type") };
  const put = async () => (await caches.open(SHARED)).put(address, new Response(await request.blob(), { headers }));
  await put().catch(() => {}); // The page says that nothing is there.
  return Response.redirect(address, 303);
}
