// The meshes of a home: one draw call for each set of textures and states, and a small texture that says what each
// material is made of. Emission in it follows the dials.
import * as THREE from "three";
import type { Vec3 } from "../../src/vector.js";
import type { Gltf, Material } from "./document.js";
import { kPacked, mapsOf, type Batch, type Geometry, type Maps } from "./geometry.js";
import { PaneOrder } from "./pane_order.js";
import { kSurfaceFragment, kSurfaceVertex } from "./surface_shader.js";

const kNumbers = 16; // of a material: four texels

export type Uniforms = Record<string, THREE.IUniform>;
// By image number; colour: encoded as sRGB.
export type TextureSource = (image: number, colour: boolean) => THREE.Texture;

function describe(material: Material | undefined, to: Float32Array): void {
  const { pbrMetallicRoughness: pbr, extensions } = material ?? { pbrMetallicRoughness: null, extensions: null };
  const ior = extensions?.KHR_materials_ior?.ior ?? 1.5;
  const reflectance = ((ior - 1) / (ior + 1)) ** 2;
  const share = extensions?.KHR_materials_specular?.specularFactor ?? 1;
  const tint = extensions?.KHR_materials_specular?.specularColorFactor ?? [1, 1, 1];
  to.set(pbr?.baseColorFactor ?? [0.8, 0.8, 0.8, 1], 0);
  to[7] = material?.alphaCutoff ?? 0;
  to[8] = pbr?.roughnessFactor ?? 1;
  to[9] = pbr?.metallicFactor ?? 0;
  to[10] = extensions?.KHR_materials_transmission?.transmissionFactor ?? 0;
  for (let c = 0; c < 3; ++c) to[12 + c] = Math.min(1, reflectance * tint[c]!) * share;
  to[15] = share;
}

export class Surfaces {
  readonly group = new THREE.Group();
  readonly panes: THREE.Mesh[] = [];
  readonly materials: THREE.RawShaderMaterial[] = [];
  private readonly orders: PaneOrder[] = [];
  private readonly table: Float32Array<ArrayBuffer>;
  private readonly texture: THREE.DataTexture;

  constructor(
    private readonly document: Gltf,
    geometry: Geometry,
    private readonly uniforms: Uniforms,
    textures: TextureSource,
    private readonly defines: Readonly<Record<string, string>>,
  ) {
    const count = document.materials.length + 1;
    this.table = new Float32Array(kNumbers * count);
    for (let i = 0; i < count; ++i)
      describe(document.materials[i], this.table.subarray(kNumbers * i, kNumbers * (i + 1)));
    document.materials.forEach((material, i) => {
      const { base } = mapsOf(document, material);
      this.table[kNumbers * i + 11] = base === null ? 0 : Math.max(0, geometry.packed.indexOf(base));
    });
    this.texture = new THREE.DataTexture(this.table, 4, count, THREE.RGBAFormat, THREE.FloatType);
    uniforms.uSurfaces = { value: this.texture };
    this.setFactors(null);
    const attributes = {
      position: new THREE.BufferAttribute(geometry.positions, 3),
      normal: new THREE.BufferAttribute(geometry.normals, 4, true),
      lightUv: new THREE.BufferAttribute(geometry.lightUvs, 2, true),
      tag: new THREE.BufferAttribute(geometry.tags, 2),
      ...(geometry.uvs ? { uv: new THREE.BufferAttribute(geometry.uvs, 2) } : {}),
      ...(geometry.colors ? { color: new THREE.BufferAttribute(geometry.colors, 4, true) } : {}),
    };
    for (const batch of geometry.batches) {
      const part = new THREE.BufferGeometry();
      for (const [name, attribute] of Object.entries(attributes)) part.setAttribute(name, attribute);
      const pane = batch.kind === "pane" || batch.kind === "tinted";
      const index = new THREE.BufferAttribute(pane ? batch.index.slice() : batch.index, 1);
      part.setIndex(index);
      if (pane) this.orders.push(new PaneOrder(batch.index, geometry.positions, index));
      // Blending has one factor for what is behind: colours take a pass of their own, before what the pane adds.
      for (const pass of batch.kind === "tinted" ? (["tint", "add"] as const) : (["all"] as const)) {
        const mesh = new THREE.Mesh(part, this.material(batch, textures, geometry.colors !== null, pass));
        mesh.frustumCulled = false;
        mesh.matrixAutoUpdate = false;
        if (pane) {
          mesh.renderOrder = 2;
          this.panes.push(mesh);
        }
        this.group.add(mesh);
      }
    }
  }

  // Before a picture is drawn.
  orderPanes(eye: THREE.Vector3): void {
    for (const order of this.orders) order.sort(eye);
  }

  // What lamps that shine are multiplied by: null before there are any.
  setFactors(factors: readonly Vec3[] | null): void {
    this.document.materials.forEach((material, i) => {
      const strength = material.extensions.KHR_materials_emissive_strength?.emissiveStrength ?? 1;
      const layers = material.extras?.lightLayers ?? [];
      for (let c = 0; c < 3; ++c) {
        const sum = layers.reduce((s, layer) => s + (factors?.[layer]?.[c] ?? 0), 0);
        const factor = layers.length > 0 ? sum / layers.length : 1;
        this.table[kNumbers * i + 4 + c] = material.emissiveFactor[c]! * strength * factor;
      }
    });
    this.texture.needsUpdate = true;
  }

  private material(
    { kind, doubleSided, maps, normalScale }: Batch,
    textures: TextureSource,
    coloured: boolean,
    pass: "all" | "tint" | "add",
  ): THREE.RawShaderMaterial {
    const uniforms: Uniforms = { ...this.uniforms, uNormalScale: { value: normalScale } };
    const defines: Record<string, string> = { ...this.defines };
    const use = (map: keyof Maps, define: string, uniform: string, colour: boolean) => {
      const image = maps[map];
      if (image === null) return;
      defines[define] = "";
      defines.HAS_UV = "";
      uniforms[uniform] = { value: textures(image, colour) };
    };
    if (maps.base === kPacked) defines.HAS_PACKED = defines.HAS_UV = "";
    else use("base", "HAS_BASE", "uBase", true);
    use("normal", "HAS_NORMAL", "uNormal", false);
    use("roughness", "HAS_ROUGHNESS", "uRoughness", false);
    use("emission", "HAS_EMISSION", "uEmission", true);
    if (kind === "mask") defines.MASK = "";
    if (kind === "pane" || kind === "tinted") defines.PANE = "";
    if (pass === "tint") defines.TINT = "";
    if (coloured) defines.HAS_COLOR = "";
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: kSurfaceVertex,
      fragmentShader: kSurfaceFragment,
      uniforms,
      defines,
      side: doubleSided ? THREE.DoubleSide : THREE.FrontSide,
      ...(defines.PANE !== undefined
        ? {
            transparent: true,
            depthWrite: false,
            blending: THREE.CustomBlending,
            blendSrc: pass === "tint" ? THREE.ZeroFactor : THREE.OneFactor,
            blendDst: { all: THREE.SrcAlphaFactor, tint: THREE.SrcColorFactor, add: THREE.OneFactor }[pass],
            blendSrcAlpha: THREE.ZeroFactor,
            blendDstAlpha: THREE.OneFactor,
          }
        : {}),
    });
    this.materials.push(material);
    return material;
  }
}
