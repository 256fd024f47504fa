// Illuminance at a point of a surface: one texel of the sum of light, or where vertices are lit a mean of three.
import * as THREE from "three";
import type { Hit } from "./bvh.js";
import type { Geometry } from "./geometry.js";
import { drawInto, type LightSum } from "./light_sum.js";
import { kReadoutGlsl, readoutAt } from "./readout.js";
import { kScreenVertex, screenTriangle } from "./screen_triangle.js";
import { kSunGlsl, type Sunlight } from "./sunlight.js";
import { kUnit } from "./units.js";

const kFragment = `
  precision highp float;
  precision highp int;
  precision highp sampler2D;
  uniform sampler2D uLight;
  uniform vec2 uCorners[3];
  uniform vec3 uWeights;
  uniform bool uVertexLit;
  uniform vec3 uNormal;
  out vec4 outColor;
  ${kSunGlsl}
  ${kReadoutGlsl}
  vec3 at(vec2 uv) {
    ivec2 size = textureSize(uLight, 0);
    return texelFetch(uLight, min(ivec2(uv * vec2(size)), size - 1), 0).rgb;
  }
  void main() {
    vec3 light = uVertexLit
      ? at(uCorners[0]) * uWeights.x + at(uCorners[1]) * uWeights.y + at(uCorners[2]) * uWeights.z
      : textureLod(uLight, uCorners[0] * uWeights.x + uCorners[1] * uWeights.y + uCorners[2] * uWeights.z, 0.0).rgb;
    #ifdef SUN_TILE
      for (int k = 0; k < uSunCount; ++k) {
        vec3 left = uVertexLit
          ? sunLeft(k, uCorners[0]) * uWeights.x + sunLeft(k, uCorners[1]) * uWeights.y
            + sunLeft(k, uCorners[2]) * uWeights.z
          : sunLeft(k, uCorners[0] * uWeights.x + uCorners[1] * uWeights.y + uCorners[2] * uWeights.z);
        light += left * uSunLux[k] * max(dot(uNormal, uSunDirection[k]), 0.0);
      }
    #endif
    outColor = readout(dot(light, vec3(0.2126, 0.7152, 0.0722)) * ${kUnit.toFixed(1)});
  }`;

export class SpotMeter {
  private readonly target = new THREE.WebGLRenderTarget(1, 1, { depthBuffer: false });
  private readonly mesh: THREE.Mesh;
  private readonly camera = new THREE.Camera();
  private readonly corners = [new THREE.Vector2(), new THREE.Vector2(), new THREE.Vector2()];
  private readonly weights = new THREE.Vector3();
  private readonly normal = new THREE.Vector3();
  private readonly vertexLit = { value: false };

  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    light: LightSum,
    sunlight: Sunlight,
    private readonly geometry: Geometry,
  ) {
    const shape = screenTriangle();
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: kScreenVertex,
      fragmentShader: kFragment,
      uniforms: {
        uLight: { value: light.target.texture },
        uCorners: { value: this.corners },
        uWeights: { value: this.weights },
        uVertexLit: this.vertexLit,
        uNormal: { value: this.normal },
        ...sunlight.uniforms,
      },
      defines: { ...sunlight.defines },
      depthTest: false,
    });
    this.mesh = new THREE.Mesh(shape, material);
    this.mesh.frustumCulled = false;
  }

  async luxAt({ triangle, u, v }: Hit): Promise<number> {
    const { index, lightUvs, normals, tags } = this.geometry;
    this.normal.set(0, 0, 0);
    const weights = [1 - u - v, u, v];
    for (let corner = 0; corner < 3; ++corner) {
      const vertex = index[3 * triangle + corner]!;
      const [x, y, z] = normals.subarray(4 * vertex);
      this.normal.addScaledVector(new THREE.Vector3(x, y, z), weights[corner]!);
      this.corners[corner]!.set(lightUvs[2 * vertex]! / 65535, lightUvs[2 * vertex + 1]! / 65535);
    }
    this.normal.normalize();
    this.weights.set(weights[0]!, weights[1]!, weights[2]!);
    this.vertexLit.value = tags[2 * index[3 * triangle]! + 1]! > 0;
    drawInto(this.renderer, this.target, this.mesh, this.camera);
    const bytes = new Uint8Array(4);
    await this.renderer.readRenderTargetPixelsAsync(this.target, 0, 0, 1, 1, bytes);
    return readoutAt(bytes, 0);
  }
}
