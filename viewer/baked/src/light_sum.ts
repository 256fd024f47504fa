// The atlas of light: the sum of all layers, each times its factor, as 16-bit floats in units of kUnit lux. The tiles
// of a layer are drawn as one instanced quad with additive blending, and only when factors have changed. Layers that
// are not on the chip are in a sum of their own, the rest (layer_keeper.ts).
import * as THREE from "three";
import type { Vec3 } from "../../src/vector.js";
import { kScreenVertex, screenTriangle } from "./screen_triangle.js";
import { kUnit } from "./units.js";

export const kRowTexels = 2048; // of the textures that hold a layer's tiles, one texel after the other
const kMostRows = 2048;

const kVertex = `
  in vec3 position;
  in float aTile;
  uniform ivec2 uSize; // texels
  uniform int uTile;
  out vec2 vInTile;
  flat out int vFirst;
  void main() {
    int columns = uSize.x / uTile, tile = int(aTile);
    vInTile = position.xy * float(uTile);
    vFirst = gl_InstanceID * uTile * uTile;
    vec2 texel = vec2(tile % columns, tile / columns) * float(uTile) + vInTile;
    gl_Position = vec4(texel / vec2(uSize) * 2.0 - 1.0, 0.0, 1.0);
  }`;
const kFragment = `
  precision highp float;
  precision highp int;
  precision highp sampler2D;
  uniform sampler2D uTexels;
  uniform int uTile;
  uniform vec3 uFactor;
  in vec2 vInTile;
  flat in int vFirst;
  out vec4 outColor;
  void main() {
    ivec2 p = ivec2(vInTile);
    int at = vFirst + p.y * uTile + p.x;
    vec3 value = texelFetch(uTexels, ivec2(at % ${kRowTexels}, at / ${kRowTexels}), 0).rgb;
    outColor = vec4(clamp(value * uFactor, -65000.0, 65000.0), 1.0);
  }`;

const kRestFragment = `
  precision highp float;
  precision highp sampler2D;
  uniform sampler2D uRest;
  out vec4 outColor;
  void main() { outColor = vec4(max(texelFetch(uRest, ivec2(gl_FragCoord.xy), 0).rgb, 0.0), 1.0); }`;

export const kAdditive = {
  blending: THREE.CustomBlending,
  blendEquation: THREE.AddEquation,
  blendSrc: THREE.OneFactor,
  blendDst: THREE.OneFactor,
  depthTest: false,
  depthWrite: false,
} as const;

// RGB9_E5 as the GPU has it; its memory here is given back once it is there.
export function sharedExponentTexture(texels: Uint32Array<ArrayBuffer>, width: number): THREE.DataTexture {
  const height = texels.length / width;
  const texture = new THREE.DataTexture(texels, width, height, THREE.RGBFormat, THREE.UnsignedInt5999Type);
  texture.onUpdate = () => void ((texture.image as { data: unknown }).data = null);
  texture.needsUpdate = true;
  return texture;
}

// How many texels the texture of so many tiles needs.
export const texelsFor = (tiles: number, tile: number): number =>
  kRowTexels * Math.max(1, Math.ceil((tiles * tile ** 2) / kRowTexels));

export interface Part {
  readonly mesh: THREE.Mesh<THREE.BufferGeometry, THREE.RawShaderMaterial>;
  readonly layer: number;
  readonly scale: number;
}

// How much of each layer is drawn; with `only` that one alone.
export function setFactors(parts: readonly Part[], factors: readonly Vec3[], only?: number): void {
  for (const { mesh, layer, scale } of parts) {
    const factor = factors[layer] ?? [0, 0, 0];
    mesh.visible = factor.some(c => Math.abs(c) > 0) && (only ?? layer) === layer;
    (mesh.material.uniforms.uFactor!.value as THREE.Vector3)
      .set(factor[0], factor[1], factor[2])
      .multiplyScalar(scale / kUnit);
  }
}

