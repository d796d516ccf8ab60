// The page as hosts have it: without a network after one visit, from one build to the next, and as a program of the system.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { BACKEND, FIXTURES, SAMPLE, dropAndWait, keep, state, test as eachTest, turnPhone, until } from "./harness.js";
import { hostOf } from "./host.js";

const QUERY = `?backend=${BACKEND}&quality=full&scale=0.2`;
const OTHER = `${FIXTURES}good/d3d12_skinned.m3d`;

/** A test with a host of its own, which serves the first build: so it has a worker and caches of its own too. Without a network a page logs errors. */
function test(name, options, body) {
  eachTest(name, { bare: true, query: "web/icon.svg", expectErrors: true, ...options }, async (page) => {
    const host = await hostOf("one");
    try {
      await body(page, host);
    } finally {
      await page.goto("about:blank");
      await host.stop().catch(() => {});
    }
  });
}

/** Waits until the page shows this model. */
const shows = (page, wanted = "figure.m3d") => until(page, ({ backend, model }) => backend === BACKEND && model?.name === wanted);

async function visit(page, { address }) {
  await page.goto(address + QUERY);
  await shows(page);
}

/** The build that a page belongs to. */
const buildOf = (page) => page.evaluate(() => document.querySelector("meta[name=build]").content);

/** What is kept: names of files by build. */
const kept = (page) =>
  page.evaluate(async () => {
    const builds = {};
    for (const name of await caches.keys()) {
      const requests = await (await caches.open(name)).keys();
      const [of, scope] = name.split(" ");
      builds[of] = requests.map(({ url }) => url.slice(scope.length));
    }
    return builds;
  });

/** Waits until a build and its program are kept; gives all that is. */
async function keptWhole(page, build) {
  for (const deadline = Date.now() + 30_000; ; await new Promise((done) => setTimeout(done, 50))) {
    const builds = await kept(page).catch(() => ({}));
    if (builds[`bindpose-${build}`]?.some((name) => name.endsWith(".wasm"))) return builds;
    assert.ok(Date.now() < deadline, JSON.stringify(builds));
  }
}

/** The names that the page used, but for those that keep theirs. */
const used = (page) =>
  page.evaluate(() => performance.getEntriesByType("resource").map(({ name }) => new URL(name).pathname.slice("/some/where/".length)).filter((name) => /\.[0-9a-f]{16}\./.test(name)));

test("after one visit the page opens without a network, and a file that is dropped then", {}, async (page, host) => {
  await visit(page, host);
  const build = await buildOf(page);
  const builds = await keptWhole(page, build);
  assert.deepEqual(Object.keys(builds), [`bindpose-${build}`]);
  const names = builds[`bindpose-${build}`];
  assert.ok(names.includes("") && names.includes("web/codes.html"));
  const folder = BACKEND === "webgpu" ? "pkg/webgpu/" : "pkg/";
  const program = names.filter((name) => name.startsWith("pkg/"));
  assert.deepEqual(program.map((name) => name.replace(/[^/]*$/, "")), [folder, folder], "the program of this visit, and not the other");
  await host.stop();
  await visit(page, host);
  const { model } = await dropAndWait(page, [OTHER]);
  assert.equal(model.name, "d3d12_skinned.m3d");
  await page.goto(`${host.address}web/codes.html`);
  assert.equal(await page.title(), "Findings of Bindpose");
  // What an address names is asked for each time.
  await host.start();
  await page.goto(`${host.address}${QUERY}&src=web/theirs.m3d`);
  await page.waitForSelector("#notice:not([hidden]), [data-mirror]", { state: "attached" });
  assert.ok(host.asked.includes("web/theirs.m3d"));
  assert.deepEqual(Object.values(await kept(page)).flat().filter((name) => name.includes("theirs")), []);
});
