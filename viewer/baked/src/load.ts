// From the bytes of a file to geometry, textures, and layers of light one after the other.
import * as THREE from "three";
import { BadFile } from "./bad_file.js";
import { checkDocument, viewBytes, type Gltf } from "./document.js";
import { readGeometry, type Geometry } from "./geometry.js";
import { parseGlb } from "./glb.js";
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

// The layers that are on come first; `came` is called after each, with the share that has come.
export async function loadLight(
  { document, binary }: LoadedHome,
  stage: Stage,
  isOn: (layer: number) => boolean,
  came: (layer: number, share: number) => void,
): Promise<void> {
  const { atlas, layers } = document.extensions.ROOMLIGHT_light_layers;
  const order = layers.map((_, i) => i).sort((a, b) => Number(isOn(b)) - Number(isOn(a)) || a - b);
  const unpack = async (i: number) => {
    const { name, light, lean, panorama, sun } = layers[i]!;
    const what = `layers.${i} (${name})`;
    const bytes = (view: number, count: number, of: string) => inflate(viewBytes(document, binary, view), count, of);
    const part = (view: number, texels: number, of: string) => bytes(view, 4 * texels, of);
    return {
      light: await part(light.bufferView, atlas.tile ** 2 * light.tiles.length, what),
      lean: lean && (await part(lean.bufferView, atlas.tile ** 2 * lean.tiles.length, `${what}: lean`)),
      sky: panorama && (await part(panorama.bufferView, panorama.width * panorama.height, `${what}: panorama`)),
      mask: sun && (await bytes(sun.mask.bufferView, Sunlight.bytesOf(sun.mask, atlas.tile), `${what}: sun`)),
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
    const { light, lean, panorama } = layers[i]!;
    const planes = (await next)!;
    next = start(done + 1);
    const texelsOf = ({ tiles }: typeof light, bytes: Uint8Array) =>
      unpackTexels(bytes, atlas.tile, atlas.tile, stage.light.texelsFor(tiles.length));
    const texels = texelsOf(light, planes.light);
    if (stage.lean && lean && planes.lean) {
      const leans = texelsOf(lean, planes.lean);
      timesLuminance(leans, lean.tiles, texels, light.tiles, atlas.tile ** 2);
      stage.lean.add(i, lean.tiles, leans, light.scale);
    }
    stage.light.add(i, light.tiles, texels, light.scale);
    if (panorama && planes.sky) {
      const sky = unpackTexels(planes.sky, panorama.width, panorama.height);
      stage.sky.add(i, sky, panorama.width, panorama.scale);
    }
    if (planes.mask) stage.sunlight.add(i, planes.mask);
    came(i, (done + 1) / order.length);
  }
}
