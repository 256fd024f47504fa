import assert from "node:assert/strict";
import { deflateSync } from "node:zlib";
import { test } from "node:test";
import { BadFile } from "../../baked/src/bad_file.js";
import { checkDocument, viewBytes } from "../../baked/src/document.js";
import { readGeometry } from "../../baked/src/geometry.js";
import { parseGlb } from "../../baked/src/glb.js";
import { bytesOf } from "../../baked/src/page_text.js";
import { decodeTexel, encodeTexel, inflate, timesLuminance, unpackTexels } from "../../baked/src/texels.js";
import type { Vec3 } from "../../src/vector.js";
import { bakedHome, glb, kLampLux } from "../double/baked_home.js";
import { packTexels } from "../double/pack_texels.js";
import { textOf } from "../double/page_text.js";
import { near, nearAll } from "./near.js";

const isFault = (fault: string) => (error: unknown) => error instanceof BadFile && error.fault === fault;
const read = (bytes: Uint8Array) => {
  const { json, binary } = parseGlb(bytes);
  return { document: checkDocument(json), binary };
};
const changed = (change: (json: Record<string, never>) => void): Uint8Array => {
  const { json, binary } = parseGlb(bakedHome());
  change(json as Record<string, never>);
  return glb(json as object, binary);
};

test("values of RGB9_E5 come back within half a step", () => {
  for (const value of [
    [0, 0, 0],
    [1, 2, 4],
    [65408, 1, 0],
    [0.001, 0.002, 0.0005],
    [511.4, 3, 0.2],
    [1e-5, 0, 0],
  ] as Vec3[]) {
    const top = Math.max(...value);
    const step = Math.max(2 ** -24, 2 ** (Math.floor(Math.log2(Math.max(top, 1e-9))) - 8));
    nearAll(decodeTexel(encodeTexel(value)), value, step / 2 + 1e-12);
  }
  nearAll(decodeTexel((24 << 27) | (3 << 18) | (2 << 9) | 1), [1, 2, 3]);
});

test("texels come back from what differs from predictions", () => {
  const [width, height] = [7, 5];
  let seed = 1;
  const random = () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0);
  const texels = Uint32Array.from({ length: 4 * width * height }, (_, i) => {
    const tile = Math.floor(i / (width * height));
    if (tile === 0) return encodeTexel([2 ** (i % width), 0.7 * 2 ** (i % width), 0.2 * i]);
    return tile === 1 ? random() : i % 3 ? 0xffffffff : i % 2;
  });
  assert.deepEqual([...unpackTexels(packTexels(texels, width, height), width, height)], [...texels]);
  assert.equal(unpackTexels(packTexels(texels, width, height), width, height, 200)[199], 0);
});

test("a stream of the wrong length or a damaged one is a fault", async () => {
  const data = Uint8Array.from({ length: 5000 }, (_, i) => (i * 7919) & 255);
  const packed = new Uint8Array(deflateSync(data));
  assert.deepEqual(await inflate(packed, 5000, "x"), data);
  await assert.rejects(inflate(packed, 5001, "x"), isFault("damaged"));
  await assert.rejects(inflate(packed, 4000, "x"), isFault("damaged"));
  await assert.rejects(inflate(packed.subarray(0, 50), 5000, "x"), isFault("damaged"));
  await assert.rejects(inflate(data, 5000, "x"), isFault("damaged"));
});

test("a baked home is read: its layers, rooms, cameras and light", async () => {
  const { document, binary } = read(bakedHome());
  const home = document.extensions.ROOMLIGHT_light_layers;
  assert.deepEqual(
    home.layers.map(l => [l.kind, l.on, l.hour]),
    [
      ["lamp", true, undefined],
      ["lamp", false, undefined],
      ["sun", false, 12],
      ["sky", false, 12],
      ["sun", false, 18],
      ["sky", false, 18],
    ],
  );
  const { light } = home.layers[1]!;
  const size = 4 * home.atlas.tile ** 2 * light.tiles.length;
  const planes = await inflate(viewBytes(document, binary, light.bufferView), size, "light");
  const texels = unpackTexels(planes, home.atlas.tile, home.atlas.tile);
  nearAll(decodeTexel(texels[5000]!).map(c => c * light.scale) as unknown as Vec3, kLampLux[1]!, 1e-6);
});

test("materials without textures share one list of triangles", () => {
  const { document, binary } = read(bakedHome({ vertexLit: true, glossy: true }));
  const geometry = readGeometry(document, binary);
  assert.equal(geometry.batches.length, 1);
  assert.equal(geometry.index.length, 36);
  assert.equal(geometry.positions.length, 2 * 24 * 3);
  assert.deepEqual([...geometry.tags.subarray(0, 2)], [1, 1]);
  assert.deepEqual([...geometry.tags.subarray(48, 50)], [0, 1]);
  assert.deepEqual([...geometry.normals.subarray(0, 4)], [0, 127, 0, 0]);
});

