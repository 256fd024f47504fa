// The JSON of a baked home: what is read of glTF, and the extension with the light (docs/reference/baked.md).
import * as v from "valibot";
import { check, real, triple, whole, BadMessage, type Checked } from "../../src/schema.js";
import { BadFile } from "./bad_file.js";

const index = v.pipe(whole, v.minValue(0));
const size = v.pipe(whole, v.minValue(1));
const positive = v.pipe(real, v.gtValue(0));
const positives = v.strictTuple([positive, positive, positive]);
// A texture's image may stand in an extension, for readers of WebP.
const textureImage = v.pipe(
  v.object({
    source: v.optional(index),
    sampler: v.optional(index),
    extensions: v.optional(v.object({ EXT_texture_webp: v.optional(v.object({ source: index })) })),
  }),
  v.transform(t => ({ source: t.extensions?.EXT_texture_webp?.source ?? t.source, sampler: t.sampler })),
);
const texture = v.optional(v.object({ index }));

const material = v.object({
  name: v.optional(v.string(), ""),
  pbrMetallicRoughness: v.optional(
    v.object({
      baseColorFactor: v.optional(v.strictTuple([real, real, real, real]), [1, 1, 1, 1]),
      metallicFactor: v.optional(real, 1),
      roughnessFactor: v.optional(real, 1),
      baseColorTexture: texture,
      metallicRoughnessTexture: texture,
    }),
    {},
  ),
  normalTexture: v.optional(v.object({ index, scale: v.optional(real, 1) })),
  emissiveTexture: texture,
  emissiveFactor: v.optional(triple, [0, 0, 0]),
  alphaMode: v.optional(v.picklist(["OPAQUE", "MASK", "BLEND"]), "OPAQUE"),
  alphaCutoff: v.optional(real, 0.5),
  doubleSided: v.optional(v.boolean(), false),
  extensions: v.optional(
    v.object({
      KHR_materials_emissive_strength: v.optional(v.object({ emissiveStrength: v.optional(real, 1) })),
      KHR_materials_transmission: v.optional(v.object({ transmissionFactor: v.optional(real, 0) })),
      KHR_materials_ior: v.optional(v.object({ ior: v.optional(real, 1.5) })),
      KHR_materials_specular: v.optional(
        v.object({ specularFactor: v.optional(real, 1), specularColorFactor: v.optional(triple, [1, 1, 1]) }),
      ),
    }),
    {},
  ),
  extras: v.optional(v.object({ lightLayers: v.optional(v.array(index), []) })),
});

const compression = v.object({
  byteOffset: v.optional(index, 0),
  byteLength: index,
  byteStride: size,
  mode: v.picklist(["ATTRIBUTES", "TRIANGLES"]),
  count: index,
});
export type Compression = Checked<typeof compression>;

const light = v.object({ bufferView: index, scale: positive, tiles: v.array(index) });
const panorama = v.object({ bufferView: index, width: size, height: size, scale: positive });
const mask = v.object({
  bufferView: index,
  fine: size, // cells along the edge of a texel
  channels: v.picklist([1, 3]),
  tiles: v.array(index),
});
const sun = v.object({ direction: triple, lux: triple, halfAngleDeg: v.optional(real, 0), mask });
const layer = v.object({
  name: v.string(),
  kind: v.picklist(["lamp", "sun", "sky"]),
  room: v.optional(v.string(), ""),
  on: v.optional(v.boolean(), true),
  hour: v.optional(real),
  kelvin: v.optional(positive),
  color: v.optional(triple, [1, 1, 1]),
  position: v.optional(triple),
  light,
  lean: v.optional(light),
  panorama: v.optional(panorama),
  sun: v.optional(sun),
});
const room = v.object({
  name: v.string(),
  floor: v.array(v.strictTuple([real, real])),
  elevationM: v.optional(real, 0),
  heightM: v.optional(positive, 2.5),
});
const camera = v.object({
  name: v.optional(v.string(), ""),
  position: triple,
  forward: triple,
  yFovDeg: v.optional(v.pipe(real, v.gtValue(0), v.ltValue(180)), 60),
});

const extension = v.object({
  version: whole,
  atlas: v.object({ width: size, height: size, tile: size }),
  layers: v.array(layer),
  hour: v.optional(real),
  rooms: v.optional(v.array(room), []),
  cameras: v.optional(v.array(camera), []),
  camera: v.optional(index, 0),
  display: v.object({
    ev100: real,
    tone: v.picklist(["neutral", "agx", "filmic", "clip"]),
    contrast: v.optional(positive, 1),
    saturation: v.optional(v.pipe(real, v.minValue(0)), 1),
    whiteGains: v.optional(positives, [1, 1, 1]),
    whites: v.optional(v.array(v.object({ light: triple, shown: positives })), []),
  }),
});

