// A small baked home as roomlight bake writes it: a white box room with two lamps, and sun and sky of two hours. Every
// layer has the same illuminance everywhere, so that what is seen can be reckoned by hand.
import { deflateSync } from "node:zlib";
import { encodeTexel } from "../../baked/src/texels.js";
import { packTexels } from "./pack_texels.js";
import type { Vec3 } from "../../src/vector.js";
import { encodePng } from "./png.js";

export const kRoom = { width: 4, depth: 5, height: 2.6 } as const; // x, z, y from the origin, m
export const kAlbedo = 0.5;
export const kLampLux: readonly Vec3[] = [
  [180, 180, 180],
  [120, 90, 45],
];
export const kSunLux: readonly Vec3[] = [
  [400, 380, 350],
  [100, 60, 30],
];
export const kSkyLux: readonly Vec3[] = [
  [80, 90, 120],
  [30, 40, 80],
];
// Straight from the suns, from above, on the half of the floor where x is smaller.
export const kStraightLux: Vec3 = [600, 540, 480];
export const kHours = [12, 18] as const;
export const kEv100 = 6;
const kTile = 32;
const kFine = 2;
const kAtlas = { width: 128, height: 64, tile: kTile } as const;
const kScale = 1 / 64; // a power of two, so that the lamps' values are kept exactly

interface Options {
  readonly vertexLit?: boolean;
  readonly lamps?: boolean;
  readonly glossy?: boolean; // a mirror of metal for a floor
  readonly shelf?: boolean; // over the floor, with five times the light: hides the foot of the wall from the middle
  readonly glassShelf?: Vec3; // a shelf that passes so much of what is behind it
  readonly brightWall?: boolean; // the one at z = 0 has five times the light
  readonly display?: {
    readonly ev100: number;
    readonly tone: string;
    readonly whiteGains: Vec3;
    readonly whites?: readonly { readonly light: Vec3; readonly shown: Vec3 }[];
  };
  readonly sunPatch?: boolean; // suns also shine straight onto half of the floor
  readonly floorNormal?: Vec3; // of a normal map: x along x, y along z
  readonly floorLean?: readonly [number, number]; // of lamps' light: along x and against z, over illuminance
}

// Six faces seen from inside, each with one tile of the atlas.
function box(shelf: boolean) {
  const { width: w, height: h, depth: d } = kRoom;
  const faces: [Vec3, Vec3, Vec3, Vec3][] = [
    [
      [0, 0, d],
      [w, 0, 0],
      [0, 0, -d],
      [0, 1, 0],
    ],
    [
      [0, h, 0],
      [w, 0, 0],
      [0, 0, d],
      [0, -1, 0],
    ],
    [
      [0, 0, 0],
      [w, 0, 0],
      [0, h, 0],
      [0, 0, 1],
    ],
    [
      [w, 0, d],
      [-w, 0, 0],
      [0, h, 0],
      [0, 0, -1],
    ],
    [
      [0, 0, d],
      [0, 0, -d],
      [0, h, 0],
      [1, 0, 0],
    ],
    [
      [w, 0, 0],
      [0, 0, d],
      [0, h, 0],
      [-1, 0, 0],
    ],
  ];
  if (shelf)
    faces.push([
      [1, 0.75, 1.8],
      [2, 0, 0],
      [0, 0, -1],
      [0, 1, 0],
    ]);
  const positions: number[] = [];
  const normals: number[] = [];
  const lightUvs: number[] = [];
  const uvs: number[] = [];
  const index: number[] = [];
  faces.forEach(([origin, u, v, n], face) => {
    const [column, row] = [face % 4, Math.floor(face / 4)];
    for (const [s, t] of [
      [0, 0],
      [1, 0],
      [1, 1],
      [0, 1],
    ] as const) {
      positions.push(...origin.map((o, i) => o + s * u[i]! + t * v[i]!));
      normals.push(...n.map(c => 127 * c), 0);
      uvs.push(s, t);
      const texel = (first: number, share: number, size: number) =>
        Math.round((65535 * (first * kTile + 2.5 + share * (kTile - 5))) / size);
      lightUvs.push(texel(column, s, kAtlas.width), texel(row, t, kAtlas.height));
    }
    index.push(...[0, 1, 2, 0, 2, 3].map(i => 4 * face + i));
  });
  return { positions, normals, lightUvs, uvs, index };
}

class Binary {
  private readonly parts: Uint8Array[] = [];
  private size = 0;
  readonly views: { buffer: number; byteOffset: number; byteLength: number; byteStride?: number }[] = [];

