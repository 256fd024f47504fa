// The container of binary glTF 2.0: a header of 12 bytes (magic, version, length), then chunks (length, type, bytes),
// the first JSON, the second binary. All numbers are little-endian.
import { BadFile } from "./bad_file.js";

export interface Glb {
  readonly json: unknown;
  readonly binary: Uint8Array;
}

const kMagic = 0x46546c67;
const kJson = 0x4e4f534a;
const kBinary = 0x004e4942;
const kHeaderBytes = 12;
const kChunkHeaderBytes = 8;

export function parseGlb(bytes: Uint8Array): Glb {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 4 || view.getUint32(0, true) !== kMagic) throw new BadFile("foreign");
  if (bytes.length < kHeaderBytes) throw new BadFile("cut", `${bytes.length} bytes`);
  if (view.getUint32(4, true) !== 2) throw new BadFile("newer", `glTF ${view.getUint32(4, true)}`);
  const length = view.getUint32(8, true);
  if (length > bytes.length) throw new BadFile("cut", `${bytes.length} of ${length} bytes`);
  const chunks = new Map<number, Uint8Array>();
  for (let at = kHeaderBytes; at + kChunkHeaderBytes <= length; ) {
    const size = view.getUint32(at, true);
    const type = view.getUint32(at + 4, true);
    at += kChunkHeaderBytes;
    if (at + size > length) throw new BadFile("damaged", `a chunk of ${size} bytes ends behind the file`);
    if (!chunks.has(type)) chunks.set(type, bytes.subarray(at, at + size));
    at += size;
  }
  const json = chunks.get(kJson);
  if (!json) throw new BadFile("damaged", "no JSON");
  try {
    return {
      json: JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(json)),
      binary: chunks.get(kBinary) ?? new Uint8Array(),
    };
  } catch {
    throw new BadFile("damaged", "its JSON cannot be read");
  }
}
