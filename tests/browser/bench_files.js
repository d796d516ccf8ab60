// Large models and pictures, made for what bench.js measures.

import { closeSync, openSync, writeSync } from "node:fs";

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