  add(data: ArrayBufferView, byteStride?: number): number {
    const bytes = new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
    this.views.push({
      buffer: 0,
      byteOffset: this.size,
      byteLength: bytes.length,
      ...(byteStride ? { byteStride } : {}),
    });
    const padded = new Uint8Array(Math.ceil(bytes.length / 4) * 4);
    padded.set(bytes);
    this.parts.push(padded);
    this.size += padded.length;
    return this.views.length - 1;
  }
  bytes(): Uint8Array {
    return Buffer.concat(this.parts);
  }
}

const texels = (
  lux: Vec3,
  [width, height, tiles]: Vec3,
  scale: number,
  bright?: readonly [number, number],
): Uint8Array => {
  const count = width * height * tiles;
  const encoded = (times: number) => encodeTexel(lux.map(c => (times * c) / scale) as unknown as Vec3);
  const all = new Uint32Array(count).fill(encoded(1));
  return deflateSync(packTexels(bright ? all.fill(encoded(5), ...bright) : all, width, height));
};

// Cells of one tile, as differences along rows: 255 in the left half, then 0.
function halfLit(): Uint8Array {
  const edge = kFine * kTile;
  return deflateSync(
    Uint8Array.from({ length: edge ** 2 }, (_, i) => (i % edge === 0 ? 255 : i % edge === edge / 2 ? 1 : 0)),
  );
}

function normalPng(normal: Vec3): Uint8Array {
  const size = 4;
  const pixel = normal.map(c => Math.round(127.5 + 127.5 * c));
  return encodePng(
    Uint8Array.from({ length: 3 * size ** 2 }, (_, i) => pixel[i % 3]!),
    size,
    size,
  );
}

function chunk(type: number, data: Uint8Array, fill: number): Buffer {
  const out = Buffer.alloc(8 + Math.ceil(data.length / 4) * 4, fill);
  out.writeUInt32LE(out.length - 8, 0);
  out.writeUInt32LE(type, 4);
  out.set(data, 8);
  return out;
}

export function glb(json: object, binary: Uint8Array): Uint8Array {
  const body = [chunk(0x4e4f534a, Buffer.from(JSON.stringify(json)), 0x20), chunk(0x004e4942, binary, 0)];
  const head = Buffer.alloc(12);
  head.writeUInt32LE(0x46546c67, 0);
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + body[0]!.length + body[1]!.length, 8);
  return new Uint8Array(Buffer.concat([head, ...body]));
}

