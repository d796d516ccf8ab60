// The package's types against what the viewer says of itself: a program that has both as text is compiled.

import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import ts from "typescript";
import { FIXTURES, dropAndWait, state, test } from "./harness.js";

const TYPES = fileURLToPath(new URL("../../xtask/npm/bindpose-viewer.d.ts", import.meta.url));

/** What the compiler says of a program. */
function complaints(text) {
  const folder = mkdtempSync(join(tmpdir(), "bindpose-types-"));
  try {
    const path = join(folder, "told.ts");
    writeFileSync(path, text);
    const program = ts.createProgram([path, TYPES], { strict: true, noEmit: true, types: [], lib: ["lib.es2022.d.ts", "lib.dom.d.ts", "lib.dom.iterable.d.ts"], target: ts.ScriptTarget.ES2022, moduleResolution: ts.ModuleResolutionKind.Bundler, module: ts.ModuleKind.ESNext, skipLibCheck: false });
    return ts.getPreEmitDiagnostics(program).map(({ messageText }) => ts.flattenDiagnosticMessageText(messageText, "\n"));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

test("the types have all that the viewer says of itself, and no more", { own: true, expectErrors: true, only: "webgl2" }, async (page) => {
  const states = [await state(page)];
  for (const name of ["good/d3d12_skinned.m3d", "bad/parent_not_a_number.m3d"]) {
    await dropAndWait(page, [`${FIXTURES}${name}`]);
    states.push(await state(page));
  }
  const names = await page.evaluate(async () => {
    const { BindposeViewerElement } = await import("/web/element/bindpose-viewer.js");
    return Object.getOwnPropertyNames(BindposeViewerElement.prototype).filter((name) => !/^constructor$|Callback$/.test(name));
  });
  const program = (names, states) => `
    import type { BindposeViewerElement, State } from ${JSON.stringify(TYPES.replace(/\.d\.ts$/, ""))};
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
