// The page as hosts have it: without a network after one visit, from one build to the next, and as a program of the system.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { BACKEND, FIXTURES, SAMPLE, dropAndWait, keep, launchAtHome, state, test as eachTest, until } from "./harness.js";
import { hostOf } from "./host.js";
import { pretendGpu } from "./programs.js";
import { KINDS } from "../../web/files.js";

const QUERY = `?backend=${BACKEND}&quality=low&scale=0.2`;
const OTHER = `${FIXTURES}good/d3d12_skinned.m3d`;

/** A test with a host of its own, which serves the first build: so it has a worker and caches of its own too. Without a network a page logs errors. */
function test(name, options, body) {
  eachTest(name, { bare: true, query: "web/icon.svg", expectErrors: true, ...options }, async (page) => {
    const host = await hostOf("one");
    try {
      await body(page, host);
    } finally {
      await page.goto("about:blank");
      await host.stop().catch(() => {});
    }
  });
}

/** Waits until the page shows this model. */
const shows = (page, wanted = "figure.m3d") => until(page, ({ backend, model }) => backend === BACKEND && model?.name === wanted);

async function visit(page, { address }) {
  await page.goto(address + QUERY);
  await shows(page);
}

/** The build that a page belongs to. */
const buildOf = (page) => page.evaluate(() => document.querySelector("meta[name=build]").content);

/** What is kept: names of files by build. */
const kept = (page) =>
  page.evaluate(async () => {
    const builds = {};
    for (const name of await caches.keys()) {
      const requests = await (await caches.open(name)).keys();
      const [of, scope] = name.split(" ");
      builds[of] = requests.map(({ url }) => url.slice(scope.length));
    }
    return builds;
  });

/** Waits until a build and so many programs are kept; gives all that is. */
async function keptWhole(page, build, programs = 1) {
  for (const deadline = Date.now() + 30_000; ; await new Promise((done) => setTimeout(done, 50))) {
    const builds = await kept(page).catch(() => ({}));
    const names = builds[`bindpose-${build}`] ?? [];
    if (names.filter((name) => name.startsWith("pkg/")).length === 2 * programs) return builds;
    assert.ok(Date.now() < deadline, JSON.stringify(builds));
  }
}

/** The names that the page used, but for those that keep theirs. */
const used = (page) =>
  page.evaluate(() => performance.getEntriesByType("resource").map(({ name }) => new URL(name).pathname.slice("/some/where/".length)).filter((name) => /\.[0-9a-f]{16}\./.test(name)));

test("after one visit the page opens without a network, and a file that is dropped then", { draws: true }, async (page, host) => {
  await visit(page, host);
  const build = await buildOf(page);
  const builds = await keptWhole(page, build);
  assert.deepEqual(Object.keys(builds), [`bindpose-${build}`]);
  const names = builds[`bindpose-${build}`];
  assert.ok(names.includes("") && names.includes("web/codes.html"));
  const folder = BACKEND === "webgpu" ? "pkg/webgpu/" : "pkg/";
  const program = names.filter((name) => name.startsWith("pkg/"));
  assert.deepEqual(program.map((name) => name.replace(/[^/]*$/, "")), [folder, folder], "the program of this visit, and not the other");
  await host.stop();
  await visit(page, host);
  const { model } = await dropAndWait(page, [OTHER]);
  assert.equal(model.name, "d3d12_skinned.m3d");
  await page.goto(`${host.address}web/codes.html`);
  assert.equal(await page.title(), "Findings of Bindpose");
  // What an address names is asked for each time.
  await host.start();
  const named = page.waitForResponse(/theirs\.m3d/);
  await page.goto(`${host.address}${QUERY}&src=web/theirs.m3d`);
  await (await named).finished();
  assert.deepEqual(Object.values(await kept(page)).flat().filter((name) => name.includes("theirs")), []);
});

test("a visit that took both programs opens without a network too", { only: "webgpu", prepare: pretendGpu({ device: "refused" }) }, async (page, host) => {
  const open = async () => {
    await page.goto(`${host.address}?quality=low&scale=0.2`);
    await until(page, ({ backend, model }) => backend === "webgl2" && model?.name === "figure.m3d");
  };
  await open();
  const names = (await keptWhole(page, await buildOf(page), 2))[`bindpose-${await buildOf(page)}`];
  assert.equal(names.filter((name) => name.startsWith("pkg/")).length, 4);
  await host.stop();
  await open();
});

