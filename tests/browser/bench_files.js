// Large models and pictures, made for what bench.js measures.

import { closeSync, openSync, writeFileSync, writeSync } from "node:fs";
import { deflateSync } from "node:zlib";

/** Writes a model as text: squares in rows of vertices, for each material an equal part; bones in a tree; the same number of keys for each. */
export function writeModel(path, { vertices = 2048, materials = 1, bones = 4, keys = 2 }) {
  const file = openSync(path, "w");
  let waiting = [];
  const flush = () => writeSync(file, waiting.splice(0).join(""));
  const write = (text) => waiting.push(text) > 20_000 && flush();
  const columns = 128;
  const rows = Math.max(2, Math.round(vertices / materials / columns));
  const [corners, faces] = [rows * columns, (rows - 1) * (columns - 1) * 2];
  const title = (name) => write(`\n${"*".repeat(15)}${name}${"*".repeat(15)}\n`);
  title("m3d-File-Header");
  write(`#Materials ${materials}\n#Vertices ${corners * materials}\n#Triangles ${faces * materials}\n#Bones ${bones}\n#AnimationClips 1\n`);
  title("Materials");
  for (let of = 0; of < materials; of += 1) {
    write(`Name: m${of}\nDiffuse: 1 1 1\nFresnel0: 0.05 0.05 0.05\nRoughness: 0.5\nAlphaClip: 0\nMaterialTypeName: Skinned\n`);
    write(`DiffuseMap: ${materials > 1 ? `m${of}_diff.dds` : "None"}\nNormalMap: ${materials > 1 ? `m${of}_norm.dds` : "None"}\n\n`);
  }
  title("SubsetTable");
  for (let of = 0; of < materials; of += 1) {
    write(`SubsetID: ${of} VertexStart: ${of * corners} VertexCount: ${corners} FaceStart: ${of * faces} FaceCount: ${faces}\n`);
  }
  title("Vertices");
  for (let vertex = 0; vertex < corners * materials; vertex += 1) {
    const [x, y] = [vertex % columns, Math.floor(vertex / columns)];
    const bone = vertex % bones;
    write(`Position: ${x * 0.25} ${y * 0.25} ${(Math.sin(x * 0.3) * Math.cos(y * 0.2)).toFixed(4)}\nTangent: 1 0 0 1\nNormal: 0 0 -1\n`);
    write(`Tex-Coords: ${(x / 127).toFixed(4)} ${(y / 127).toFixed(4)}\nBlendWeights: 0.7500 0.2500 0 0\nBlendIndices: ${bone} ${(bone + 1) % bones} 0 0\n\n`);
  }
  title("Triangles");
  for (let of = 0; of < materials; of += 1) {
    for (let row = 0; row + 1 < rows; row += 1) {
      for (let column = 0; column + 1 < columns; column += 1) {
        const corner = of * corners + row * columns + column;
        write(`${corner} ${corner + columns} ${corner + 1}\n${corner + 1} ${corner + columns} ${corner + columns + 1}\n`);
      }
    }
  }
  title("BoneOffsets");
  for (let bone = 0; bone < bones; bone += 1) write(`BoneOffset${bone} 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n`);
  title("BoneHierarchy");
  for (let bone = 0; bone < bones; bone += 1) write(`ParentIndexOfBone${bone}: ${bone === 0 ? -1 : (bone - 1) >> 1}\n`);
  title("AnimationClips");
  write("AnimationClip Swing\n{\n");
  for (let bone = 0; bone < bones; bone += 1) {
    write(`\tBone${bone} #Keyframes: ${keys}\n\t{\n`);
    for (let key = 0; key < keys; key += 1) {
      const half = 0.02 * Math.sin(key * 0.1 + bone);
      write(`\t\tTime: ${(key / 30).toFixed(5)} Pos: 0 ${(0.01 * half).toFixed(6)} 0 Scale: 1 1 1 Quat: ${Math.sin(half).toFixed(6)} 0 0 ${Math.cos(half).toFixed(6)}\n`);
    }
    write("\t}\n\n");
  }
  write("}\n");
  flush();
  closeSync(file);
  return path;
}

/** A record of a binary FBX file of 7.4 that begins at a byte: its values, as bytes, and what is in it. */
function record(start, name, values, inner = []) {
  const head = Buffer.alloc(13 + name.length);
  const all = [head, ...values];
  let at = start + all.reduce((sum, { length }) => sum + length, 0);
  for (const make of inner) {
    all.push(make(at));
    at += all.at(-1).length;
  }
  if (inner.length) all.push(Buffer.alloc(13));
  const bytes = Buffer.concat(all);
  [start + bytes.length, values.length, values.reduce((sum, { length }) => sum + length, 0)].forEach((word, place) => head.writeUInt32LE(word, 4 * place));
  head[12] = name.length;
  head.write(name, 13, "latin1");
  head.copy(bytes);
  return bytes;
}

