// What is written as glTF, read by others: Khronos' validator finds nothing, and three.js poses as we do. Needs no browser.

import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { basename, join } from "node:path";
import { fileURLToPath } from "node:url";
import { test } from "node:test";
import validator from "gltf-validator";
import { AnimationMixer, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/** Where the core's tests write models, and the positions of their vertices at some times. */
const WRITTEN = fileURLToPath(new URL("../../target/tmp/exported/", import.meta.url));

/** Of the model's size: three.js adds up in other orders than we do. */
const MOST_APART = 1e-4;

const ERROR = 0;
const WARNING = 1;

const files = readdirSync(WRITTEN).filter((file) => file.endsWith(".glb"));
assert.ok(files.length > 60, "the core's tests have written models");

test("the validator finds no error and no warning", async () => {
  for (const file of files) {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(join(WRITTEN, file))), { maxIssues: 20 });
    const found = report.issues.messages.filter(({ severity }) => severity === ERROR || severity === WARNING);
    const said = found.map(({ code, message, pointer }) => `${code} ${pointer}: ${message}`);
    assert.deepEqual(said, [], file);
  }
});

for (const file of readdirSync(WRITTEN).filter((file) => file.endsWith(".json"))) {
  const name = basename(file, ".json");
  test(`three.js poses ${name} as we do`, async () => {
    const expected = JSON.parse(readFileSync(join(WRITTEN, file), "utf8"));
    const bytes = readFileSync(join(WRITTEN, `${name}.glb`));
    const gltf = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), "");
    const meshes = [];
    let bones = 0;
    gltf.scene.traverse((object) => {
      if (object.isMesh) meshes.push(object);
      if (object.isBone) bones += 1;
    });
    assert.ok(bones >= expected.bones, `${bones} bones, ${expected.bones} expected`);
    assert.deepEqual(
      gltf.animations.map((clip) => clip.name),
      expected.clips.map((clip) => clip.name),
    );
    // All primitives have all vertices.
    const mesh = meshes[0];
    const mixer = new AnimationMixer(gltf.scene);
    const found = new Vector3();
    let furthest = 0;
    for (const [index, clip] of expected.clips.entries()) {
      mixer.stopAllAction();
      const action = mixer.clipAction(gltf.animations[index]);
      action.clampWhenFinished = true;
      action.setLoop(2200, 1);
      for (const { time_secs: time, positions } of clip.poses) {
        action.reset().play();
        mixer.setTime(time);
        gltf.scene.updateMatrixWorld(true);
        mesh.skeleton?.update();
        for (const [place, vertex] of expected.vertices.entries()) {
          mesh.getVertexPosition(vertex, found);
          mesh.localToWorld(found);
          const [x, y, z] = positions[place];
          furthest = Math.max(furthest, Math.hypot(found.x - x, found.y - y, found.z - z));
        }
      }
    }
    assert.ok(furthest <= MOST_APART * expected.size, `${furthest} apart in a model of ${expected.size}`);
  });
}
