// A host of static files as there are many: it says nothing of caching, and has the site in a folder.

import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { gzipSync } from "node:zlib";

/** The builds that `cargo xtask test` has written: `one` and `two`. */
const { BUILDS } = process.env;

const TYPES = {
  css: "text/css", html: "text/html", js: "text/javascript", json: "application/json", svg: "image/svg+xml", wasm: "application/wasm",
  webmanifest: "application/manifest+json",
};

/** Serves a build below a folder; `build` may be changed, `lacks` is how names begin that it does not have, `keeps` has it say that all may be kept for an hour, `asked` has the names that were asked for. It can stop and come back to the same address. */
export async function hostOf(build) {
  const folder = "/some/where/";
  const host = { build, asked: [], lacks: null, keeps: false, address: "", stop, start };
  let port = 0;
  const server = createServer(async ({ url }, response) => {
    const { pathname } = new URL(url, "http://host");
    const name = pathname.slice(folder.length) || "index.html";
    host.asked.push(name);
    if (host.keeps) response.setHeader("Cache-Control", "max-age=3600");
    try {
      if (!pathname.startsWith(folder) || (host.lacks && name.startsWith(host.lacks))) throw new Error("not of the site");
      const bytes = await readFile(`${BUILDS}/${host.build}/${name}`);
      const type = TYPES[name.split(".").pop()] ?? "application/octet-stream";
      if (type.startsWith("text/")) response.writeHead(200, { "Content-Type": type, "Content-Encoding": "gzip" }).end(gzipSync(bytes));
      else response.writeHead(200, { "Content-Type": type }).end(bytes);
    } catch {
      // Many hosts answer so for what they do not have.
      response.writeHead(200, { "Content-Type": "text/html" }).end("<!doctype html><title>Nothing is here</title>");
    }
  });

  // One that comes while it stops would be waited for.
  server.on("connection", (socket) => server.listening || socket.destroy());

  async function start() {
    await new Promise((done) => server.listen(port, "127.0.0.1", done));
    ({ port } = server.address());
    host.address = `http://127.0.0.1:${port}${folder}`;
  }

  function stop() {
    const stopped = new Promise((done) => server.close(done));
    server.closeAllConnections();
    return stopped;
  }

  await start();
  return host;
}
