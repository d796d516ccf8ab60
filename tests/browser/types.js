// The package's types against what the viewer says of itself: a program that has both as text is compiled.

import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import ts from "typescript";
import { FIXTURES, FOLDER, dropAndWait, state, test } from "./harness.js";
import { hears, pageOf } from "./notes.js";

const pathOf = (name) => fileURLToPath(new URL(`../../xtask/npm/${name}.d.ts`, import.meta.url));
const [TYPES, CLASS] = ["bindpose-viewer", "viewer"].map(pathOf);
/** As a program names them. */
const [types, ofClass] = [TYPES, CLASS].map((path) => JSON.stringify(path.replace(/\.d\.ts$/, "")));

/** What the compiler says of a program. */
function complaints(text) {
  const folder = mkdtempSync(join(tmpdir(), "bindpose-types-"));
  try {
    const path = join(folder, "told.ts");
    writeFileSync(path, text);
    const program = ts.createProgram([path, TYPES, CLASS], { strict: true, noEmit: true, types: [], lib: ["lib.es2022.d.ts", "lib.dom.d.ts", "lib.dom.iterable.d.ts"], target: ts.ScriptTarget.ES2022, moduleResolution: ts.ModuleResolutionKind.Bundler, module: ts.ModuleKind.ESNext, skipLibCheck: false });
    return ts.getPreEmitDiagnostics(program).map(({ messageText }) => ts.flattenDiagnosticMessageText(messageText, "\n"));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

test("the types have all that the viewer says of itself, and no more", { own: true, expectErrors: true, only: "webgl2" }, async (page) => {
  const states = [await state(page)];
  for (const name of ["good/d3d12_skinned.m3d", "fbx/walker.fbx", "bad/parent_not_a_number.m3d"]) {
    await dropAndWait(page, [`${FIXTURES}${name}`]);
    states.push(await state(page));
  }
  const names = await page.evaluate(async () => {
    const { BindposeViewerElement } = await import("/web/element/bindpose-viewer.js");
    return Object.getOwnPropertyNames(BindposeViewerElement.prototype).filter((name) => !/^constructor$|Callback$/.test(name));
  });
  const program = (names, states) => `
    import type { BindposeViewerElement, State } from ${types};
    type Own = Exclude<keyof BindposeViewerElement, keyof HTMLElement>;
    export const names: Record<Own, true> = ${JSON.stringify(Object.fromEntries(names.map((name) => [name, true])))};
    export const states: State[] = ${JSON.stringify(states)};
    const viewer = document.querySelector("bindpose-viewer")!;
    viewer.addEventListener("progress", ({ detail }) => detail.totalProgress.toFixed());
    viewer.addEventListener("camera-change", ({ detail }) => detail.yawRadians.toFixed());`;
  assert.deepEqual(complaints(program(names, states)), []);
  // The check can fail.
  assert.match(complaints(program([...names, "spin"], states)).join(), /spin/);
  assert.match(complaints(program(names.slice(1), states)).join(), new RegExp(names[0]));
  assert.match(complaints(program(names, [{ ...states[0], mood: "good" }])).join(), /mood/);
});

test("the types of the class have all its methods, with what each takes, the formats of an export, and the details of what it tells", {
  own: true,
  only: "webgl2",
}, async (page) => {
  const methods = await page.evaluate(async (folder) => {
    const { Viewer } = await import(`${folder}bindpose.js`);
    const names = Object.getOwnPropertyNames(Viewer.prototype).filter((name) => !/^(__.*|constructor)$/.test(name));
    return Object.fromEntries(names.map((name) => [name, Viewer.prototype[name].length]));
  }, FOLDER);
  const refused = await page.evaluate(() => bindpose.export({ format: "none" }).catch(({ message }) => message));
  const formats = refused.split(" takes ")[1].split(/, | or /);
  const told = await page.evaluate(async () => {
    const details = {};
    for (const type of ["load", "error", "play", "pause", "timeupdate", "playbackchange"]) {
      bindpose.addEventListener(type, ({ detail }) => (details[type] = detail));
    }
    const bytes = new Uint8Array(await (await fetch("web/sample/figure.m3d")).arrayBuffer());
    await bindpose.open([{ name: "figure.m3d", bytes }]);
    bindpose.play();
    bindpose.setSpeed(2);
    while (!details.timeupdate) await new Promise(requestAnimationFrame);
    bindpose.pause();
    await bindpose.open([{ name: "none.m3d", bytes: bytes.slice(0, 100) }]);
    return details;
  });
  const program = (methods, told, known = formats) => `
    import type { ExportOptions, Viewer, ViewerEventMap } from ${ofClass};
    type Format = NonNullable<ExportOptions["format"]>;
    export const formats: Record<Format, true> = ${JSON.stringify(Object.fromEntries(known.map((name) => [name, true])))};
    type Takes<K extends keyof Viewer> = Required<Parameters<Viewer[K]>>["length"];
    export const methods: { [K in keyof Viewer]: Takes<K> } = ${JSON.stringify(methods)};
    export const told: ViewerEventMap = ${JSON.stringify(told)};`;
  assert.deepEqual(complaints(program(methods, told)), []);
  // The check can fail.
  assert.match(complaints(program({ ...methods, spin: 0 }, told)).join(), /spin/);
  assert.match(complaints(program({ ...methods, seek: 2 }, told)).join(), /'2' is not assignable to type '1'/);
  const { setWrap, ...fewer } = methods;
  assert.equal(setWrap, 1);
  assert.match(complaints(program(fewer, told)).join(), /setWrap/);
  assert.match(complaints(program(methods, { ...told, load: {} })).join(), /name/);
  assert.match(complaints(program(methods, told, formats.slice(1))).join(), /glb/);
});

test("the types of the element's events are those of what it tells", {
  only: "webgl2",
  expectErrors: true,
  ...pageOf(`<bindpose-viewer id="a" src="web/sample/figure.m3d" clip="Walk"></bindpose-viewer>
    <bindpose-viewer id="b" src="web/nothing.m3d"></bindpose-viewer>`),
}, async (page) => {
  await hears(page, "a", "load");
  await hears(page, "b", "error");
  await page.evaluate(() => {
    const viewer = document.getElementById("a");
    viewer.currentTime = viewer.startTime + viewer.duration - 0.2;
    viewer.play();
  });
  await hears(page, "a", "ended");
  await page.evaluate(() => document.getElementById("a").setAttribute("camera", "70 12"));
  await hears(page, "a", "camera-change");
  const told = await page.evaluate(() => {
    const last = Object.entries(details).map(([type, all]) => [type, all.at(-1)]);
    return Object.fromEntries(last);
  });
  const program = (told) => `
    import type { BindposeViewerEventMap } from ${types};
    type Own = "load" | "progress" | "error" | "play" | "pause" | "ended" | "timeupdate" | "camera-change";
    type Detail<E> = E extends CustomEvent<infer D> ? D : never;
    export const told: { [K in Own]: Detail<BindposeViewerEventMap[K]> } = ${JSON.stringify(told)};`;
  assert.deepEqual(complaints(program(told)), []);
  // The check can fail.
  assert.match(complaints(program({ ...told, load: {} })).join(), /not assignable/);
  assert.match(complaints(program({ ...told, progress: {} })).join(), /totalProgress/);
  const { ended, ...fewer } = told;
  assert.equal(ended, null);
  assert.match(complaints(program(fewer)).join(), /ended/);
});
