// A real Chromium on one backend, and what the tests do with its pages.

import assert from "node:assert/strict";
import { appendFileSync, existsSync, mkdirSync, readdirSync, rmSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { after, test as nodeTest } from "node:test";
import { chromium } from "playwright-core";
import { GPU_FLAGS, QUIET_FLAGS } from "./flags.js";

/** Given by `cargo xtask test` and `bench`: where the page is, what draws it and Chromium's program. */
export const PAGE = required("PAGE");
export const BACKEND = required("BACKEND");
const PROGRAM = process.env.PROGRAM ?? "/usr/bin/chromium";
/** `all` tests; or those that draw and of the others a half: those whose names have an `odd` or an `even` number of letters. */
const TESTS = process.env.TESTS ?? "all";

/** Whether a test is one of those that are wanted. `only`: the one backend that it is for. */
function isWanted(name, { draws = false, only }) {
  if (only) return only === BACKEND;
  return TESTS === "all" || draws || TESTS === (name.length % 2 ? "odd" : "even");
}

const path = (relative) => fileURLToPath(new URL(relative, import.meta.url));

/** The sample that the page opens by itself. */
export const SAMPLE = path("../../web/sample/figure.m3d");
/** Small files of this project, and among them those that cannot be read, each with its message beside it. */
export const FIXTURES = path("../fixtures/");
/** Real files beside the checkout; not every machine has them. */
export const SHARED = path("../../../shared/");
/** Pictures for people to look at. */
export const OUT = path("out/");

assert.ok(BACKEND in GPU_FLAGS, `BACKEND is webgpu or webgl2, not ${BACKEND}`);

/** Where the two programs are on the server, and the one of them that draws with the backend under test where that is asked for by name. */
export const FOLDERS = { webgpu: "/pkg/webgpu/", full: "/pkg/" };
export const FOLDER = BACKEND === "webgpu" ? FOLDERS.webgpu : FOLDERS.full;

/** Small, for the sake of the software GPU, but wide enough for every panel. */
export const VIEWPORT = { width: 960, height: 600 };
/** For pictures that people look at. */
export const LARGE = { width: 1280, height: 800 };
/** A place in the view that no panel covers. */
export const CENTRE = [520, 260];

/** Long enough for a debug build on a software GPU that shares two cores. */
const PATIENCE_MS = 120_000;

// The pictures of the last run would be taken for those of this one.
for (const picture of filesIn(OUT, ".png")) {
  if (picture.startsWith(`${OUT}${BACKEND}-`)) rmSync(picture);
}
mkdirSync(OUT, { recursive: true });
/** Every pass that can be left out: a GPU of software draws several times as many frames without them. */
const PASSES = ["shadow", "reflections", "contact", "ao"];
/** And still more where the view has a sixth of its pixels. */
export const COARSE = 0.4;

/**
 * What a person sits at. The screen's scale is set when the browser starts: emulating it on a page leaves the size of a canvas as it was. A
 * page with a window of its own is told the same scale, since it is told 1 otherwise.
 * Most tests have a coarse screen: everything stands where it would, and the panels too have a sixteenth of their pixels.
 */
const DEVICES = {
  desk: { scale: 1, context: { viewport: VIEWPORT } },
  coarseDesk: { scale: 0.25, context: { viewport: VIEWPORT, deviceScaleFactor: 0.25 } },
  coarsePhone: { scale: 0.25, context: { viewport: null, hasTouch: true } },
  sharpPhone: { scale: 2, context: { viewport: null, hasTouch: true } },
};
const browsers = new Map();
const opened = new Map();
after(() => Promise.all(Array.from(browsers.values(), (browser) => browser.close())));

const options = (...own) => {
  const rights = process.getuid?.() === 0 ? ["--no-sandbox"] : [];
  return { executablePath: PROGRAM, args: [...GPU_FLAGS[BACKEND], ...QUIET_FLAGS, ...rights, ...own] };
};

/** Starts a browser of a scale. */
export const launch = (scale) => chromium.launch(options(`--force-device-scale-factor=${scale}`, "--renderer-process-limit=1"));

/** Starts one that keeps all in a folder that a person would have in theirs, also what it installs. Gives its context. */
export const launchAtHome = (home) =>
  chromium.launchPersistentContext(`${home}/profile`, { ...options(), viewport: null, env: { ...process.env, HOME: home, XDG_DATA_HOME: `${home}/data` } });

/** The browser of a scale. */
async function browserAt(scale) {
  if (!browsers.has(scale)) browsers.set(scale, await launch(scale));
  return browsers.get(scale);
}

/** What a device has: one context, so that its pages share the compiled program, and the page that its tests share. */
async function contextOf(device) {
  if (!opened.has(device)) {
    const browser = await browserAt(DEVICES[device].scale);
    opened.set(device, { context: await browser.newContext(DEVICES[device].context), shared: null });
  }
  return opened.get(device);
}

const isPhone = (device) => DEVICES[device].context.hasTouch === true;

/** What sets the size of a phone's page. */
const screens = new WeakMap();
/** The errors that a page has logged. */
const problemsOf = new WeakMap();

/** A page that nothing was loaded into. Unless it is for a `firstVisit`, nobody is greeted on it. */
async function freshPage(device, firstVisit = false) {
  const { context } = await contextOf(device);
  const page = await context.newPage();
  if (!firstVisit) {
    await page.addInitScript(() => {
      try {
        localStorage.getItem("bindpose.kept") ?? localStorage.setItem("bindpose.kept", JSON.stringify({ greeted: true }));
      } catch {
        // Frames of other kinds keep nothing.
      }
    });
  }
  page.setDefaultTimeout(PATIENCE_MS);
  const problems = [];
  problemsOf.set(page, problems);
  page.on("console", (message) => message.type() === "error" && problems.push(message.text()));
  page.on("pageerror", (error) => problems.push(error.message));
  if (isPhone(device)) screens.set(page, await context.newCDPSession(page));
  return page;
}

/** Gives the screen of a phone another shape. */
export async function turnPhone(page, width, height) {
  await screens.get(page).send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 0, mobile: false });
}

