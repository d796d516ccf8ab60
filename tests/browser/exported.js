// What is written as glTF, read by others: Khronos' validator finds nothing, and three.js poses as we do. What is written for
// the books of glTF files poses as three.js poses those. Needs no browser.

import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { basename, join } from "node:path";
import { fileURLToPath } from "node:url";
import { test } from "node:test";
import validator from "gltf-validator";
import { AnimationMixer, LoopOnce, Matrix4, Vector3 } from "three";
import { loaded, verticesOf } from "./gltf_files.js";

/** Where the core's tests write models, and the positions of their vertices at some times. */
const WRITTEN = fileURLToPath(new URL("../../target/tmp/exported/", import.meta.url));

/** Where they write glTF files of others, and the positions of vertices in the books' files that were made of them. */
const FOR_BOOK = join(WRITTEN, "book");

/** Of the model's size: three.js adds up in other orders than we do. */
const MOST_APART = 1e-4;

const ERROR = 0;
const WARNING = 1;

const files = readdirSync(WRITTEN).filter((file) => file.endsWith(".glb"));
assert.ok(files.length > 100, "the core's tests have written models");

test("the validator finds no error and no warning", async () => {
  for (const file of files) {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(join(WRITTEN, file))), { maxIssues: 20 });
    const found = report.issues.messages.filter(({ severity }) => severity === ERROR || severity === WARNING);
    const said = found.map(({ code, message, pointer }) => `${code} ${pointer}: ${message}`);
    assert.deepEqual(said, [], file);
  }
});

/**
 * How far vertices of three.js are from ours, at all times of all clips. `vertexAt` writes where a vertex is now, or the first corner of
 * a triangle, into a vector.
 */
function furthestApart(gltf, expected, vertexAt) {
  const mixer = new AnimationMixer(gltf.scene);
  const found = new Vector3();
  let furthest = 0;
  for (const [index, clip] of expected.clips.entries()) {
    mixer.stopAllAction();
    const action = mixer.clipAction(gltf.animations[index]);
    action.clampWhenFinished = true;
    action.setLoop(LoopOnce, 1);
    for (const { time_secs: time, positions } of clip.poses) {
      action.reset().play();
      mixer.setTime(time);
      gltf.scene.updateMatrixWorld(true);
      gltf.scene.traverse((object) => object.skeleton?.update());
      for (const [place, told] of (expected.triangles ?? expected.vertices).entries()) {
        vertexAt(told, found);
        const [x, y, z] = positions[place];
        furthest = Math.max(furthest, Math.hypot(found.x - x, found.y - y, found.z - z));
      }
    }
  }
  return furthest;
}

function namesOf(clips) {
  return clips.map(({ name }) => name);
}

const posesIn = (folder) => readdirSync(folder).filter((file) => file.endsWith(".json"));

for (const file of posesIn(WRITTEN)) {
  const name = basename(file, ".json");
  test(`three.js poses ${name} as we do`, async () => {
    const expected = JSON.parse(readFileSync(join(WRITTEN, file), "utf8"));
    const gltf = await loaded(readFileSync(join(WRITTEN, `${name}.glb`)));
    const meshes = [];
    let bones = 0;
    gltf.scene.traverse((object) => {
      if (object.isMesh) meshes.push(object);
      if (object.isBone) bones += 1;
    });
    const placeOf = (object) => {
      const { meshes, primitives = 0 } = gltf.parser.associations.get(object);
      return [meshes, primitives];
    };
    meshes.sort((a, b) => {
      const [[mesh, part], [otherMesh, otherPart]] = [placeOf(a), placeOf(b)];
      return mesh - otherMesh || part - otherPart;
    });
    assert.ok(bones >= expected.bones, `${bones} bones, ${expected.bones} expected`);
    assert.deepEqual(namesOf(gltf.animations), namesOf(expected.clips));
    assert.ok(expected.triangles.length > 0, "some are compared");
    const furthest = furthestApart(gltf, expected, ([primitive, triangle], found) => {
      const mesh = meshes[primitive];
      mesh.localToWorld(mesh.getVertexPosition(mesh.geometry.index.getX(3 * triangle), found));
    });
    assert.ok(furthest <= MOST_APART * expected.size, `${furthest} apart in a model of ${expected.size}`);
  });
}

for (const file of posesIn(FOR_BOOK)) {
  const name = basename(file, ".json");
  test(`three.js poses ${name} as the file written of it for the books does`, async () => {
    const expected = JSON.parse(readFileSync(join(FOR_BOOK, file), "utf8"));
    const gltf = await loaded(readFileSync(join(FOR_BOOK, `${name}.glb`)));
    assert.deepEqual(namesOf(gltf.animations), namesOf(expected.clips));
    const vertices = verticesOf(gltf);
    const bookFromGltf = new Matrix4().fromArray(expected.book_from_gltf);
    const furthest = furthestApart(gltf, expected, (index, found) => {
      const { object, vertex } = vertices[index];
      object.localToWorld(object.getVertexPosition(vertex, found)).applyMatrix4(bookFromGltf);
    });
    assert.ok(furthest <= MOST_APART * expected.size, `${furthest} apart in a model of ${expected.size}`);
  });
}
