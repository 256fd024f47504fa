// A frame as it comes over the line: a header of 64 bytes, little-endian, then a JPEG
// (docs/reference/view-protocol.md, "Frames").
import { BadMessage } from "./schema.js";

export const kFrameHeaderBytes = 64;

export type FrameSide = "whole" | "left" | "right";

export interface FrameHeader {
  readonly number: number;
  readonly width: number;
  readonly height: number;
  readonly side: FrameSide;
  readonly quick: boolean; // reduced size, right after an input
  readonly settled: boolean; // none better follows until something changes
  readonly lightBehind: boolean; // its light does not yet follow the newest state
  readonly falseColor: boolean;
  readonly refining: boolean;
  readonly camera: number; // number of the camera message that it shows, 0 without
  readonly revision: number;
  readonly samples: number; // a pixel
  readonly samplesInAll: number | null; // with which this stage of refinement ends
  readonly relativeError: number | null;
  readonly ev100: number | null;
  readonly scale: readonly [number, number] | null; // ends of the false-colour scale, lx or cd/m²
  readonly latencyMs: number | null;
  readonly pictureMs: number | null;
  readonly whiteK: number | null;
}

const kSides: readonly FrameSide[] = ["whole", "left", "right"];

function known(value: number): number | null {
  return Number.isFinite(value) ? value : null;
}

export function decodeFrame(data: ArrayBuffer): { header: FrameHeader; picture: Uint8Array } {
  if (data.byteLength <= kFrameHeaderBytes) throw new BadMessage(`frame: ${data.byteLength} bytes are too few for one`);
  const view = new DataView(data);
  if (view.getUint8(0) !== 1) throw new BadMessage(`frame: unknown kind ${view.getUint8(0)}`);
  if (view.getUint8(1) !== 1) throw new BadMessage(`frame: unknown version ${view.getUint8(1)} of the header`);
  const begin = view.getUint16(2, true);
  if (begin < kFrameHeaderBytes || begin >= data.byteLength) throw new BadMessage(`frame: a header of ${begin} bytes`);
  const side = kSides[view.getUint8(12)];
  if (!side) throw new BadMessage(`frame: unknown side ${view.getUint8(12)}`);
  const width = view.getUint16(8, true);
  const height = view.getUint16(10, true);
  if (width === 0 || height === 0) throw new BadMessage("frame: an empty picture");
  const flags = view.getUint8(13);
  const low = known(view.getFloat32(36, true));
  const high = known(view.getFloat32(40, true));
  const header: FrameHeader = {
    number: view.getUint32(4, true),
    width,
    height,
    side,
    quick: (flags & 1) !== 0,
    settled: (flags & 2) !== 0,
    lightBehind: (flags & 4) !== 0,
    falseColor: (flags & 8) !== 0,
    refining: (flags & 16) !== 0,
    camera: view.getUint32(16, true),
    revision: view.getUint32(20, true),
    samples: view.getUint32(24, true),
    samplesInAll: view.getUint32(56, true) || null,
    relativeError: known(view.getFloat32(28, true)),
    ev100: known(view.getFloat32(32, true)),
    scale: low !== null && high !== null && low > 0 && high > low ? [low, high] : null,
    latencyMs: known(view.getFloat32(44, true)),
    pictureMs: known(view.getFloat32(48, true)),
    whiteK: known(view.getFloat32(52, true)),
  };
  return { header, picture: new Uint8Array(data, begin) };
}