/** Gives a page its window and what the person prefers. */
async function furnish(page, device, { viewport = VIEWPORT, colorScheme = "dark", motion = false }) {
  await page.emulateMedia({ colorScheme, reducedMotion: motion ? "no-preference" : "reduce" });
  if (isPhone(device)) await turnPhone(page, 390, 844);
  else await page.setViewportSize(viewport);
}

/** The page that tests of a device have one after the other, as a visit of it begins. */
async function sharedPage(device, options) {
  const own = await contextOf(device);
  if (own.shared) {
    const page = own.shared;
    problemsOf.get(page).length = 0;
    await furnish(page, device, options);
    await page.mouse.move(0, 0);
    await page.evaluate(async () => {
      document.activeElement?.blur();
      localStorage.clear();
      await bindpose.reset();
    });
    return page;
  }
  const page = await freshPage(device);
  await furnish(page, device, options);
  await page.goto(`${PAGE}?backend=${BACKEND}&quality=full&scale=${COARSE}`, { timeout: PATIENCE_MS });
  await running(page);
  own.shared = page;
  return page;
}

/**
 * A test in the page. `draws`: it looks at pixels or at what the GPU does, and is run on both backends; the checks run another on one of
 * them. `only`: the one backend that it is for. `viewport` and `colorScheme` are the person's; `phone` gives a small screen under fingers, `sharp` that with two
 * pixels to the point. A test is quicker without what it does not look at: `motion` lets the sample play and the camera coast, which
 * a person who prefers reduced motion does not have; `passes` draws all that a saved picture can have; `fine` draws every pixel of the
 * view and the panels. Tests share a page, which begins anew for each. A test has a page of its own with `own`, for one that leaves
 * traces in the page, or when it says how the page is loaded: `query` is added to the address, `prepare` may change the page before,
 * `bare` does not wait for the viewer; `firstVisit`, with one of these, is greeted. A test fails when the page logs an error, unless
 * `expectErrors` says that it may, and once it has failed twice; each second try is counted, and the checks let few through.
 */
