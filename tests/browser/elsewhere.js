// `?src=`: files of other servers, and what is told of a server that does not give them.

import assert from "node:assert/strict";
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { crc32 } from "node:zlib";
import { BACKEND, PAGE, SAMPLE, state, test, until } from "./harness.js";
import { hostOf } from "./host.js";

/** A triangle whose bytes lie in a file beside it, and one that a third server would have. */
export const SCENE = JSON.stringify({
  asset: { version: "2.0" },
  buffers: [{ uri: "data/a%20triangle.bin", byteLength: 36 }],
  bufferViews: [{ buffer: 0, byteLength: 36 }],
  accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: "VEC3", min: [0, 0, 0], max: [1, 1, 0] }],
  images: [{ uri: "http://127.0.0.1:9/secret.png" }],
  meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
  nodes: [{ mesh: 0 }],
  scenes: [{ nodes: [0] }],
});
export const TRIANGLE = Buffer.from(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]).buffer);

/** An archive with one file, as it is. */
function zipped(name, bytes) {
  const part = (signature, ...fields) => {
    const numbers = fields.map(([value, length]) => {
      const written = Buffer.alloc(length);
      written.writeUIntLE(value, 0, length);
      return written;
    });
    return Buffer.concat([Buffer.from(signature, "latin1"), ...numbers]);
  };
  const lengths = [[bytes.length, 4], [bytes.length, 4], [name.length, 2], [0, 2]];
  const facts = [[0, 2], [0, 2], [0, 4], [crc32(bytes), 4], ...lengths];
  const file = Buffer.concat([part("PK\x03\x04", [20, 2], ...facts), Buffer.from(name), bytes]);
  const rest = [[0, 2], [0, 2], [0, 2], [0, 4], [0, 4]];
  const entry = Buffer.concat([part("PK\x01\x02", [20, 2], [20, 2], ...facts, ...rest), Buffer.from(name)]);
  const end = part("PK\x05\x06", [0, 2], [0, 2], [1, 2], [1, 2], [entry.length, 4], [file.length, 4], [0, 2]);
  return Buffer.concat([file, entry, end]);
}

