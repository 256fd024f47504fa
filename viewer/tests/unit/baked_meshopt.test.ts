import assert from "node:assert/strict";
import { test } from "node:test";
import { BadFile } from "../../baked/src/bad_file.js";
import { checkDocument } from "../../baked/src/document.js";
import { readGeometry } from "../../baked/src/geometry.js";
import { parseGlb } from "../../baked/src/glb.js";
import { expanded } from "../../baked/src/meshopt.js";
import { bakedHome } from "../double/baked_home.js";
import { nearAll } from "./near.js";

// Four corners of 3 unsigned shorts in 8 bytes, (0, 0, 0), (1000, 0, 0), (1000, 65535, 0), (0, 65535, 7), and two
// triangles, written by meshoptimizer 0.18.
const kCorners = Buffer.from(
  "a001330000002f30013300000006050104000000010400000001030000000e00000000000000000000000000000000000000" +
    "00000000000000000000000000000000",
  "hex",
);
const kTriangles = Buffer.from("e0f000007687566778a9866589689801690000", "hex");

type Json = Record<string, unknown>;

function home(change: (views: Json[]) => void = () => {}) {
  const { json } = parseGlb(bakedHome());
  const binary = new Uint8Array([...kCorners, ...kTriangles]);
  const view = (from: number, packed: number, plain: number, byteStride: number, mode: string): Json => ({
    buffer: 1,
    byteOffset: 0,
    byteLength: plain,
    byteStride,
    extensions: {
      EXT_meshopt_compression: {
        buffer: 0,
        byteOffset: from,
        byteLength: packed,
        byteStride,
        mode,
        count: plain / byteStride,
      },
    },
  });
  const bufferViews = [
    view(0, kCorners.length, 32, 8, "ATTRIBUTES"),
    view(kCorners.length, kTriangles.length, 24, 4, "TRIANGLES"),
  ];
  change(bufferViews);
  const document = checkDocument({
    ...(json as Json),
    bufferViews,
    accessors: [
      { bufferView: 0, componentType: 5123, count: 4, type: "VEC3" },
      { bufferView: 1, componentType: 5125, count: 6, type: "SCALAR" },
    ],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    nodes: [{ mesh: 0, translation: [-1, 0, 2], scale: [0.001, 0.001, 0.001] }],
  });
  return { document, binary };
}

test("compressed geometry is expanded, and its steps are metres", async () => {
  const { document, binary } = home();
  const plain = await expanded(document, binary);
  const geometry = readGeometry(plain.document, plain.binary);
  nearAll([...geometry.positions], [-1, 0, 2, 0, 0, 2, 0, 65.535, 2, -1, 65.535, 2.007], 1e-5);
  assert.deepEqual([...geometry.index], [0, 1, 2, 0, 2, 3]);
});

test("a file without compressed views stays as it is", async () => {
  const { json, binary } = parseGlb(bakedHome());
  const document = checkDocument(json);
  assert.equal((await expanded(document, binary)).binary, binary);
});

test("damaged compression is one fault", async () => {
  const damaged = (error: unknown) => error instanceof BadFile && error.fault === "damaged";
  for (const change of [{ byteLength: 400 }, { count: 9 }, { byteLength: 20 }, { byteOffset: 1000 }]) {
    const { document, binary } = home(views => {
      const extensions = views[0]!.extensions as { EXT_meshopt_compression: Json };
      Object.assign(extensions.EXT_meshopt_compression, change);
    });
    await assert.rejects(expanded(document, binary), damaged, JSON.stringify(change));
  }
});
