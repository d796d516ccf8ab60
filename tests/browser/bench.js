// The page in numbers: `cargo xtask bench --browser`. In Chromium, on a GPU of software, on both backends: how long the program reads beside
// three.js, the longest tasks while it opens large files, how far its memory grows, and what a frame takes. Each figure has what it is
// of beside it, and the aim where there is one. `node bench.js [MODEL]` starts itself for each backend and prints one table.

import { fork } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { fileURLToPath } from "node:url";
import { paint, writeModel, writeSheet } from "./bench_files.js";

const ROUNDS = 3;
const MEGABYTE = 1e6;
/** Tasks that are longer than this hold up input; browsers tell of no shorter ones. */
const LONG_TASK_MS = 50;
/** The window and the model's maps: what is not of a file that opens. */
const SPARE_BYTES = 16 * 2 ** 20;

/** A page with nothing on it. */
const BLANK = "blank.html";

const median = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];
const sum = (numbers) => numbers.reduce((all, number) => all + number, 0);
const ms = (number) => `${number.toFixed(number < 10 ? 2 : 0)} ms`;
const mb = (bytes) => `${Math.round(bytes / MEGABYTE)} MB`;
/** Three rounds and their median. */
async function rounds(work, count = ROUNDS) {
  const all = [];
  for (let round = 0; round < count; round += 1) all.push(await work(round));
  return all;
}

// ---- In the page.

/** Before the page's own scripts: notes tasks, calls of the GPU, frames and timers, and what the program's memory is. */
function watch() {
  const watched = { tasks: [], calls: [], frames: [], gpuMs: 0, timers: 0, memory: null };
  globalThis.watched = watched;
  new PerformanceObserver((list) => watched.tasks.push(...list.getEntries().map(({ startTime, duration }) => [startTime, duration])))
    .observe({ type: "longtask", buffered: true });
  // A GPU of software draws inside such calls, or the call waits until it has: that is no work of the program.
  for (const kind of ["WebGL2RenderingContext", "GPUDevice", "GPUQueue", "GPUCommandEncoder", "GPURenderPassEncoder", "GPUBuffer", "GPUTexture", "GPUCanvasContext"]) {
    const prototype = globalThis[kind]?.prototype;
    for (const [name, { value }] of Object.entries(prototype ? Object.getOwnPropertyDescriptors(prototype) : {})) {
      if (typeof value !== "function" || name === "constructor") continue;
      prototype[name] = function (...values) {
        const start = performance.now();
        try {
          return value.apply(this, values);
        } finally {
          const took = performance.now() - start;
          watched.gpuMs += took;
          if (took > 0.5) watched.calls.push([start, took]);
        }
      };
    }
  }
  const next = requestAnimationFrame;
  globalThis.requestAnimationFrame = (frame) =>
    next((time) => {
      const [start, gpuMs] = [performance.now(), watched.gpuMs];
      frame(time);
      watched.frames.push([performance.now() - start, watched.gpuMs - gpuMs]);
    });
  for (const name of ["setTimeout", "setInterval"]) {
    const real = globalThis[name];
    globalThis[name] = (...values) => {
      watched.timers += 1;
      return real(...values);
    };
  }
  for (const name of ["instantiate", "instantiateStreaming"]) {
    const real = WebAssembly[name];
    WebAssembly[name] = async (...values) => {
      const made = await real.apply(WebAssembly, values);
      watched.memory = (made.instance ?? made).exports.memory ?? watched.memory;
      return made;
    };
  }
}

/** The longest task between a moment and the last picture of an opening, and the longest without what the GPU's calls took of it; 50 ms where all were shorter. */
const longest = (page, since) =>
  page.evaluate(([since, least]) => {
    const until = performance.getEntriesByName("bindpose:drawn").at(-1).startTime;
    const { tasks, calls } = globalThis.watched;
    const ours = ([start, took]) => took - calls.filter(([at]) => at >= start && at < start + took).reduce((all, [, call]) => all + call, 0);
    const now = tasks.filter(([start]) => start >= since && start < until);
    return { all: Math.max(least, ...now.map(([, took]) => took)), ours: Math.max(least, ...now.map(ours)) };
  }, [since, LONG_TASK_MS]);

const memoryOf = (page) => page.evaluate(() => globalThis.watched.memory.buffer.byteLength);

