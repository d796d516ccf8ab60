// The package with the element as those have it who install it: on a page that vite builds, and on one without a bundler.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { chromium } from "playwright-core";
import ts from "typescript";
import { GPU_FLAGS, QUIET_FLAGS } from "./flags.js";
import { launch } from "./other_browsers.js";

/** Given by `cargo xtask test --long`: the folder that npm packs, and browsers. */
const { PACKAGE, CHROMIUM, FIREFOX } = process.env;
/** The newest that runs on Debian's Node. */
const VITE = "6.4.6";
const PATIENCE_MS = 120_000;
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".m3d": "text/plain", ".png": "image/png" };
const SAMPLE = fileURLToPath(new URL("../../web/sample/", import.meta.url));
const VIEWERS = ["one", "two", "three"].map((id) => `<bindpose-viewer id="${id}" src="/figure.m3d /figure_diff.png" clip="Walk" current-time="0.5"></bindpose-viewer>`).join("\n");

/** What the README has vite's server for development told. */
const README = readFileSync(new URL("../../xtask/npm/README.md", import.meta.url), "utf8");
const CONFIG = JSON.parse(/export default (\{.*\});/.exec(README)[1].replace(/(\w+):/g, '"$1":'));

let folder;
let server;
let address;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), "bindpose-npm-"));
  const npm = (...words) => execFileSync("npm", [...words, "--no-audit", "--no-fund", "--loglevel=error"], { cwd: folder, encoding: "utf8" });
  const packed = npm("pack", PACKAGE, "--silent").trim().split("\n").at(-1);
  writeFileSync(join(folder, "package.json"), JSON.stringify({ name: "notes", private: true, type: "module" }));
  npm("install", `./${packed}`, `vite@${VITE}`);
  mkdirSync(join(folder, "public"));
  for (const name of ["figure.m3d", "figure_diff.png"]) copyFileSync(join(SAMPLE, name), join(folder, "public", name));
  writeFileSync(join(folder, "index.html"), `<!doctype html><title>Notes</title><script type="module" src="/main.js"></script>${VIEWERS}`);
  writeFileSync(join(folder, "main.js"), 'import "bindpose-viewer";\n');
  execFileSync(process.execPath, [join(folder, "node_modules/vite/bin/vite.js"), "build"], { cwd: folder, encoding: "utf8" });
  // The same without a bundler: the package's folder beside the page.
  writeFileSync(join(folder, "public", "plain.html"), `<!doctype html><title>Notes</title><script type="module" src="/node_modules/bindpose-viewer/web/element/bindpose-viewer.js"></script>${VIEWERS}`);
  server = createServer(({ url }, response) => {
    const { pathname, searchParams } = new URL(url, "http://host");
    const path = decodeURIComponent(pathname);
    const roots = { "/built/": "dist", "/node_modules/": "node_modules" };
    const root = Object.keys(roots).find((start) => path.startsWith(start));
    const file = root ? join(folder, roots[root], path.slice(root.length) || "index.html") : join(folder, path.startsWith("/assets/") ? "dist" : "public", path);
    try {
      let bytes = readFileSync(file);
      const backend = searchParams.get("backend");
      if (backend) bytes = bytes.toString().replaceAll("<bindpose-viewer ", `<bindpose-viewer backend="${backend}" `);
      response.writeHead(200, { "Content-Type": TYPES[extname(file)] ?? "application/octet-stream" }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  address = `http://127.0.0.1:${server.address().port}`;
}, { timeout: 3 * PATIENCE_MS });

after(() => {
  server?.close();
  if (folder) rmSync(folder, { recursive: true });
});

/** In the page: what its viewers say once all have loaded, and which programs came. */
const loaded = async () => {
  const viewers = [...document.querySelectorAll("bindpose-viewer")];
  for (const viewer of viewers) {
    viewer.scrollIntoView();
    while (viewer.clip !== "Walk" && !viewer.error) await new Promise((done) => setTimeout(done, 100));
  }
  const programs = performance.getEntriesByType("resource").filter(({ name }) => name.endsWith(".wasm"));
  return { viewers: viewers.map((viewer) => [viewer.clip, viewer.currentTime, viewer.error?.message ?? null, viewer.state().backend]), programs: programs.length };
};

const expected = (backend) => ({ viewers: Array(3).fill(["Walk", 0.5, null, backend]), programs: 1 });

test("what is packed has the element, its types and the licences", () => {
  const has = readdirSync(join(folder, "node_modules/bindpose-viewer"));
  assert.deepEqual(has.sort(), ["README.md", "bindpose-viewer.d.ts", "licenses.txt", "package.json", "pkg", "viewer.d.ts", "web"]);
  const { version, license } = JSON.parse(readFileSync(join(folder, "node_modules/bindpose-viewer/package.json"), "utf8"));
  assert.match(version, /^\d+\.\d+\.\d+$/);
  assert.notEqual(version, "0.0.0");
  assert.match(license, /MIT/);
  const wasm = (folder) => readdirSync(folder, { recursive: true }).filter((name) => name.endsWith(".wasm")).map((name) => readFileSync(join(folder, name)).toString("latin1"));
  // The checks have one program at several addresses.
  const different = (folder) => new Set(wasm(folder));
  const [packed, built] = ["node_modules/bindpose-viewer", "dist/assets"].map((name) => different(join(folder, name)));
  assert.deepEqual([packed.size, packed.size], [built.size, wasm(join(folder, "dist/assets")).length], "vite takes each program once");
  assert.ok(packed.size >= 2);
});

test("a program finds the types of what is installed by its name", () => {
  const path = join(folder, "told.ts");
  writeFileSync(path, `import "bindpose-viewer";
    import type { BindposeViewerElement } from "bindpose-viewer";
    import init, { Viewer } from "bindpose-viewer/viewer";
    const told: string | null = (null as unknown as BindposeViewerElement).clip;
    const wrong: string = (null as unknown as BindposeViewerElement).currentTime;
    export const all = [init, Viewer, told, wrong];`);
  const program = ts.createProgram([path], { strict: true, noEmit: true, types: [], target: ts.ScriptTarget.ES2022, module: ts.ModuleKind.ESNext, moduleResolution: ts.ModuleResolutionKind.Bundler });
  const told = ts.getPreEmitDiagnostics(program).map(({ messageText }) => ts.flattenDiagnosticMessageText(messageText, "\n"));
  assert.deepEqual(told, ["Type 'number' is not assignable to type 'string'."], "the mistake, and nothing else");
});

for (const backend of ["webgpu", "webgl2"]) {
  test(`three viewers in Chromium on ${backend}, built by vite and without a bundler`, { timeout: 4 * PATIENCE_MS }, async () => {
    const rights = process.getuid?.() === 0 ? ["--no-sandbox"] : [];
    const browser = await chromium.launch({ executablePath: CHROMIUM, args: [...GPU_FLAGS[backend], ...QUIET_FLAGS, ...rights, "--force-device-scale-factor=0.5"] });
    try {
      // The server for development with what the README gives it, and the pages that are built and not.
      const { createServer: developing } = await import(join(folder, "node_modules/vite/dist/node/index.js"));
      const asked = { name: "backend", transformIndexHtml: (html) => html.replaceAll("<bindpose-viewer ", `<bindpose-viewer backend="${backend}" `) };
      const developed = await developing({ root: folder, logLevel: "silent", server: { host: "127.0.0.1", port: 0 }, plugins: [asked], ...CONFIG });
      await developed.listen();
      const [local] = developed.resolvedUrls.local;
      for (const at of [`${address}/built/`, `${address}/plain.html`, local]) {
        const page = await browser.newPage({ viewport: { width: 600, height: 500 } });
        const problems = [];
        page.on("pageerror", ({ message }) => problems.push(message));
        await page.goto(`${at}?backend=${backend}`);
        assert.deepEqual(await page.evaluate(loaded), expected(backend), at);
        assert.deepEqual(problems, [], at);
        await page.close();
      }
      await developed.close();
    } finally {
      await browser.close();
    }
  });
}

test("three viewers in Firefox", { timeout: 3 * PATIENCE_MS }, async () => {
  const page = await launch("firefox", FIREFOX);
  try {
    await page.open(`${address}/built/`);
    assert.deepEqual(await page.evaluate(loaded), expected("webgl2"));
  } finally {
    await page.close();
  }
});