export function test(name, options, body) {
  if (!isWanted(name, options)) return;
  const { query, prepare, expectErrors = false, skip, bare = false, phone = false, sharp = false, passes = false, fine = false, own = false, firstVisit = false, ...person } = options;
  const device = sharp ? "sharpPhone" : phone ? "coarsePhone" : fine ? "desk" : "coarseDesk";
  const alone = own || bare || query !== undefined || prepare !== undefined;
  const attempt = async () => {
    let page;
    try {
      if (alone) {
        page = await freshPage(device, firstVisit);
        await furnish(page, device, person);
        await prepare?.(page);
        const scale = fine ? 1 : COARSE;
        await page.goto(PAGE + (query ?? `?backend=${BACKEND}&quality=full&scale=${scale}`), { timeout: PATIENCE_MS });
        if (!bare) await running(page);
      } else {
        page = await sharedPage(device, person);
      }
      if (!bare) {
        const left = passes ? [] : PASSES;
        const scale = fine ? 1 : COARSE;
        await page.evaluate(([left, scale]) => {
          left.forEach((pass) => bindpose.setPass(pass, false));
          bindpose.setRenderScale(scale);
        }, [left, scale]);
        // A press on a panel that was not drawn yet would go to what is behind it.
        await settled(page);
      }
      await body(page);
      const problems = problemsOf.get(page);
      if (!expectErrors) assert.deepEqual(problems, [], "the page logged errors");
      else problems.length = 0;
      // A page that goes on playing behind the next one would take its time.
      if (!alone) return await call(page, "pause");
    } catch (error) {
      await page?.screenshot({ path: `${OUT}${BACKEND}-FAILED-${name.replace(/\W+/g, "-")}.png` }).catch(() => {});
      const problems = page ? problemsOf.get(page) : [];
      if (problems.length) error.message += `\nThe page logged: ${problems.join("\n")}`;
      // Nobody gets a page on which something went wrong.
      if (!alone && page) {
        (await contextOf(device)).shared = null;
        await page.close().catch(() => {});
      }
      throw error;
    } finally {
      if (alone && page) {
        await page.evaluate(() => localStorage.clear()).catch(() => {});
        await page.close();
      }
    }
  };
  // Real input meets a page that a software GPU draws a few times a second: a press can come before what it is meant for.
  nodeTest(`${BACKEND}: ${name}`, { skip, timeout: 5 * PATIENCE_MS }, () =>
    attempt().catch((error) => {
      const why = error.message.replace(/\s+/g, " ").slice(0, 300);
      console.error(`${BACKEND}: ${name} is tried again after: ${error.stack}`);
      if (process.env.BINDPOSE_SECOND_TRIES) appendFileSync(process.env.BINDPOSE_SECOND_TRIES, `${BACKEND}: ${name}: ${why}\n`);
      return attempt();
    }),
  );
}

/** The scripts of the programs, for a route. */
export const SCRIPTS = "**/bindpose.js";

/**
 * For `prepare`: the page gets the real program, but for members of its class `Viewer` that are written anew. In them `super` is the real
 * viewer and `this.onEvent` the page's callback.
 */
export const withViewer = (members) => (page) =>
  page.route(SCRIPTS, async (route) => {
    const script = await (await route.fetch()).text();
    assert.match(script, /^export class Viewer /m);
    const body = `${script.replace(/^export class Viewer /m, "class Viewer ")}
      class OtherViewer extends Viewer {
        constructor(options, onEvent) {
          super(options, onEvent);
          this.onEvent = onEvent;
        }
        ${members}
      }
      export { OtherViewer as Viewer };`;
    // Without the file's own tag: with it the browser would keep this script for the real one.
    await route.fulfill({ contentType: "text/javascript", body });
  });

/** For `prepare`: the program ends in a panic as soon as it has started. */
export const panicAtStart = withViewer(`
  async start(...values) {
    const gpu = await super.start(...values);
    reportError(Object.assign(new Error("index out of bounds"), { name: "Panic" }));
    return gpu;
  }`);

/** The folders of the programs that a page has fetched, in order. */
export async function programs(page) {
  const paths = await page.evaluate(() => performance.getEntriesByType("resource").map(({ name }) => new URL(name).pathname));
  return paths.filter((path) => path.endsWith(".wasm")).map((path) => path.replace(/[^/]*$/, ""));
}

/** Waits until the viewer runs, shows a model and has drawn its panels, and makes sure that it is the program and the backend under test. */
export async function running(page) {
  await page.waitForFunction(() => !document.getElementById("fault").hidden || globalThis.bindpose?.state().model);
  assert.equal(await page.textContent("#fault-title"), "", await page.textContent("#fault-details"));
  assert.equal((await state(page)).backend, BACKEND, "the backend that is really in use");
  assert.deepEqual(await programs(page), [FOLDER], "the program that was fetched");
  await page.waitForFunction(() => document.getElementById("shell").hidden);
}

/** What `bindpose.state()` says, as plain data. */
export function state(page) {
  return page.evaluate(() => JSON.parse(JSON.stringify(globalThis.bindpose.state())));
}

/** Loads the page anew, as another visit that follows no link. */
export async function visitAgain(page) {
  await page.evaluate(() => history.replaceState(null, "", location.href.split("#")[0]));
  await page.reload();
  await running(page);
}

