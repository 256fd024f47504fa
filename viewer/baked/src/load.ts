// From the bytes of a file to geometry, textures, and layers of light one after the other.
import * as THREE from "three";
import { BadFile } from "./bad_file.js";
import { checkDocument, viewBytes, type Gltf, type Home, type Layer } from "./document.js";
import { readGeometry, type Geometry } from "./geometry.js";
import { parseGlb } from "./glb.js";
import type { UnpackedLight } from "./light_chip.js";
import { texelsFor } from "./light_sum.js";
import { expanded } from "./meshopt.js";
import type { Stage } from "./stage.js";
import { Sunlight } from "./sunlight.js";
import type { TextureSource } from "./surfaces.js";
import { inflate, timesLuminance, unpackTexels } from "./texels.js";

export interface LoadedHome {
  readonly document: Gltf;
  readonly binary: Uint8Array;
  readonly geometry: Geometry;
  readonly images: readonly ImageBitmap[];
}

const kWrap: Readonly<Record<number, THREE.Wrapping>> = {
  33071: THREE.ClampToEdgeWrapping,
  33648: THREE.MirroredRepeatWrapping,
  10497: THREE.RepeatWrapping,
};

export async function readHome(bytes: Uint8Array): Promise<LoadedHome> {
  const file = parseGlb(bytes);
  const { document, binary } = await expanded(checkDocument(file.json), file.binary);
  const geometry = readGeometry(document, binary);
  const images = await Promise.all(
    document.images.map(({ bufferView, mimeType }, i) => {
      const data = viewBytes(document, binary, bufferView) as Uint8Array<ArrayBuffer>;
      const plain = { colorSpaceConversion: "none", premultiplyAlpha: "none" } as const;
      return createImageBitmap(new Blob([data], { type: mimeType }), plain).catch(() => {
        throw new BadFile("damaged", `images.${i}`);
      });
    }),
  );
  return { document, binary, geometry, images };
}

// Textures by image; the same one is uploaded once.
export function textureSource({ document, images }: LoadedHome, anisotropy: number): TextureSource {
  const made = new Map<string, THREE.Texture>();
  return (image, colour) => {
    const key = `${image} ${colour}`;
    const known = made.get(key);
    if (known) return known;
    const texture = new THREE.Texture(images[image]);
    const sampler = document.samplers[document.textures.find(t => t.source === image)?.sampler ?? -1];
    texture.wrapS = kWrap[sampler?.wrapS ?? 10497] ?? THREE.RepeatWrapping;
    texture.wrapT = kWrap[sampler?.wrapT ?? 10497] ?? THREE.RepeatWrapping;
    texture.flipY = false;
    texture.premultiplyAlpha = false;
    texture.colorSpace = colour ? THREE.SRGBColorSpace : THREE.NoColorSpace;
    texture.anisotropy = anisotropy;
    texture.needsUpdate = true;
    made.set(key, texture);
    return texture;
  };
}

const kPackedPx = 512;

// The images of base colours that share one texture.
export function packedTextures({ geometry, images }: LoadedHome, anisotropy: number): THREE.DataArrayTexture | null {
  const { packed } = geometry;
  if (packed.length === 0) return null;
  const bytes = 4 * kPackedPx ** 2;
  const data = new Uint8Array(bytes * packed.length);
  const canvas = new OffscreenCanvas(kPackedPx, kPackedPx);
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  packed.forEach((image, i) => {
    context.drawImage(images[image]!, 0, 0, kPackedPx, kPackedPx);
    data.set(context.getImageData(0, 0, kPackedPx, kPackedPx).data, bytes * i);
  });
  const texture = new THREE.DataArrayTexture(data, kPackedPx, kPackedPx, packed.length);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.magFilter = THREE.LinearFilter;
  texture.minFilter = THREE.LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.anisotropy = anisotropy;
  texture.needsUpdate = true;
  return texture;
}

type Sun = NonNullable<Layer["sun"]>;