export function bakedHome(options: Options = {}): Uint8Array {
  const {
    vertexLit = false,
    lamps = true,
    glossy = false,
    glassShelf,
    shelf = glassShelf !== undefined,
    brightWall = false,
    sunPatch = false,
    floorNormal,
    floorLean,
  } = options;
  const binary = new Binary();
  const { positions, normals, lightUvs, uvs, index } = box(shelf);
  const count = positions.length / 3;
  const lit = new Uint8Array(4 * count);
  for (let i = 0; i < count; ++i) lit[4 * i] = vertexLit ? 1 : 0;
  const tiles = shelf ? [0, 1, 2, 3, 4, 5, 6] : [0, 1, 2, 3, 4, 5];
  const brightTile = brightWall ? 2 : shelf ? 6 : null;
  const bright = brightTile === null ? undefined : ([brightTile * kTile ** 2, (brightTile + 1) * kTile ** 2] as const);
  const light = (lux: Vec3) => ({
    bufferView: binary.add(texels(lux, [kTile, kTile, tiles.length], kScale, bright)),
    scale: kScale,
    tiles,
  });
  const lean = () => {
    if (!floorLean) return {};
    const [u, v] = floorLean;
    const share: Vec3 = [0.5 + u / 4, 0.5 + v / 4, 1];
    return { lean: { bufferView: binary.add(texels(share, [kTile, kTile, 1], 1)), scale: 1, tiles: [0] } };
  };
  const lamp = (lux: Vec3) => ({ kind: "lamp", room: "Kitchen", light: light(lux), ...lean() });
  const sun = {
    sun: {
      direction: [0, 1, 0],
      lux: kStraightLux,
      halfAngleDeg: 0.27,
      mask: { bufferView: sunPatch ? binary.add(halfLit()) : 0, fine: kFine, channels: 1, tiles: [0] },
    },
  };
  const glass = glassShelf && {
    pbrMetallicRoughness: { baseColorFactor: [...glassShelf, 1], metallicFactor: 0, roughnessFactor: 0 },
    extensions: {
      KHR_materials_transmission: { transmissionFactor: 1 },
      KHR_materials_specular: { specularFactor: 0 },
    },
  };
  const rest = index.slice(6, glass ? -6 : undefined);
  const accessor = (bufferView: number, componentType: number, type: string, normalized = false, n = count) => ({
    bufferView,
    componentType,
    type,
    count: n,
    ...(normalized ? { normalized } : {}),
  });
  const accessors = [
    accessor(binary.add(Float32Array.from(positions)), 5126, "VEC3"),
    accessor(binary.add(Int8Array.from(normals), 4), 5120, "VEC3", true),
    accessor(binary.add(Uint16Array.from(lightUvs)), 5123, "VEC2", true),
    accessor(binary.add(lit, 4), 5121, "SCALAR"),
    accessor(binary.add(Uint16Array.from(index.slice(0, 6))), 5123, "SCALAR", false, 6),
    accessor(binary.add(Uint16Array.from(rest)), 5123, "SCALAR", false, rest.length),
    accessor(binary.add(Float32Array.from(uvs)), 5126, "VEC2"),
    ...(glass ? [accessor(binary.add(Uint16Array.from(index.slice(-6))), 5123, "SCALAR", false, 6)] : []),
  ];
  const layers = [
    ...(lamps
      ? [
          { name: "Pendant", on: true, kelvin: 4000, ...lamp(kLampLux[0]!) },
          { name: "Strip", on: false, kelvin: 2700, ...lamp(kLampLux[1]!) },
        ]
      : []),
    ...kHours.flatMap((hour, i) => [
      { name: `Sun, ${hour}:00`, kind: "sun", hour, on: false, light: light(kSunLux[i]!), ...(sunPatch ? sun : {}) },
      {
        name: `Sky, ${hour}:00`,
        kind: "sky",
        hour,
        on: false,
        light: light(kSkyLux[i]!),
        panorama: {
          bufferView: binary.add(texels([900, 1000, 1200], [32, 16, 1], 1)),
          width: 32,
          height: 16,
          scale: 1,
        },
      },
    ]),
  ];
  const attributes = {
    POSITION: 0,
    NORMAL: 1,
    TEXCOORD_1: 2,
    _VERTEX_LIT: 3,
    ...(floorNormal ? { TEXCOORD_0: 6 } : {}),
  };
  const matt = {
    pbrMetallicRoughness: { baseColorFactor: [kAlbedo, kAlbedo, kAlbedo, 1], metallicFactor: 0, roughnessFactor: 1 },
    extensions: { KHR_materials_specular: { specularFactor: 0 } },
  };
  const mirror = {
    pbrMetallicRoughness: { baseColorFactor: [0.9, 0.9, 0.9, 1], metallicFactor: 1, roughnessFactor: 0.05 },
  };
  const bumpy = { ...matt, normalTexture: { index: 0 } };
  const normalMap = floorNormal && {
    textures: [{ source: 0 }],
    images: [{ mimeType: "image/png", bufferView: binary.add(normalPng(floorNormal)) }],
  };
  const json = {
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [
      {
        primitives: [
          { attributes, indices: 4, material: glossy ? 1 : floorNormal ? 2 : 0 },
          { attributes, indices: 5, material: 0 },
          ...(glass ? [{ attributes, indices: 7, material: floorNormal ? 3 : 2 }] : []),
        ],
      },
    ],
    materials: [matt, mirror, ...(floorNormal ? [bumpy] : []), ...(glass ? [glass] : [])],
    ...normalMap,
    accessors,
    bufferViews: binary.views,
    buffers: [{ byteLength: binary.bytes().length }],
    extensionsUsed: ["ROOMLIGHT_light_layers", "KHR_materials_specular"],
    extensions: {
      ROOMLIGHT_light_layers: {
        version: 4,
        atlas: kAtlas,
        layers,
        hour: 12,
        rooms: [
          {
            name: "Kitchen",
            floor: [
              [0, 0],
              [kRoom.width, 0],
              [kRoom.width, kRoom.depth],
              [0, kRoom.depth],
            ],
            elevationM: 0,
            heightM: kRoom.height,
          },
        ],
        cameras: [{ name: "Door", position: [2, 1.6, 4], forward: [0, 0, -1], yFovDeg: 60 }],
        camera: 0,
        display: options.display ?? { ev100: kEv100, tone: "agx", whiteGains: [1, 1, 1] },
      },
    },
  };
  return glb(json, binary.bytes());
}