/** Keeps all that a screen reader is given from the beginning, in `heard`. */
export const listen = (page) => page.addInitScript(() => {
  globalThis.heard = [];
  const note = () => globalThis.heard.push(document.getElementById("spoken")?.textContent);
  new MutationObserver(note).observe(document, { subtree: true, childList: true, characterData: true });
});

/** Calls a method of `globalThis.bindpose`. */
export function call(page, name, ...values) {
  return page.evaluate(([name, values]) => void globalThis.bindpose[name](...values), [name, values]);
}

/** Waits until `predicate(state)` holds. It runs here: the page forbids code out of strings. Gives that state. */
export async function until(page, predicate) {
  const deadline = Date.now() + PATIENCE_MS;
  for (;;) {
    // Between two pages, after a reload, there is nothing to ask.
    const now = await state(page).catch(() => null);
    if (now && predicate(now)) return now;
    if (Date.now() > deadline) throw new Error(`waited in vain for ${predicate}: ${JSON.stringify(now)}`);
    await new Promise((done) => setTimeout(done, 30));
  }
}

/** Shift among the modifiers of the DevTools protocol. */
const SHIFT = 8;

/**
 * Drops files and folders of this machine on the page, the way a person does: enter, over, drop, with real paths, in the middle of
 * the view or `at` another place. `shift`: with Shift held.
 */
export async function drop(page, paths, { look, shift = false, at: [x, y] = CENTRE } = {}) {
  const devtools = await page.context().newCDPSession(page);
  const data = { items: [], files: paths, dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "dragOver", "drop"]) {
    if (type === "drop") await look?.();
    await devtools.send("Input.dispatchDragEvent", { type, x, y, data, modifiers: shift ? SHIFT : 0 });
  }
  await devtools.detach();
}

/** Drops and waits for the `load` or `error` that follows; gives its type and the state after it. */
export async function dropAndWait(page, paths, options) {
  await page.evaluate(() => {
    globalThis.outcome = null;
    for (const type of ["load", "error"]) bindpose.addEventListener(type, () => (globalThis.outcome ??= type), { once: true });
  });
  await drop(page, paths, options);
  const outcome = await page.waitForFunction(() => globalThis.outcome, null, { polling: 30 });
  return { outcome: await outcome.jsonValue(), ...(await state(page)) };
}

/** Keeps a screenshot for people to look at, when `KEEP` asks for them. */
export async function keep(page, name) {
  if (process.env.KEEP) await page.screenshot({ path: `${OUT}${BACKEND}-${name}.png` });
}

/** Drags with the mouse from one place to another and lets go. */
export async function drag(page, [fromX, fromY], [toX, toY], { button = "left" } = {}) {
  await page.mouse.move(fromX, fromY);
  await page.mouse.down({ button });
  await page.mouse.move(toX, toY, { steps: 5 });
  await page.mouse.up({ button });
}

/** Waits for the next frames to be on screen: the first of them has dealt with all input until now. */
export function settled(page) {
  return page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** The page's elements are told where the controls are at most this long after these moved (src/web/page/mirror.rs waits for 250 ms). */
const TOLD_MS = 300;

/**
 * Waits until the camera has come to rest after a drag and nothing more is drawn: what idle moments make finer is there too, and the page's
 * elements know where the controls are. The clip must be paused.
 */
export async function atRest(page) {
  for (let before; ; ) {
    await settled(page);
    await page.waitForTimeout(TOLD_MS);
    const now = await state(page);
    if (now.framesRendered === before && now.look.refined) return now;
    before = now.framesRendered;
  }
}

/** The files directly in a folder whose names end as said; none when there is no such folder. */
export function filesIn(folder, ending) {
  if (!existsSync(folder)) return [];
  return readdirSync(folder).filter((name) => name.endsWith(ending)).sort().map((name) => folder + name);
}

/** For `skip`: false when the file of `../shared` is there, else the words that say what was not looked at, which the end of the checks repeats. */
export function unless(file) {
  if (existsSync(file)) return false;
  if (process.env.BINDPOSE_ABSENT) appendFileSync(process.env.BINDPOSE_ABSENT, `${file.slice(SHARED.length)}\n`);
  return `skipped: ${file} is not on this machine`;
}

function required(name) {
  const value = process.env[name];
  assert.ok(value, `${name} is not set; cargo xtask test --browser sets it`);
  return value;
}