eachTest("the page as it is served while one develops has no worker", {}, async (page) => {
  assert.deepEqual(await page.evaluate(async () => [(await navigator.serviceWorker.getRegistrations()).length, globalThis.caches && (await caches.keys())]), [0, []]);
});

test("a newer build says so, is taken by a click and leaves the pages of the older one whole", {}, async (page, host) => {
  await visit(page, host);
  const one = await buildOf(page);
  const before = (await keptWhole(page, one))[`bindpose-${one}`];
  const other = await page.context().newPage();
  await other.setViewportSize(page.viewportSize());
  await other.emulateMedia({ reducedMotion: "reduce" });
  await visit(other, host);
  assert.equal(await page.isHidden("#newer"), true);

  // A page that stays open hears of it, and so does the other.
  host.build = "two";
  host.asked.length = 0;
  await page.evaluate(async () => (await navigator.serviceWorker.ready).update());
  // A page that lies behind another one may have no frames to wait by.
  const waits = { polling: 50 };
  for (const each of [page, other]) await each.waitForFunction(() => !document.getElementById("newer").hidden, null, waits).catch(() => assert.fail(`no card; asked for ${host.asked}`));
  await page.waitForFunction(() => document.getElementById("spoken").textContent.includes("A newer Bindpose is here: reload the page to have it now."), null, waits);
  assert.deepEqual(host.asked.filter((name) => name.endsWith(".wasm")), [], "what both builds have is not fetched again");
  await other.click("#newer-close");
  assert.equal(await other.isHidden("#newer"), true);
  await keepCard(page);
  await page.click("#newer-take");
  await page.waitForFunction((one) => document.querySelector("meta[name=build]")?.content !== one, one);
  await shows(page);
  const two = await buildOf(page);
  const after = (await keptWhole(page, two))[`bindpose-${two}`];
  const names = await used(page);
  assert.ok(names.length > 10 && names.every((name) => after.includes(name)), `of build two alone: ${names}`);
  assert.ok(names.some((name) => !before.includes(name)));
  assert.equal(await page.isHidden("#newer"), true);

  // The older page goes on with its own files, which the host no longer has.
  const gone = before.find((name) => name.startsWith("web/sample/figure.") && !after.includes(name));
  host.asked.length = 0;
  const { model } = await other.evaluate(async () => JSON.parse(JSON.stringify(await bindpose.reset())));
  assert.equal(model.name, "figure.m3d");
  assert.ok((await used(other)).includes(gone) && !host.asked.includes(gone));
  assert.ok(`bindpose-${one}` in (await kept(page)));
  await other.close();
  await host.stop();
  await visit(page, host);
  for (const deadline = Date.now() + 30_000; Object.keys(await kept(page)).length > 1; await page.waitForTimeout(50)) {
    assert.ok(Date.now() < deadline, "the older build is kept on");
  }
  assert.equal(await buildOf(page), two);
});

test("a newer build that came during a visit is taken by the next one, whole", { draws: true }, async (page, host) => {
  await visit(page, host);
  const one = await buildOf(page);
  await keptWhole(page, one);
  host.build = "two";
  await page.evaluate(async () => (await navigator.serviceWorker.ready).update());
  await page.waitForFunction(() => !document.getElementById("newer").hidden, null, { polling: 50 });
  assert.equal(await buildOf(page), one);
  await page.goto("about:blank");
  await visit(page, host);
  const two = await buildOf(page);
  assert.notEqual(two, one);
  const names = await used(page);
  const whole = (await keptWhole(page, two))[`bindpose-${two}`];
  assert.ok(names.length > 10 && names.every((name) => whole.includes(name)), `of build two alone: ${names}`);
});

test("the page is asked of the network first, also where the host lets it be kept", {}, async (page, host) => {
  host.keeps = true;
  await visit(page, host);
  const one = await buildOf(page);
  await keptWhole(page, one);
  host.build = "two";
  await page.goto("about:blank");
  await visit(page, host);
  assert.notEqual(await buildOf(page), one);
});