test("many textures of base colours share one list, and few keep their own", () => {
  type Json = { materials: object[]; textures: object[]; images: object[]; meshes: { primitives: object[] }[] };
  const textured = (count: number) => {
    const { document, binary } = read(
      changed(given => {
        const json = given as unknown as Json;
        const numbers = Array.from({ length: count }, (_, i) => i);
        const [primitive] = json.meshes[0]!.primitives;
        json.materials = numbers.map(i => ({ pbrMetallicRoughness: { baseColorTexture: { index: i } } }));
        json.textures = numbers.map(i => ({ source: i }));
        json.images = numbers.map(() => ({ bufferView: 0, mimeType: "image/png" }));
        json.meshes[0]!.primitives = numbers.map(i => ({ ...primitive, material: i }));
      }),
    );
    return readGeometry(document, binary);
  };
  const few = textured(5);
  assert.deepEqual([few.batches.length, few.packed.length], [5, 0]);
  const many = textured(150);
  assert.deepEqual([many.batches.length, many.packed.length, many.batches[0]!.maps.base], [1, 150, -1]);
});

test("files that are cut, damaged, foreign or newer say so", () => {
  const whole = bakedHome();
  assert.throws(() => parseGlb(whole.subarray(0, whole.length - 1000)), isFault("cut"));
  assert.throws(() => parseGlb(whole.subarray(0, 9)), isFault("cut"));
  assert.throws(() => parseGlb(new Uint8Array()), isFault("foreign"));
  assert.throws(() => parseGlb(new TextEncoder().encode("<!doctype html><html>")), isFault("foreign"));
  const broken = whole.slice();
  broken.fill(0xff, 20, 60);
  assert.throws(() => parseGlb(broken), isFault("damaged"));
  assert.throws(() => read(glb({ asset: {} }, new Uint8Array())), isFault("foreign"));
  type Json = { extensions: { ROOMLIGHT_light_layers: { version: number; layers: { light: { tiles: number[] } }[] } } };
  const edit = (change: (json: Json) => void) => changed(json => change(json as unknown as Json));
  assert.throws(() => read(edit(j => (j.extensions.ROOMLIGHT_light_layers.version = 5))), isFault("newer"));
  assert.throws(
    () => read(edit(j => (j.extensions.ROOMLIGHT_light_layers.layers[0]!.light.tiles = [8]))),
    error => {
      assert.ok(error instanceof BadFile);
      assert.match(error.message, /^layers\.0\.light\.tiles/);
      return true;
    },
  );
});

test("indices and views beyond what is there are faults", () => {
  type Json = { accessors: { count: number }[]; bufferViews: { byteLength: number }[] };
  const edit = (change: (json: Json) => void) => {
    const { document, binary } = read(changed(json => change(json as unknown as Json)));
    return () => readGeometry(document, binary);
  };
  assert.throws(
    edit(j => (j.accessors[0]!.count = 1000)),
    isFault("damaged"),
  );
  assert.throws(
    edit(j => (j.bufferViews[1]!.byteLength = 1e9)),
    isFault("damaged"),
  );
  assert.throws(
    edit(j => (j.accessors[5]!.count = 300)),
    isFault("damaged"),
  );
});

test("shares of light become light in the tiles that have some", () => {
  const share = encodeTexel([0.75, 0.3, 511 / 512]);
  const light: Vec3[] = [
    [300, 200, 100],
    [0.5, 0.75, 0.1],
  ];
  const shares = Uint32Array.of(share, share, share, 0);
  timesLuminance(shares, [2, 5], Uint32Array.from([...light, ...light].map(encodeTexel)), [1, 2], 2);
  light.forEach(([r, g, b], i) => {
    const even = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    const [u, v, whole] = decodeTexel(shares[i]!);
    near(whole / even, 1, 0.01);
    near(u / whole, (0.75 * 512) / 511, 0.01);
    near(v / whole, (0.3 * 512) / 511, 0.01);
  });
  assert.deepEqual([...shares.slice(2)], [0, 0]); // tile 5 has no light
});

test("text of a page gives its bytes, and what is none is a fault", () => {
  const bytes = Uint8Array.from({ length: 1000 }, (_, i) => (i * i) & 255);
  for (const length of [0, 1, 2, 5, 6, 7, 999, 1000]) {
    const part = bytes.slice(0, length);
    assert.deepEqual(bytesOf(textOf(part)), part);
  }
  assert.deepEqual(bytesOf("\x03\x06"), Uint8Array.of(255)); // 2 x 125 + 5
  assert.deepEqual(bytesOf("\x01\x01\x01\x01\x01\x01\x7f"), Uint8Array.of(0, 0, 0, 0, 0, 124));
  for (const text of ["ab\r", "a<", "a\0", "\ufffda"]) assert.throws(() => bytesOf(text), isFault("damaged"));
  assert.throws(() => bytesOf("\x03\x07"), isFault("damaged")); // 256 is no byte
  assert.throws(() => bytesOf("abcdefgh"), isFault("cut"));
});

test("the image of a texture may be WebP, in its extension", () => {
  const { document } = read(
    changed(json =>
      Object.assign(json, {
        textures: [{ sampler: 0, extensions: { EXT_texture_webp: { source: 1 } } }, { source: 0 }],
        samplers: [{}],
        images: [0, 1].map(() => ({ bufferView: 0, mimeType: "image/webp" })),
      }),
    ),
  );
  assert.deepEqual(
    document.textures.map(t => t.source),
    [1, 0],
  );
});
