// .glb files in node: read by three.js, and without what three.js needs a browser for.

import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/** A file of these bytes as three.js reads it. */
export function loaded(bytes) {
  return new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), "");
}

/** Its primitives in our order, which is that of the file's meshes and nodes. `shares` is the same for those that share their vertices. */
function primitivesOf({ scene, parser }) {
  const parts = [];
  scene.traverse((object) => {
    if (!object.isMesh) return;
    const { meshes, primitives = 0 } = parser.associations.get(object);
    const { nodes } = { ...parser.associations.get(object.parent), ...parser.associations.get(object) };
    parts.push({ object, order: [meshes, nodes, primitives], shares: JSON.stringify([nodes, parser.json.meshes[meshes].primitives[primitives].attributes]) });
  });
  return parts.sort((a, b) => a.order.map((number, index) => number - b.order[index]).find((apart) => apart !== 0) ?? 0);
}

/** The triangles of a file in our order: the mesh that has each, and the numbers of its corners there. */
export function trianglesOf(gltf) {
  return primitivesOf(gltf).flatMap(({ object: { geometry }, object }) => {
    const count = (geometry.index ?? geometry.attributes.position).count / 3;
    const corner = (place) => geometry.index?.getX(place) ?? place;
    return Array.from({ length: count }, (_, triangle) => ({ object, corners: [0, 1, 2].map((place) => corner(3 * triangle + place)) }));
  });
}

/** Each vertex of a file in our order: the mesh that has it, and its number there. */
export function verticesOf(gltf) {
  const parts = primitivesOf(gltf);
  // Primitives that share their attributes share their vertices.
  const own = parts.filter(({ shares }, index) => parts.findIndex((other) => other.shares === shares) === index);
  return own.flatMap(({ object }) => Array.from({ length: object.geometry.attributes.position.count }, (_, vertex) => ({ object, vertex })));
}

/** The file without pictures, neither in its JSON nor in its data. */
export function withoutPictures(file) {
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