/** Opens files on the page as a person does. Gives the state once they are drawn, or the error. */
async function open(page, paths) {
  await page.evaluate(() => {
    globalThis.opened = new Promise((done) => {
      for (const type of ["load", "error"]) bindpose.addEventListener(type, () => done(type), { once: true });
    });
  });
  await page.setInputFiles("#files", paths);
  await page.evaluate(() => globalThis.opened);
  return page.evaluate(async () => {
    // The first picture is of the opening. What tells of it comes after: asking for all of the state takes a while, too.
    await new Promise((done) => setTimeout(done, 1000));
    for (let still = 0, before = -1; still < 3; ) {
      await new Promise((done) => setTimeout(done, 100));
      const { framesRendered, opening } = bindpose.state();
      still = framesRendered === before && !opening ? still + 1 : 0;
      before = framesRendered;
    }
    const { model, error, timings, textures } = bindpose.state();
    return { model, error, timings, textures };
  });
}

/** A program without a canvas, which nothing is drawn by. `addresses` are those of its script and its wasm. */
async function makeViewer(page, addresses) {
  await page.evaluate(async ([script, wasm]) => {
    const { default: init, Viewer } = await import(script);
    await init({ module_or_path: fetch(wasm) });
    globalThis.viewer = new Viewer({}, () => {});
    const input = Object.assign(document.createElement("input"), { type: "file", id: "bench" });
    document.body.append(input);
  }, addresses);
}

/** Opens the file of the page's input without a canvas, in slices, or in one with a clock that stands still. Milliseconds of each stage. */
const openAlone = (page, sliced = true) =>
  page.evaluate(async (sliced) => {
    const [file] = document.getElementById("bench").files;
    const bytes = new Uint8Array(await file.arrayBuffer());
    // What is opened a second time is not read anew.
    await globalThis.viewer.startOver([]);
    performance.clearMarks();
    if (!sliced) performance.now = () => 0;
    const start = Performance.prototype.now.call(performance);
    const { model, error } = await globalThis.viewer.open([{ name: file.name, bytes }]);
    const wholeMs = Performance.prototype.now.call(performance) - start;
    delete performance.now;
    if (!model || error) throw new Error(`${file.name} did not open: ${error?.message}`);
    const marks = performance.getEntriesByType("mark").filter(({ name }) => name.startsWith("bindpose:"));
    const stages = {};
    marks.forEach(({ name, startTime }, index) => {
      const end = marks[index + 1]?.startTime;
      if (end) stages[name.slice("bindpose:".length)] = end - startTime;
    });
    return { counts: model.counts, keys: model.clips.reduce((all, { keys }) => all + keys, 0), stages, wholeMs };
  }, sliced);

/** Reads the .glb of these bytes with three.js, or the FBX file of the page's input, which the page has from `/three/`. */
const readWithThree = (page, isFbx = false) =>
  page.evaluate(async (isFbx) => {
    const name = isFbx ? "FBXLoader" : "GLTFLoader";
    const loader = new (await import(`/three/examples/jsm/loaders/${name}.js`))[name]();
    const bytes = isFbx ? await document.getElementById("bench").files[0].arrayBuffer() : globalThis.glb.slice(0);
    const start = performance.now();
    const read = isFbx ? loader.parse(bytes, "") : await loader.parseAsync(bytes, "");
    const { scene = read, animations } = read;
    const took = performance.now() - start;
    const seen = { vertices: new Set(), triangles: 0 };
    scene.traverse((object) => {
      if (!object.isMesh) return;
      seen.vertices.add(object.geometry.attributes.position);
      seen.triangles += (object.geometry.index ?? object.geometry.attributes.position).count / 3;
    });
    const vertices = [...seen.vertices].reduce((all, { count }) => all + count, 0);
    const keys = animations.reduce((all, { tracks }) => all + tracks.reduce((sum, { times }) => sum + times.length, 0), 0);
    return { took, vertices, triangles: seen.triangles, keys };
  }, isFbx);

// ---- One backend.