// What images and masks of the sun take on the chip, mipmaps included.
export function textureBytes({ document, images, geometry }: LoadedHome): number {
  const { atlas, layers } = document.extensions.ROOMLIGHT_light_layers;
  const pixels = images.reduce(
    (sum, { width, height }, i) => sum + (geometry.packed.includes(i) ? kPackedPx ** 2 : width * height),
    0,
  );
  const suns = layers.flatMap(({ sun }) => (sun ? [sun] : []));
  const grey = suns.every(({ mask }) => mask.channels === 1);
  const maskBytes = ({ mask }: Sun) => mask.tiles.length * (atlas.tile * mask.fine) ** 2 * (grey ? 1 : 4);
  return (16 / 3) * pixels + suns.reduce((sum, sun) => sum + maskBytes(sun), 0);
}

// Unpacks layers of light. `keeps`: can go on without the file.
export class LightReader {
  private readonly home: Home;
  private views: readonly { light: Uint8Array; lean: Uint8Array | null }[];

  constructor(
    { document, binary }: LoadedHome,
    private readonly keeps: boolean,
  ) {
    this.home = document.extensions.ROOMLIGHT_light_layers;
    this.views = this.home.layers.map(({ light, lean }) => ({
      light: viewBytes(document, binary, light.bufferView),
      lean: lean ? viewBytes(document, binary, lean.bufferView) : null,
    }));
  }

  // The file is not needed any more.
  release(): void {
    this.views = this.keeps
      ? this.views.map(({ light, lean }) => ({ light: light.slice(), lean: lean?.slice() ?? null }))
      : [];
  }

  async unpack(i: number): Promise<UnpackedLight> {
    const { layers, atlas } = this.home;
    const { name, light, lean } = layers[i]!;
    const { tile } = atlas;
    const texels = async (bytes: Uint8Array, tiles: number, what: string) =>
      unpackTexels(await inflate(bytes, 4 * tile ** 2 * tiles, what), tile, tile, texelsFor(tiles, tile));
    const { light: bytes, lean: leanBytes } = this.views[i]!;
    const lit = await texels(bytes, light.tiles.length, `layers.${i} (${name})`);
    if (!lean || !leanBytes) return { light: lit, lean: null };
    const leans = await texels(leanBytes, lean.tiles.length, `layers.${i} (${name}): lean`);
    timesLuminance(leans, lean.tiles, lit, light.tiles, tile ** 2);
    return { light: lit, lean: leans };
  }
}

// The layers that are on come first; `came` is called after each, with the share that has come.
export async function loadLight(
  { document, binary }: LoadedHome,
  reader: LightReader,
  stage: Stage,
  isOn: (layer: number) => boolean,
  came: (share: number) => void,
): Promise<void> {
  const { atlas, layers } = document.extensions.ROOMLIGHT_light_layers;
  const order = layers.map((_, i) => i).sort((a, b) => Number(isOn(b)) - Number(isOn(a)) || a - b);
  const unpack = async (i: number) => {
    const { name, panorama, sun } = layers[i]!;
    const bytes = (view: number, count: number, of: string) =>
      inflate(viewBytes(document, binary, view), count, `layers.${i} (${name}): ${of}`);
    return {
      light: await reader.unpack(i),
      sky: panorama && (await bytes(panorama.bufferView, 4 * panorama.width * panorama.height, "panorama")),
      mask: sun && (await bytes(sun.mask.bufferView, Sunlight.bytesOf(sun.mask, atlas.tile), "sun")),
    };
  };
  // The next one is unpacked while one goes to the GPU.
  const start = (at: number) => {
    const work = order[at] === undefined ? null : unpack(order[at]);
    work?.catch(() => undefined); // told when its turn comes
    return work;
  };
  let next = start(0);
  for (const [done, i] of order.entries()) {
    const { panorama } = layers[i]!;
    const { light, sky, mask } = (await next)!;
    next = start(done + 1);
    if (panorama && sky) {
      stage.sky.add(i, unpackTexels(sky, panorama.width, panorama.height), panorama.width, panorama.scale);
    }
    if (mask) stage.sunlight.add(i, mask);
    stage.include(i, light);
    came((done + 1) / order.length);
  }
}
