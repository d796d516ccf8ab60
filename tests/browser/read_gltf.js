// How long three.js takes to read a .glb file without its pictures: `node read_gltf.js IN OUT`. Writes the file without them to OUT, and for
// each line that it gets one with the seconds of one more reading. `cargo bench --bench parse` asks it in turn with our own reader.

import { readFileSync, writeFileSync } from "node:fs";
import { createInterface } from "node:readline";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/** Readings before the first that counts: by then all that the engine compiles is compiled. */
const WARMING = 300;

/** The file without pictures, neither in its JSON nor in its data. */
function withoutPictures(file) {
  const length = file.readUInt32LE(12);
  const root = JSON.parse(file.subarray(20, 20 + length));
  let data = file.subarray(28 + length);
  for (const { bufferView } of root.images ?? []) {
    const view = root.bufferViews[bufferView];
    // Views stay aligned.
    const [from, cut] = [view.byteOffset ?? 0, view.byteLength - (view.byteLength % 4)];
    data = Buffer.concat([data.subarray(0, from), data.subarray(from + cut)]);
    view.byteLength = 4;
    for (const other of root.bufferViews) if (other.byteOffset > from) other.byteOffset -= cut;
  }
  root.buffers[0].byteLength = data.length;
  for (const list of ["images", "textures", "samplers"]) delete root[list];
  let json = JSON.stringify(root, (key, value) => (key.endsWith("Texture") ? undefined : value));
  json = json.padEnd(4 * Math.ceil(json.length / 4));
  const bare = Buffer.alloc(28 + json.length + data.length);
  [0x46546c67, 2, bare.length, json.length, 0x4e4f534a].forEach((word, index) => bare.writeUInt32LE(word, 4 * index));
  bare.write(json, 20);
  [data.length, 0x004e4942].forEach((word, index) => bare.writeUInt32LE(word, 20 + json.length + 4 * index));
  data.copy(bare, 28 + json.length);
  return bare;
}

const [from, to] = process.argv.slice(2);
const bare = withoutPictures(readFileSync(from));
writeFileSync(to, bare);
const bytes = bare.buffer.slice(bare.byteOffset, bare.byteOffset + bare.length);

async function reading() {
  const start = performance.now();
  const { animations } = await new GLTFLoader().parseAsync(bytes, "");
  const seconds = (performance.now() - start) / 1000;
  if (animations.length === 0) throw new Error("no clips were read");
  return seconds;
}

for (let round = 0; round < WARMING; round += 1) await reading();
console.log("ready");
for await (const _ of createInterface({ input: process.stdin })) console.log(await reading());
