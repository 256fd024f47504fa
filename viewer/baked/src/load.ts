// From the bytes of a file to geometry, textures, and layers of light one after the other.
import * as THREE from "three";
import { BadFile } from "./bad_file.js";
import { checkDocument, viewBytes, type Gltf } from "./document.js";
import { readGeometry, type Geometry } from "./geometry.js";
import { parseGlb } from "./glb.js";
import type { Stage } from "./stage.js";
import type { TextureSource } from "./surfaces.js";
import { inflate, joinPlanes } from "./texels.js";

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
  const { json, binary } = parseGlb(bytes);
  const document = checkDocument(json);
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

// The layers that are on come first; `progress` is called after each, with the share that has come.
export async function loadLight(
  { document, binary }: LoadedHome,
  stage: Stage,
  isOn: (layer: number) => boolean,
  progress: (share: number) => void,
): Promise<void> {
  const { atlas, layers } = document.extensions.ROOMLIGHT_light_layers;
  const order = layers.map((_, i) => i).sort((a, b) => Number(isOn(b)) - Number(isOn(a)) || a - b);
  for (const [done, i] of order.entries()) {
    const { name, light, panorama } = layers[i]!;
    const what = `layers.${i} (${name})`;
    if (light.tiles.length > 0) {
      const size = 4 * atlas.tile ** 2 * light.tiles.length;
      const planes = await inflate(viewBytes(document, binary, light.bufferView), size, what);
      stage.light.add(i, light.tiles, joinPlanes(planes, stage.light.texelsFor(light.tiles.length)), light.scale);
    }
    if (panorama) {
      const { width, height, bufferView, scale } = panorama;
      const planes = await inflate(viewBytes(document, binary, bufferView), 4 * width * height, `${what}: panorama`);
      stage.sky.add(i, joinPlanes(planes), width, scale);
    }
    progress((done + 1) / order.length);
  }
}