async function measure(model) {
  const { BACKEND, PAGE, VIEWPORT, launch, running, settled } = await import("./harness.js");
  const { withoutPictures } = await import("./gltf_files.js");
  const { held } = await import("./held.js");
  const folder = mkdtempSync(join(tmpdir(), "bindpose-bench-"));
  const rows = [];
  const row = (what, figure, aim, reached, check) => {
    rows.push({ what, figure, aim, reached, check });
    console.error(`  ${BACKEND}: ${what}: ${figure} ${check}`);
  };
  const library = fileURLToPath(new URL("node_modules/three/", import.meta.url));

  /** A page in a browser of its own, in which nothing is compiled yet. */
  async function visit(address, work) {
    const browser = await launch(0.5);
    try {
      const context = await browser.newContext({ viewport: VIEWPORT, deviceScaleFactor: 0.5, reducedMotion: "reduce" });
      await context.addInitScript(watch);
      await context.addInitScript(() => localStorage.setItem("bindpose.kept", JSON.stringify({ greeted: true })));
      // Alone with its own files a page has a clock of 5 µs, else one of 100.
      const isolated = { "cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp" };
      await context.route(new URL(address, PAGE).href, async (route) => {
        if (address === BLANK) return route.fulfill({ contentType: "text/html", headers: isolated, body: "<!doctype html><title>Bench</title>" });
        const response = await route.fetch();
        return route.fulfill({ response, headers: { ...response.headers(), ...isolated } });
      });
      await context.route("**/three/**", (route) => {
        const path = join(library, new URL(route.request().url()).pathname.slice("/three/".length));
        const body = readFileSync(path, "utf8").replaceAll(/from 'three'/g, "from '/three/build/three.module.js'");
        return route.fulfill({ contentType: "text/javascript", body });
      });
      const page = await context.newPage();
      page.setDefaultTimeout(600_000);
      await page.goto(new URL(address, PAGE).href);
      return await work(page);
    } finally {
      await browser.close();
    }
  }
  const onPage = (work, query = "&quality=full&scale=0.2") =>
    visit(`?backend=${BACKEND}${query}`, async (page) => {
      await running(page);
      await page.evaluate(() => bindpose.pause());
      await settled(page);
      return work(page);
    });
  const alone = (addresses, work) =>
    visit(BLANK, async (page) => {
      await makeViewer(page, addresses);
      return work(page);
    });

  const addresses = await onPage((page) =>
    page.evaluate(() => {
      const loaded = performance.getEntriesByType("resource").map(({ name }) => name);
      return [loaded.find((name) => /\/pkg\/.*\.js$/.test(name)), loaded.find((name) => name.endsWith(".wasm"))];
    }),
  );

  // What does not draw is the same program on every backend.
  if (BACKEND === "webgpu") {
    const bare = await alone(addresses, async (page) => {
      await page.setInputFiles("#bench", model);
      await openAlone(page);
      const text = await page.evaluate(async () => {
        const { bytes } = await globalThis.viewer.exportModel({ format: "glb" });
        return Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
      });
      return withoutPictures(Buffer.from(text, "latin1"));
    });
    writeFileSync(join(folder, "bare.glb"), bare);
    const together = (work) =>
      alone(addresses, async (page) => {
        await page.setInputFiles("#bench", join(folder, "bare.glb"));
        await page.evaluate(async () => (globalThis.glb = await document.getElementById("bench").files[0].arrayBuffer()));
        await page.setInputFiles("#bench", model);
        return work(page);
      });
    const readings = async (page, round) => {
      const [ours, theirs] = [() => openAlone(page), () => readWithThree(page)];
      if (round % 2) {
        const three = await theirs();
        return { ours: await ours(), three };
      }
      return { ours: await ours(), three: await theirs() };
    };
    const cold = await rounds((round) => together((page) => readings(page, round)), 9);
    const warm = await together(async (page) => {
      await rounds((round) => readings(page, round), 20);
      return rounds((round) => readings(page, round), 31);
    });
    const name = basename(model);
    for (const [when, all, aim] of [["first", cold, 0.6], ["warm", warm, 1]]) {
      const ratios = (of) => median(all.map(({ ours, three }) => of(ours) / three.took));
      const [{ ours, three }] = all;
      const check = `${ours.counts.vertices} and ${three.vertices} vertices, ${ours.counts.triangles} and ${three.triangles} triangles, ${ours.keys} keys and ${three.keys} of channels`;
      const reading = ({ stages }) => stages.reading;
      const built = ({ stages }) => stages.reading + stages.building;
      const told = (of) => `${ratios(of).toFixed(2)} (${ms(median(all.map(({ ours }) => of(ours))))} / ${ms(median(all.map(({ three }) => three.took)))})`;
      row(`${name}, ${when}: reading the text / three.js reading it as .glb`, told(reading), `≤ ${aim}`, ratios(reading) <= aim, check);
      row(`${name}, ${when}: reading and building / the same`, told(built), "", null, check);
      row(`${name}, ${when}: all of opening`, ms(median(all.map(({ ours }) => ours.wholeMs))), "", null, "");
    }
  }

  if (BACKEND === "webgpu") {
    const sheet = writeSheet(join(folder, "sheet.fbx"));
    const all = await alone(addresses, async (page) => {
      await page.setInputFiles("#bench", sheet);
      return rounds(async () => ({ ours: await openAlone(page), three: await readWithThree(page, true) }), 9);
    });
    const built = ({ stages }) => stages.reading + stages.building;
    const ratio = median(all.map(({ ours, three }) => built(ours) / three.took));
    const [{ ours, three }] = all;
    const told = `${ratio.toFixed(2)} (${ms(median(all.map(({ ours }) => built(ours))))} / ${ms(median(all.map(({ three }) => three.took)))})`;
    row("an FBX file of 20 MB: reading and building / FBXLoader", told, "≤ 0.7", ratio <= 0.7, `${ours.counts.triangles} and ${three.triangles} triangles`);
  }

  // Large files, each on a page of its own, so that its memory is what this file took.
  const file = (name, shape) => writeModel(join(folder, name), shape);
  const pictures = async (type, ending) => {
    const painted = await visit(BLANK, async (page) => {
      const all = [];
      for (let seed = 1; seed <= 12; seed += 1) all.push(await paint(page, type, seed));
      return all;
    });
    return painted.map((bytes, index) => {
      const path = join(folder, `m${index >> 1}_${index % 2 ? "norm" : "diff"}.${ending}`);
      writeFileSync(path, bytes);
      return path;
    });
  };
  const large = [
    ["a text of 200 MB", [file("large.m3d", { vertices: 1_130_000, bones: 58, keys: 76 })], true],
    ["twelve PNGs of 2048²", [file("maps.m3d", { materials: 6 }), ...(await pictures("image/png", "png"))], false],
    ["twelve JPEGs of 2048²", [join(folder, "maps.m3d"), ...(await pictures("image/jpeg", "jpg"))], false],
    ["a clip of a million keys", [file("keys.m3d", { bones: 100, keys: 10_000 })], true],
    ["a bone of a million keys", [file("bone.m3d", { bones: 1, keys: 1_000_000 })], false],
    ["100 000 bones", [file("bones.m3d", { bones: 100_000 })], false],
  ];
  for (const [name, paths, isCompared] of large) {
    const text = sum(paths.map((path) => statSync(path).size));
    const all = await rounds(() =>
      onPage(async (page) => {
        const own = await memoryOf(page);
        const since = await page.evaluate(() => performance.now());
        const opened = await open(page, paths);
        return { opened, grown: (await memoryOf(page)) - own, ...(await longest(page, since)) };
      }),
    );
    const [{ opened }] = all;
    if (opened.error) throw new Error(`${name}: ${opened.error.message}`);
    const { vertices, triangles, bones } = opened.model.counts;
    const keys = sum(opened.model.clips.map(({ keys }) => keys));
    const check = `${mb(text)}, ${vertices} vertices, ${triangles} triangles, ${bones} bones, ${keys} keys`;
    const [ours, whole] = [median(all.map(({ ours }) => ours)), median(all.map(({ all }) => all))];
    const atMost = (number) => (number > LONG_TASK_MS ? ms(number) : `≤ ${LONG_TASK_MS} ms`);
    row(`${name}: longest task of ours, with the GPU's calls`, `${atMost(ours)}, ${atMost(whole)}`, `≤ ${LONG_TASK_MS} ms`, ours <= LONG_TASK_MS, check);
    const [grown, most] = [median(all.map(({ grown }) => grown)), 2 * text + SPARE_BYTES];
    row(`${name}: memory grows by`, `${mb(grown)} (${(grown / text).toFixed(2)} × the files)`, `≤ ${mb(most)}`, grown <= most, check);
    if (isCompared && BACKEND === "webgpu") {
      const both = await alone(addresses, async (page) => {
        await page.setInputFiles("#bench", paths[0]);
        await openAlone(page);
        return rounds(async () => [(await openAlone(page)).wholeMs, (await openAlone(page, false)).wholeMs]);
      });
      const ratio = median(both.map(([sliced, whole]) => sliced / whole));
      row(`${name}: in slices / in one`, `${ratio.toFixed(2)} (${both.map(([sliced, whole]) => `${ms(sliced)} / ${ms(whole)}`).join(", ")})`, "≤ 1.3", ratio <= 1.3, check);
    }
  }

  await onPage(async (page) => {
    const { SAMPLE } = await import("./harness.js");
    const seen = {};
    for (let load = 1; load <= 100; load += 1) {
      await open(page, [load % 2 ? model : SAMPLE]);
      if (load === 10 || load === 100) seen[load] = { memory: await memoryOf(page), ...(await held(page)) };
    }
    const told = (at) => `${mb(seen[at].memory)}, ${BACKEND === "webgpu" ? seen[at].GPUTexture : seen[at].WebGLTexture} textures`;
    const isSame = seen[100].memory <= seen[10].memory && seen[100].GPUTexture <= seen[10].GPUTexture && seen[100].WebGLTexture <= seen[10].WebGLTexture;
    row("load 100 beside load 10", `${told(100)}; ${told(10)}`, "the same", isSame, `${basename(model)} and the sample in turn`);
  });

  await onPage(async (page) => {
    await open(page, [model]);
    const frames = await rounds(async () => {
      await page.evaluate(() => {
        bindpose.play();
        globalThis.watched.frames.length = 0;
      });
      await page.waitForTimeout(6000);
      return page.evaluate(() => ({ frames: globalThis.watched.frames.filter(([took]) => took > 0.1), cost: bindpose.state().cost.cpuMs }));
    });
    const ours = median(frames.map(({ frames }) => median(frames.map(([took, gpu]) => took - gpu))));
    const whole = median(frames.map(({ frames }) => median(frames.map(([took]) => took))));
    row("a frame that plays: ours, with the GPU's calls, posing and encoding with them", `${ms(ours)}, ${ms(whole)}, ${ms(median(frames.map(({ cost }) => cost)))}`, "≤ 1.5 ms", ours <= 1.5, `${sum(frames.map(({ frames }) => frames.length))} frames of ${basename(model)}`);
    await page.evaluate(() => bindpose.pause());
    // Pipelines are built while nothing moves, one after the other.
    const waits = () => page.evaluate(() => globalThis.watched.timers);
    for (let before = -1; before !== (before = await waits()); ) await page.waitForTimeout(2000);
    const idle = await rounds(() =>
      page.evaluate(async () => {
        const wait = (milliseconds) => new Promise((done) => AbortSignal.timeout(milliseconds).addEventListener("abort", done));
        const count = () => [bindpose.state().framesRendered, globalThis.watched.frames.length, globalThis.watched.timers];
        const before = count();
        await wait(3000);
        return count().map((number, index) => number - before[index]);
      }),
    );
    const [pictures, callbacks, timers] = [0, 1, 2].map((index) => median(idle.map((counted) => counted[index])));
    row("3 s at rest", `${pictures} pictures, ${callbacks} callbacks of frames, ${timers} timers`, "0", pictures + callbacks + timers === 0, basename(model));
  }, "&quality=full&scale=0.2");
  rmSync(folder, { recursive: true });
  return rows;
}

const SHARED_MODEL = fileURLToPath(new URL("../../../shared/models/d3d12/soldier.m3d", import.meta.url));
const SAMPLE_MODEL = fileURLToPath(new URL("../../web/sample/figure.m3d", import.meta.url));

if (process.env.BACKEND) {
  const rows = await measure(process.argv[2]);
  process.send(rows, () => process.exit());
} else {
  const model = process.argv[2] ?? (existsSync(SHARED_MODEL) ? SHARED_MODEL : SAMPLE_MODEL);
  console.log("| backend | what | figure | aim | of |\n|---|---|--:|--:|---|");
  for (const BACKEND of ["webgpu", "webgl2"]) {
    const child = fork(fileURLToPath(import.meta.url), [model], { env: { ...process.env, BACKEND }, stdio: ["ignore", "ignore", "inherit", "ipc"] });
    const rows = await new Promise((done, fail) => {
      child.once("message", done);
      child.once("exit", (code) => fail(new Error(`${BACKEND} ended with ${code}`)));
    });
    for (const { what, figure, aim, reached, check } of rows) {
      console.log(`| ${BACKEND} | ${what} | ${figure} | ${aim}${reached === false ? ", missed" : ""} | ${check} |`);
    }
  }
}