const gltf = v.object({
  accessors: v.optional(
    v.array(
      v.object({
        bufferView: index,
        byteOffset: v.optional(index, 0),
        componentType: whole,
        count: index,
        type: v.string(),
      }),
    ),
    [],
  ),
  bufferViews: v.optional(
    v.array(
      v.object({
        byteOffset: v.optional(index, 0),
        byteLength: index,
        byteStride: v.optional(size),
        extensions: v.optional(v.object({ EXT_meshopt_compression: v.optional(compression) }), {}),
      }),
    ),
    [],
  ),
  nodes: v.optional(
    v.array(v.object({ translation: v.optional(triple, [0, 0, 0]), scale: v.optional(triple, [1, 1, 1]) })),
    [],
  ),
  meshes: v.pipe(
    v.array(
      v.object({
        primitives: v.array(
          v.object({
            attributes: v.record(v.string(), index),
            indices: v.optional(index),
            material: v.optional(index),
          }),
        ),
      }),
    ),
    v.minLength(1),
  ),
  materials: v.optional(v.array(material), []),
  textures: v.optional(v.array(textureImage), []),
  samplers: v.optional(v.array(v.object({ wrapS: v.optional(whole), wrapT: v.optional(whole) })), []),
  images: v.optional(v.array(v.object({ bufferView: index, mimeType: v.string() })), []),
  extensions: v.object({ ROOMLIGHT_light_layers: extension }),
});

export type Gltf = Checked<typeof gltf>;
export type Material = Gltf["materials"][number];
export type Home = Checked<typeof extension>;
export type Layer = Home["layers"][number];
export type Room = Home["rooms"][number];
export type Camera = Home["cameras"][number];
export type ToneName = Home["display"]["tone"];

const kMostCells = 1024; // along the edge of a tile
const kVersion = 4; // that bake writes
const versionOnly = v.object({ extensions: v.object({ ROOMLIGHT_light_layers: v.object({ version: whole }) }) });

export function checkDocument(json: unknown): Gltf {
  const probed = v.safeParse(versionOnly, json);
  if (!probed.success) throw new BadFile("foreign", "ROOMLIGHT_light_layers");
  const { version } = probed.output.extensions.ROOMLIGHT_light_layers;
  if (version !== kVersion) throw new BadFile("newer", `ROOMLIGHT_light_layers ${version}`);
  try {
    const document = check(gltf, json);
    checkTiles(document.extensions.ROOMLIGHT_light_layers);
    return document;
  } catch (error) {
    if (error instanceof BadMessage) throw new BadFile("damaged", error.message);
    throw error;
  }
}

function checkTiles({ atlas, layers }: Home): void {
  if (atlas.width % atlas.tile !== 0 || atlas.height % atlas.tile !== 0)
    throw new BadFile("damaged", "atlas: its size is not one of whole tiles");
  const count = (atlas.width / atlas.tile) * (atlas.height / atlas.tile);
  const fine = layers.find(layer => layer.sun)?.sun?.mask.fine;
  layers.forEach(({ light, lean, sun }, i) => {
    const listed = { light: light.tiles, lean: lean?.tiles ?? [], "sun.mask": sun?.mask.tiles ?? [] };
    for (const [what, tiles] of Object.entries(listed))
      if (tiles.some((tile, k) => tile >= count || (k > 0 && tile <= tiles[k - 1]!)))
        throw new BadFile("damaged", `layers.${i}.${what}.tiles: the atlas has ${count}`);
    if (sun && (sun.mask.fine !== fine || fine * atlas.tile > kMostCells))
      throw new BadFile("damaged", `layers.${i}.sun.mask.fine: ${sun.mask.fine}`);
  });
}

// The bytes of a buffer view.
export function viewBytes(document: Gltf, binary: Uint8Array, at: number): Uint8Array {
  const view = document.bufferViews[at];
  if (!view) throw new BadFile("damaged", `bufferViews.${at}: missing`);
  const end = view.byteOffset + view.byteLength;
  if (end > binary.length) throw new BadFile("damaged", `bufferViews.${at}: ends behind the file`);
  return binary.subarray(view.byteOffset, end);
}
