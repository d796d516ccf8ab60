// Which program the page fetches: the smaller one draws on WebGPU alone. It begins before the rest of the page is here.

/** How the page starts. What stands behind `#` is a link to what is seen: link.js. */
export const options = new URLSearchParams(globalThis.location?.search);
const named = options.get("backend");
/** The backend that it asks for. */
export const backend = ["webgpu", "webgl2"].includes(named) ? named : "auto";

/** Of each program its script and its bytes, as bundlers find them. */
const PROGRAMS = {
  full: [() => import("../pkg/bindpose.js"), () => new URL("../pkg/bindpose_bg.wasm", import.meta.url)],
  webgpu: [() => import("../pkg/webgpu/bindpose.js"), () => new URL("../pkg/webgpu/bindpose_bg.wasm", import.meta.url)],
  // Without the interface.
  smallFull: [() => import("../pkg/element/bindpose.js"), () => new URL("../pkg/element/bindpose_bg.wasm", import.meta.url)],
  smallWebgpu: [() => import("../pkg/element/webgpu/bindpose.js"), () => new URL("../pkg/element/webgpu/bindpose_bg.wasm", import.meta.url)],
};

/** The page's own script element; on other people's pages there is none. */
const own = globalThis.document?.getElementById("program");

/** Whether WebGPU draws on hardware, as far as the browser tells. The program knows more software by its name, and then asks for the full one. */
async function hasGpu() {
  const adapter = await navigator.gpu?.requestAdapter({ powerPreference: "high-performance" });
  return adapter && !adapter.info.isFallbackAdapter;
}

/** A program's script, the response with its bytes, and how many they will be: a compressed response does not tell. */
export async function fetchProgram(name) {
  const [script, address] = PROGRAMS[name];
  const [module, response] = await Promise.all([script(), fetch(address())]);
  if (!response.ok) throw new Error(`The server answered ${response.status} for ${response.url}`);
  return { name, module, response, total: Number(own?.dataset[name]) };
}

/** The name of the program for a backend. */
export const nameFor = async (wanted) => ((wanted === "auto" ? await hasGpu().catch(() => false) : wanted === "webgpu") ? "webgpu" : "full");

/** Compiles a program while it arrives. `progress(arrived, total)` hears of bytes. */
export async function compile(program, progress) {
  const { module, response, total } = program;
  let arrived = 0;
  const counted = response.body.pipeThrough(
    new TransformStream({
      transform(chunk, controller) {
        arrived += chunk.byteLength;
        progress(arrived, total);
        controller.enqueue(chunk);
      },
    }),
  );
  const headers = { "Content-Type": "application/wasm" };
  await module.default({ module_or_path: new Response(counted, { headers }) });
  return program;
}

export const first = own && nameFor(backend).then(fetchProgram);
first?.catch(() => {}); // boot.js reports it.