const word = (number) => Buffer.from(Uint32Array.of(number).buffer);
const textOf = (text) => Buffer.concat([Buffer.from("S"), word(text.length), Buffer.from(text, "latin1")]);
const longOf = (number) => Buffer.concat([Buffer.from("L"), Buffer.from(BigInt64Array.of(BigInt(number)).buffer)]);
const intOf = (number) => Buffer.concat([Buffer.from("I"), word(number)]);

function arrayOf(kind, numbers) {
  const packed = deflateSync(Buffer.from(numbers.buffer), { level: 1 });
  return Buffer.concat([Buffer.from(kind), word(numbers.length), word(1), word(packed.length), packed]);
}

/** Writes a hilly sheet as a binary FBX file of about 20 MB: quads with a normal at each corner and indexed texture coordinates. */
export function writeSheet(path, side = 520) {
  const points = (side + 1) ** 2;
  const [positions, uv] = [new Float64Array(3 * points), new Float64Array(2 * points)];
  const height = (x, y) => Math.sin(x * 0.11) * Math.cos(y * 0.07) * 5;
  for (let at = 0; at < points; at += 1) {
    const [x, y] = [at % (side + 1), Math.floor(at / (side + 1))];
    positions.set([x, y, height(x, y)], 3 * at);
    uv.set([x / side, y / side], 2 * at);
  }
  const count = 4 * side * side;
  const [corners, ends, normals] = [new Int32Array(count), new Int32Array(count), new Float64Array(3 * count)];
  for (let quad = 0; quad < side * side; quad += 1) {
    const at = Math.floor(quad / side) * (side + 1) + (quad % side);
    corners.set([at, at + 1, at + side + 2, at + side + 1], 4 * quad);
  }
  corners.forEach((at, corner) => {
    ends[corner] = corner % 4 === 3 ? ~at : at;
    const [x, y] = [at % (side + 1), Math.floor(at / (side + 1))];
    const slopes = [height(x + 0.01, y) - height(x - 0.01, y), height(x, y + 0.01) - height(x, y - 0.01)];
    const length = Math.hypot(...slopes, 0.02);
    normals.set([-slopes[0] / length, -slopes[1] / length, 0.02 / length], 3 * corner);
  });
  const make = (name, values, inner) => (start) => record(start, name, values, inner);
  const layer = (name, reference, arrays) =>
    make(name, [intOf(0)], [
      make("MappingInformationType", [textOf("ByPolygonVertex")]),
      make("ReferenceInformationType", [textOf(reference)]),
      ...arrays.map(([array, bytes]) => make(array, [bytes])),
    ]);
  const geometry = make("Geometry", [longOf(1), textOf("Sheet\0\x01Geometry"), textOf("Mesh")], [
    make("Vertices", [arrayOf("d", positions)]),
    make("PolygonVertexIndex", [arrayOf("i", ends)]),
    layer("LayerElementNormal", "Direct", [["Normals", arrayOf("d", normals)]]),
    layer("LayerElementUV", "IndexToDirect", [["UV", arrayOf("d", uv)], ["UVIndex", arrayOf("i", corners)]]),
  ]);
  const model = make("Model", [longOf(2), textOf("Sheet\0\x01Model"), textOf("Mesh")]);
  const connect = (child, parent) => make("C", [textOf("OO"), longOf(child), longOf(parent)]);
  const parts = [Buffer.from("Kaydara FBX Binary  \0\x1a\0\xe8\x1c\0\0", "latin1")];
  for (const top of [make("Objects", [], [geometry, model]), make("Connections", [], [connect(1, 2), connect(2, 0)])]) {
    parts.push(top(parts.reduce((sum, { length }) => sum + length, 0)));
  }
  // Some readers stop where the foot of a file would be, so long is it.
  writeFileSync(path, Buffer.concat([...parts, Buffer.alloc(13), Buffer.alloc(192)]));
  return path;
}

/** A picture that is no noise and no single colour, as a browser writes it. */
export async function paint(page, type, seed) {
  const text = await page.evaluate(async ([type, seed]) => {
    const canvas = new OffscreenCanvas(2048, 2048);
    const context = canvas.getContext("2d");
    const next = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
    for (let spot = 0; spot < 6000; spot += 1) {
      context.fillStyle = `hsl(${next() * 360} 60% ${next() * 100}% / 0.5)`;
      context.beginPath();
      context.arc(next() * 2048, next() * 2048, next() * 90, 0, 7);
      context.fill();
    }
    const bytes = new Uint8Array(await (await canvas.convertToBlob({ type, quality: 0.9 })).arrayBuffer());
    let text = "";
    for (let from = 0; from < bytes.length; from += 32768) text += String.fromCharCode(...bytes.subarray(from, from + 32768));
    return btoa(text);
  }, [type, seed]);
  return Buffer.from(text, "base64");
}
