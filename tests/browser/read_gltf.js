// How long three.js takes to read a .glb file without its pictures: `node read_gltf.js IN OUT`. Writes the file without them to OUT, and for
// each line that it gets one with the seconds of one more reading. `cargo bench --bench parse` asks it in turn with our own reader.

import { readFileSync, writeFileSync } from "node:fs";
import { createInterface } from "node:readline";
import { loaded, withoutPictures } from "./gltf_files.js";

/** Readings before the first that counts: by then all that the engine compiles is compiled. */
const WARMING = 300;

const [from, to] = process.argv.slice(2);
const bare = withoutPictures(readFileSync(from));
writeFileSync(to, bare);

async function reading() {
  const start = performance.now();
  const { animations } = await loaded(bare);
  const seconds = (performance.now() - start) / 1000;
  if (animations.length === 0) throw new Error("no clips were read");
  return seconds;
}

for (let round = 0; round < WARMING; round += 1) await reading();
console.log("ready");
for await (const _ of createInterface({ input: process.stdin })) console.log(await reading());
