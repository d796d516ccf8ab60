// What a page holds.

import { existsSync, readFileSync } from "node:fs";
import { FOLDER, settled } from "./harness.js";

/** What the page holds once its garbage is gone: of each kind how many, and megabytes. `folder`: of the program that it runs. */
export async function held(page, folder = FOLDER) {
  const devtools = await page.context().newCDPSession(page);
  await devtools.send("HeapProfiler.enable");
  // What one collection has ended, the next one frees.
  for (let round = 0; round < 3; round += 1) {
    await devtools.send("HeapProfiler.collectGarbage");
    await settled(page);
  }
  const count = async (kind) => {
    const { result } = await devtools.send("Runtime.evaluate", { expression: `globalThis.${kind}?.prototype`, objectGroup: "held" });
    if (!result.objectId) return 0;
    const { objects } = await devtools.send("Runtime.queryObjects", { prototypeObjectId: result.objectId, objectGroup: "held" });
    return Number(/\d+/.exec(objects.description)[0]);
  };
  const objects = {};
  for (const kind of ["HTMLCanvasElement", "HTMLInputElement", "WebGL2RenderingContext", "WebGLTexture", "GPUDevice", "GPUTexture"]) objects[kind] = await count(kind);
  const { jsEventListeners } = await devtools.send("Memory.getDOMCounters");
  const { usedSize } = await devtools.send("Runtime.getHeapUsage");
  await devtools.send("Runtime.releaseObjectGroup", { objectGroup: "held" });
  await devtools.detach();
  const browser = await page.context().browser().newBrowserCDPSession();
  const { processInfo } = await browser.send("SystemInfo.getProcessInfo");
  await browser.detach();
  const [status] = processInfo.filter(({ type }) => type === "GPU").map(({ id }) => `/proc/${id}/status`).filter(existsSync);
  const gpuMB = status && Number(/VmRSS:\s*(\d+)/.exec(readFileSync(status, "utf8"))[1]) / 1e3;
  const wasm = await page.evaluate(async (folder) => {
    const { default: init } = await import(`${folder}bindpose.js`);
    return (await init()).memory.buffer.byteLength;
  }, folder);
  return { ...objects, jsEventListeners, scriptMB: usedSize / 1e6, wasmMB: wasm / 1e6, gpuMB };
}
