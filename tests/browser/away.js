// What can go away while a page goes on: the GPU, and whoever looks at it.

import { BACKEND } from "./harness.js";

/** Keeps what the page asks the browser for, so that a test can take it away again. */
export function watchGpu(page) {
  return page.addInitScript(() => {
    if (globalThis.GPUAdapter) {
      const requestDevice = GPUAdapter.prototype.requestDevice;
      GPUAdapter.prototype.requestDevice = async function (...args) {
        globalThis.device = await requestDevice.apply(this, args);
        return globalThis.device;
      };
    }
  });
}

/** Takes the GPU away from the running viewer. */
export function loseGpu(page) {
  return page.evaluate((backend) => {
    globalThis.lostCanvas = document.querySelector("#view canvas");
    if (backend === "webgpu") {
      globalThis.device.destroy();
    } else {
      globalThis.lostCanvas.getContext("webgl2").getExtension("WEBGL_lose_context").loseContext();
    }
  }, BACKEND);
}

/** A page that says that its tab is hidden, from now on or from its beginning: browsers let timers wait a second there, and show no frame. */
export const hide = () => {
  Object.defineProperty(document, "hidden", { configurable: true, get: () => true });
  const later = globalThis.setTimeout.bind(globalThis);
  globalThis.setTimeout = (work, ms, ...values) => later(work, Math.max(ms ?? 0, 1000), ...values);
  globalThis.requestAnimationFrame = () => 0;
  document.dispatchEvent(new Event("visibilitychange"));
};
