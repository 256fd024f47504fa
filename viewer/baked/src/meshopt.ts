// EXT_meshopt_compression: buffer views that are compressed are laid, as they were, behind the file's bytes.
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
import { BadFile } from "./bad_file.js";
import type { Compression, Gltf } from "./document.js";

const kAlign = 4;
const kMostBytes = 2 ** 31; // of all that is laid out

export async function expanded(document: Gltf, binary: Uint8Array): Promise<{ document: Gltf; binary: Uint8Array }> {
  const compressed = document.bufferViews.flatMap(({ extensions, byteLength }, at) => {
    const how = extensions.EXT_meshopt_compression;
    return how ? [{ at, how, byteLength }] : [];
  });
  if (compressed.length === 0) return { document, binary };
  await MeshoptDecoder.ready;
  let end = Math.ceil(binary.length / kAlign) * kAlign;
  const places = compressed.map(({ at, how, byteLength }) => {
    if (how.count * how.byteStride !== byteLength || how.byteOffset + how.byteLength > binary.length)
      throw new BadFile("damaged", `bufferViews.${at}: its compressed size`);
    const place = end;
    end = Math.ceil((end + byteLength) / kAlign) * kAlign;
    return place;
  });
  if (end > kMostBytes) throw new BadFile("damaged", "bufferViews: too large");
  const all = new Uint8Array(end);
  all.set(binary);
  const bufferViews = [...document.bufferViews];
  compressed.forEach(({ at, how, byteLength }, i) => {
    const byteOffset = places[i]!;
    decode(at, how, binary, all.subarray(byteOffset, byteOffset + byteLength));
    bufferViews[at] = { ...bufferViews[at]!, byteOffset };
  });
  return { document: { ...document, bufferViews }, binary: all };
}

function decode(at: number, how: Compression, binary: Uint8Array, to: Uint8Array): void {
  const from = binary.subarray(how.byteOffset, how.byteOffset + how.byteLength);
  try {
    MeshoptDecoder.decodeGltfBuffer(to, how.count, how.byteStride, from, how.mode);
  } catch {
    throw new BadFile("damaged", `bufferViews.${at}: cannot be expanded`);
  }
}