/** Looks at the card in both themes, and on a narrow window. */
async function keepCard(page) {
  if (!process.env.KEEP) return;
  const size = page.viewportSize();
  for (const [width, height, where] of [[size.width, size.height, "wide"], [390, 844, "narrow"]]) {
    await page.setViewportSize({ width, height });
    for (const colorScheme of ["dark", "light"]) {
      await page.emulateMedia({ colorScheme });
      await page.waitForTimeout(2000);
      await keep(page, `newer-${where}-${colorScheme}`);
    }
  }
  await page.setViewportSize(size);
}

test("a build that does not arrive whole is left alone, and the one before it opens without a network", {}, async (page, host) => {
  await visit(page, host);
  const one = await buildOf(page);
  await keptWhole(page, one);
  host.build = "two";
  const devtools = await page.context().newCDPSession(page);
  const hinder = {
    "a file is missing": () => (host.lacks = "web/fault."),
    "there is no room": () => devtools.send("Storage.overrideQuotaForOrigin", { origin: new URL(host.address).origin, quotaSize: 1 }),
  };
  for (const [why, begin] of Object.entries(hinder)) {
    host.lacks = null;
    await begin();
    const outcome = await page.evaluate(async () => {
      const registration = await navigator.serviceWorker.ready;
      const found = new Promise((done) => registration.addEventListener("updatefound", () => done(registration.installing), { once: true }));
      registration.update();
      const worker = await found;
      return new Promise((done) => worker.addEventListener("statechange", () => done(worker.state)));
    });
    assert.equal(outcome, "redundant", why);
    assert.deepEqual(Object.keys(await kept(page)), [`bindpose-${one}`], why);
    assert.equal(await page.isHidden("#newer"), true, why);
  }
  await host.stop();
  await visit(page, host);
  assert.equal(await buildOf(page), one);
});

test("a file that the system opens with the page is a drop, and R reads it again", {
  draws: true,
  prepare: (page) =>
    page.addInitScript(() => {
      const launchQueue = { setConsumer: (consumer) => (globalThis.launch = consumer) };
      Object.defineProperty(globalThis, "launchQueue", { value: launchQueue });
    }),
}, async (page, host) => {
  await visit(page, host);
  const launch = (text, targetURL) =>
    page.evaluate(([text, targetURL]) => {
      const handle = { name: "theirs.m3d", getFile: async () => new File([globalThis.text], "theirs.m3d") };
      globalThis.text = text ?? globalThis.text;
      globalThis.launch({ files: text ? [handle] : [], targetURL });
    }, [text, targetURL]);
  await launch(readFileSync(OTHER, "utf8"), host.address);
  await shows(page, "theirs.m3d");
  const { counts } = (await state(page)).model;
  await page.evaluate(async (text) => (globalThis.text = text), readFileSync(SAMPLE, "utf8"));
  await page.mouse.click(520, 300);
  await page.keyboard.press("r");
  await until(page, ({ model }) => model?.name === "theirs.m3d" && model.counts.vertices !== counts.vertices);
  // The page's own icon leaves it as it is, a shortcut does not.
  await launch(null, host.address);
  assert.equal((await state(page)).model.name, "theirs.m3d");
  await launch(null, `${host.address}${QUERY}&crowd=2`);
  await page.waitForURL(/crowd=2$/, { waitUntil: "commit" });
});

