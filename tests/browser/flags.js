// How Chromium is started.

/**
 * Software drawing that gives real pixels, in screenshots too. Other sets start the page but leave it blank. WebGL2 is drawn by Mesa, for which
 * `LIBGL_ALWAYS_SOFTWARE` must be set: a frame takes less than half the time that SwiftShader takes. For WebGPU Chromium has SwiftShader only.
 */
export const GPU_FLAGS = {
  webgl2: ["--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist", "--disable-gpu-sandbox"],
  webgpu: [
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--enable-unsafe-webgpu",
    "--enable-gpu",
    "--enable-features=Vulkan",
    "--use-vulkan=swiftshader",
  ],
};

/** A browser that asks nobody anything. */
export const QUIET_FLAGS = [
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--disable-quic",
  "--no-first-run",
];