export class LightSum {
  readonly target: THREE.WebGLRenderTarget;
  private rest: THREE.WebGLRenderTarget | null = null;
  private newRest: THREE.WebGLRenderTarget | null = null;
  private readonly restMesh: THREE.Mesh<THREE.BufferGeometry, THREE.RawShaderMaterial>;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.Camera();
  private parts: Part[] = [];

  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    readonly width: number,
    readonly height: number,
    private readonly tile: number,
  ) {
    this.target = this.makeTarget();
    this.scene.matrixWorldAutoUpdate = false;
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: kScreenVertex,
      fragmentShader: kRestFragment,
      uniforms: { uRest: { value: null } },
      ...kAdditive,
    });
    this.restMesh = new THREE.Mesh(screenTriangle(), material);
    this.restMesh.frustumCulled = false;
    this.scene.add(this.restMesh);
  }

  private makeTarget(): THREE.WebGLRenderTarget {
    return new THREE.WebGLRenderTarget(this.width, this.height, {
      type: THREE.HalfFloatType,
      format: THREE.RGBAFormat,
      depthBuffer: false,
      minFilter: THREE.LinearFilter,
      magFilter: THREE.LinearFilter,
    });
  }

  // More than one texture can hold on small GPUs is split; 32 tiles of an even size fill whole rows.
  add(layer: number, tiles: readonly number[], texels: Uint32Array<ArrayBuffer>, scale: number): void {
    const most = Math.max(32, Math.floor((kRowTexels * kMostRows) / this.tile ** 2 / 32) * 32);
    for (let first = 0; first < tiles.length; first += most) {
      const end = first + most < tiles.length ? (first + most) * this.tile ** 2 : texels.length;
      this.addPart(layer, tiles.slice(first, first + most), texels.subarray(first * this.tile ** 2, end), scale);
    }
  }

  private addPart(layer: number, tiles: readonly number[], texels: Uint32Array<ArrayBuffer>, scale: number): void {
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute(
      "position",
      new THREE.BufferAttribute(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]), 3),
    );
    geometry.setAttribute("aTile", new THREE.InstancedBufferAttribute(Float32Array.from(tiles), 1));
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    geometry.instanceCount = tiles.length;
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: kVertex,
      fragmentShader: kFragment,
      uniforms: {
        uTexels: { value: sharedExponentTexture(texels, kRowTexels) },
        uSize: { value: [this.width, this.height] },
        uTile: { value: this.tile },
        uFactor: { value: new THREE.Vector3() },
      },
      ...kAdditive,
    });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
    this.parts.push({ mesh, layer, scale });
  }

  // Gives the memory of a layer back.
  drop(layer: number): void {
    for (const { mesh, layer: of } of this.parts) {
      if (of !== layer) continue;
      this.scene.remove(mesh);
      mesh.geometry.dispose();
      (mesh.material.uniforms.uTexels!.value as THREE.Texture).dispose();
      mesh.material.dispose();
    }
    this.parts = this.parts.filter(part => part.layer !== layer);
  }

  // The sum anew, or with `only` that layer on top of what is there.
  update(factors: readonly Vec3[], only?: number): void {
    setFactors(this.parts, factors, only);
    this.restMesh.visible = this.rest !== null && only === undefined;
    drawInto(this.renderer, this.target, this.scene, this.camera, only === undefined);
  }

  // Adds a layer to the rest.
  addToRest(layer: number, factor: Vec3): void {
    if (!this.rest) this.useRest(this.emptied(this.makeTarget()));
    this.addTo(this.rest!, layer, factor);
  }

  // The same to one that will take its place.
  startNewRest(): void {
    this.newRest = this.emptied(this.newRest ?? this.makeTarget());
  }
  addToNewRest(layer: number, factor: Vec3): void {
    this.addTo(this.newRest!, layer, factor);
  }
  useNewRest(): void {
    this.rest?.dispose();
    this.useRest(this.newRest!);
    this.newRest = null;
  }

  private addTo(target: THREE.WebGLRenderTarget, layer: number, factor: Vec3): void {
    const factors: Vec3[] = [];
    factors[layer] = factor;
    setFactors(this.parts, factors, layer);
    this.restMesh.visible = false;
    drawInto(this.renderer, target, this.scene, this.camera, false);
  }

  private emptied(target: THREE.WebGLRenderTarget): THREE.WebGLRenderTarget {
    drawInto(this.renderer, target, new THREE.Scene(), this.camera);
    return target;
  }

  private useRest(target: THREE.WebGLRenderTarget): void {
    this.rest = target;
    this.restMesh.material.uniforms.uRest!.value = target.texture;
  }
}

// Draws, by default after clearing the target to nothing.
export function drawInto(
  renderer: THREE.WebGLRenderer,
  target: THREE.WebGLRenderTarget | null,
  scene: THREE.Object3D,
  camera: THREE.Camera,
  clear = true,
): void {
  const xr = renderer.xr.enabled;
  renderer.xr.enabled = false;
  renderer.setRenderTarget(target);
  renderer.setClearColor(0x000000, 0);
  if (clear) renderer.clear();
  renderer.render(scene, camera);
  renderer.setRenderTarget(null);
  renderer.xr.enabled = xr;
}