test("the manifest is sound, what it names is there, and models and archives open with the page or are shared with it", {}, async (page, host) => {
  await page.goto(host.address);
  const devtools = await page.context().newCDPSession(page);
  const { url, data, errors } = await devtools.send("Page.getAppManifest");
  assert.deepEqual(errors, []);
  const { icons, screenshots, shortcuts, file_handlers: handlers, share_target: target } = JSON.parse(data);
  const opened = handlers.flatMap(({ accept }) => Object.values(accept).flat());
  const shared = target.params.files.flatMap(({ accept }) => accept).filter((kind) => kind.startsWith("."));
  const endings = [...KINDS.model, ...KINDS.archive].map((ending) => `.${ending}`).sort();
  assert.deepEqual([opened.sort(), shared.sort()], [endings, endings]);
  const pictures = [icons, screenshots, ...shortcuts.map((shortcut) => shortcut.icons)].flat();
  const addressOf = ({ src }) => new URL(src, url).href;
  const sizes = await page.evaluate(
    (addresses) =>
      Promise.all(addresses.map(async (src) => {
        const image = Object.assign(new Image(), { src });
        await image.decode();
        return `${image.naturalWidth}x${image.naturalHeight}`;
      })),
    pictures.map(addressOf),
  );
  for (const [index, { sizes: told }] of pictures.entries()) assert.ok([sizes[index], "any"].includes(told), `${told} is ${sizes[index]}`);
  // Of a maskable icon a system may cut away all but a circle of four fifths its width.
  const maskable = icons.filter(({ purpose }) => purpose?.includes("maskable"));
  assert.equal(maskable.length, 1);
  const [side, high, opaque, drawn, cut] = await page.evaluate(async (src) => {
    const image = Object.assign(new Image(), { src });
    await image.decode();
    const { width, height } = image;
    const copy = new OffscreenCanvas(width, height).getContext("2d");
    copy.drawImage(image, 0, 0);
    const pixels = new Uint32Array(copy.getImageData(0, 0, width, height).data.buffer);
    const differing = [...pixels.keys()].filter((at) => pixels[at] !== pixels[0]);
    const isCut = (at) => Math.hypot((at % width) + 0.5 - width / 2, Math.floor(at / width) + 0.5 - height / 2) > 0.4 * width;
    return [width, height, pixels.every((pixel) => pixel >>> 24 === 255), differing.length, differing.filter(isCut).length];
  }, addressOf(maskable[0]));
  assert.deepEqual([high, opaque, cut], [side, true, 0], "square, opaque, and nothing drawn outside the circle");
  assert.ok(drawn > 0.02 * side * side, "and something in it");
});

test("installed, it opens in a window of its own, and with the files that the system knows it for", {
  only: "webgl2",
  skip: process.platform !== "linux" && "elsewhere a system takes it for one of the person's programs",
}, async (_, host) => {
  const home = await mkdtemp(join(tmpdir(), "bindpose-"));
  const context = await launchAtHome(home);
  try {
    const [page] = context.pages();
    await page.goto(host.address);
    const { appId: manifestId } = await (await context.newCDPSession(page)).send("Page.getAppId");
    const devtools = await context.browser().newBrowserCDPSession();
    await devtools.send("PWA.install", { manifestId, installUrlOrBundleUrl: host.address });
    await devtools.send("PWA.changeAppUserSettings", { manifestId, displayMode: "standalone" });
    const { fileHandlers } = await devtools.send("PWA.getOsAppState", { manifestId });
    const endings = fileHandlers.flatMap(({ accepts }) => accepts).flatMap(({ fileExtensions }) => fileExtensions);
    assert.deepEqual(endings.sort(), [...KINDS.model, ...KINDS.archive].map((ending) => `.${ending}`).sort());
    const opens = context.waitForEvent("page");
    await page.goto("about:blank");
    await devtools.send("PWA.launch", { manifestId });
    const app = await opens;
    await shows(app);
    assert.equal(await app.evaluate(() => matchMedia("(display-mode: standalone)").matches), true);
    await devtools.send("PWA.launchFilesInApp", { manifestId, files: [OTHER] });
    await shows(app, "d3d12_skinned.m3d");
  } finally {
    await context.close();
    await rm(home, { recursive: true, force: true });
  }
});

test("what another program shares goes through the worker, opens as a drop and is kept no longer", {
  draws: true,
  // Its address says nothing else.
  prepare: (page) => page.addInitScript(() => localStorage.setItem("bindpose.kept", JSON.stringify({ greeted: true, quality: "low" }))),
}, async (page, host) => {
  await visit(page, host);
  await keptWhole(page, await buildOf(page));
  // A page of the host that forbids no forms stands in for the system.
  await page.goto(`${host.address}nothing`);
  await page.evaluate((text) => {
    const form = Object.assign(document.createElement("form"), { method: "post", enctype: "multipart/form-data", action: "share" });
    const input = Object.assign(document.createElement("input"), { type: "file", name: "files" });
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], "shared.m3d", { type: "text/plain" }));
    input.files = transfer.files;
    form.append(input);
    document.body.append(form);
    form.submit();
  }, readFileSync(OTHER, "utf8"));
  await until(page, ({ model }) => model?.name === "shared.m3d");
  assert.equal(page.url(), host.address, "a reload does not ask for it again");
  assert.ok(!host.asked.includes("share"), "the host never sees it");
  assert.deepEqual((await kept(page)).shared, []);
  await page.goto(`${host.address}?shared=gone`);
  await page.waitForSelector("#notice:not([hidden])");
  assert.match(await page.textContent("#notice-words"), /What was shared with Bindpose did not arrive/);
});