/** Answers like other people's servers; `/slow/` with a half of the model, and then with nothing until the asker goes. */
async function serving(body) {
  const model = await readFile(SAMPLE);
  const picture = await readFile(SAMPLE.replace(".m3d", "_diff.png"));
  const asked = [];
  let gone = 0;
  const server = createServer((request, response) => {
    const { url, headers } = request;
    asked.push({ url, cookie: headers.cookie, referer: headers.referer });
    const allows = url.startsWith("/closed/") ? {} : { "Access-Control-Allow-Origin": "*" };
    const send = (status, bytes) => response.writeHead(status, { ...allows, "Content-Length": bytes.length }).end(bytes);
    if (url.endsWith(".gltf")) return send(200, SCENE);
    if (url.endsWith(".bin")) return send(200, TRIANGLE);
    if (url.endsWith(".zip")) return send(200, zipped("deep/packed.m3d", model));
    if (url.endsWith(".png")) return send(200, picture);
    // Nothing is promised.
    if (url.startsWith("/untold/")) {
      response.writeHead(200, allows);
      return response.end(model);
    }
    // Less is promised than comes.
    if (url.startsWith("/cut/")) {
      response.writeHead(200, { ...allows, "Content-Length": 1000 });
      response.flushHeaders();
      return response.socket.end(model);
    }
    if (url.startsWith("/slow/")) {
      response.writeHead(200, { ...allows, "Content-Length": model.length });
      let at = 0;
      const timer = setInterval(() => at < model.length / 2 && response.write(model.subarray(at, (at += 50_000))), 100);
      response.on("close", () => {
        clearInterval(timer);
        gone += 1;
      });
      return;
    }
    if (url.startsWith("/failing/")) return send(503, "");
    if (url.startsWith("/text/")) return send(200, "Dear reader,\n");
    return url.endsWith("/figure.m3d") ? send(200, model) : send(404, "");
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  try {
    await body(`http://127.0.0.1:${server.address().port}`, asked, () => gone, () => server.closeAllConnections());
  } finally {
    server.closeAllConnections();
    server.close();
  }
}

/** The rest of an address that names files. */
const named = (...addresses) => `?backend=${BACKEND}&scale=0.2&${addresses.map((address) => `src=${encodeURIComponent(address)}`).join("&")}`;

/** Opens the page with files of these addresses. */
const visit = (page, ...addresses) => page.goto(PAGE + named(...addresses));

/** On both backends: how the program is there differs, and each takes a second or two. */
const SHORT = { bare: true, draws: true };

/** Waits until the card says this. */
const refused = (page, words) =>
  page.waitForFunction((words) => document.getElementById("notice-words").textContent.includes(words), words, { polling: 30 });

test("the page of a host that says nothing of it tells no other server where it is", { bare: true, expectErrors: true }, (page) =>
  serving(async (server, asked) => {
    const host = await hostOf("one");
    await page.goto(host.address + named(`${server}/models/figure.m3d`));
    await until(page, (now) => now.model);
    await host.stop();
    assert.deepEqual(asked, [{ url: "/models/figure.m3d", cookie: undefined, referer: undefined }]);
  }));

test("a model comes from servers with https: and from this computer, and the policy lets nobody else be asked", { bare: true, expectErrors: true }, (page) =>
  serving(async (server) => {
    const body = await readFile(SAMPLE);
    await page.route("https://models.example/**", (route) => route.fulfill({ body, headers: { "Access-Control-Allow-Origin": "*" } }));
    for (const of of [server.replace("127.0.0.1", "localhost"), server, "https://models.example"]) {
      await visit(page, `${of}/figure.m3d`);
      assert.equal((await until(page, (now) => now.model || now.error)).model?.name, "figure.m3d", of);
    }
    await page.route("http://models.example/**", (route) => route.fulfill({ body, headers: { "Access-Control-Allow-Origin": "*" } }));
    const blocked = await page.evaluate(async () => {
      const violation = new Promise((done) => addEventListener("securitypolicyviolation", done, { once: true }));
      const answer = await fetch("http://models.example/figure.m3d").then(() => "answered", () => "refused");
      return [answer, (await violation).effectiveDirective];
    });
    assert.deepEqual(blocked, ["refused", "connect-src"]);
  }));

test("a model of another server opens, and so does what a .gltf names beside itself", SHORT, (page) =>
  serving(async (server, asked) => {
    const requests = [];
    page.on("request", (request) => requests.push(request.url()));
    await page.context().addCookies([{ name: "secret", value: "1", url: server }]);
    await visit(page, `${server}/models/figure.m3d`);
    assert.equal((await until(page, (now) => now.model)).model.name, "figure.m3d");
    assert.deepEqual(asked, [{ url: "/models/figure.m3d", cookie: undefined, referer: undefined }]);
    await page.context().clearCookies();
    await visit(page, `${server}/models/scene.gltf`);
    const { model, error } = await until(page, (now) => now.model || now.error);
    assert.deepEqual([error, model?.name, model?.counts.triangles], [null, "scene.gltf", 1]);
    assert.deepEqual(asked.slice(1).map(({ url }) => url), ["/models/scene.gltf", "/models/data/a%20triangle.bin"]);
    assert.deepEqual(requests.filter((url) => ![PAGE, `${server}/`].some((known) => url.startsWith(known))), []);
  }));

test("a model and its pictures may come from several addresses, or in an archive", SHORT, (page) =>
  serving(async (server, asked) => {
    const maps = [`${server}/maps/figure_diff.png`, `${PAGE}web/sample/figure_norm.png`];
    await visit(page, `${server}/models/figure.m3d`, ...maps);
    const { model, textures } = await until(page, (now) => now.model);
    assert.equal(model.name, "figure.m3d");
    assert.deepEqual([textures.named, textures.missing, textures.unreadable], [2, [], []]);
    assert.deepEqual(asked.map(({ url }) => url).sort(), ["/maps/figure_diff.png", "/models/figure.m3d"]);
    await visit(page, `${server}/models/pack.zip`);
    assert.equal((await until(page, (now) => now.model || now.error)).model?.path, "deep/packed.m3d");
  }));

const FAILING = { ...SHORT, expectErrors: true };

test("a wrong length ends in words, and one that nobody told in the model", FAILING, (page) =>
  serving(async (server, _, __, breakOff) => {
    await visit(page, `${server}/untold/figure.m3d`);
    assert.equal((await until(page, (now) => now.model)).model.name, "figure.m3d");
    // Of what comes after the promised length a browser gives nothing.
    await visit(page, `${server}/cut/figure.m3d`);
    const { error, model } = await until(page, (now) => now.model || now.error);
    assert.deepEqual([model, error?.file, error?.code], [null, "figure.m3d", "unexpected-end"]);
    await visit(page, `${server}/slow/figure.m3d`);
    await until(page, (now) => now.opening?.percent > 0);
    breakOff();
    await refused(page, " bytes of /slow/figure.m3d");
    assert.match(await page.textContent("#notice-words"), /broke off after [1-9]\d* of \d+ bytes of /);
  }));

test("what a server does not give is told by what happened", FAILING, (page) =>
  serving(async (server) => {
    const host = server.replace("http://", "");
    for (const [address, words] of [
      [`${server}/closed/figure.m3d`, `${host} does not let other pages read /closed/figure.m3d`],
      [`${server}/models/other.m3d`, `${host} has no /models/other.m3d`],
      [`${server}/models/100%.m3d`, `${host} has no /models/100%.m3d`],
      [`${server}/failing/figure.m3d`, `${host} answered 503 for /failing/figure.m3d`],
      ["http://127.0.0.1:9/figure.m3d", "127.0.0.1:9 did not answer"],
      ["http://example.com/figure.m3d", "http://example.com/figure.m3d is not asked for"],
      ["absent.m3d", "has no "],
    ]) {
      await visit(page, address);
      await refused(page, words);
      assert.equal((await state(page)).model, null, address);
    }
    await visit(page, `${server}/text/letter.txt`);
    const { error } = await until(page, (now) => now.error);
    assert.deepEqual([error.code, error.file], ["not-m3d", "letter.txt"]);
  }));

test("a slow server is waited for, with the part that has come, and Esc gives it up", FAILING, (page) =>
  serving(async (server, _, gone) => {
    await visit(page, `${server}/slow/figure.m3d`);
    const { opening } = await until(page, (now) => now.opening?.percent > 0);
    assert.deepEqual([opening.name, opening.stage], ["figure.m3d", "fetching"]);
    await page.locator("#view canvas").focus();
    // A key that comes with the focus, in one slow frame, is not heard.
    for (let round = 0; round < 20 && (await state(page)).opening; round += 1) {
      await page.keyboard.press("Escape");
      await page.waitForTimeout(500);
    }
    await until(page, (now) => now.opening === null);
    for (const deadline = Date.now() + 10_000; gone() === 0; await page.waitForTimeout(50)) assert.ok(Date.now() < deadline, "the server is still asked");
    assert.deepEqual([(await state(page)).model, await page.isHidden("#notice")], [null, true]);
  }));
