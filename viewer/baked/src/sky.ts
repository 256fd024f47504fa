// What is seen of the sky: the panoramas of the hours, added up like the layers, on a box around the camera.
import * as THREE from "three";
import type { Vec3 } from "../../src/vector.js";
import { drawInto, kAdditive, setFactors, sharedExponentTexture, type Part } from "./light_sum.js";
import { kScreenVertex, screenTriangle } from "./screen_triangle.js";
import { kUnit } from "./units.js";

const kSumFragment = `
  precision highp float;
  precision highp int;
  precision highp sampler2D;
  uniform sampler2D uTexels;
  uniform vec3 uFactor;
  uniform vec2 uShare; // of a texel of the target
  out vec4 outColor;
  void main() {
    ivec2 p = ivec2(gl_FragCoord.xy * uShare);
    outColor = vec4(min(texelFetch(uTexels, p, 0).rgb * uFactor, 65000.0), 1.0);
  }`;

// One triangle over all of the screen, behind everything. A box around the eye would have corners at its side, w = 0,
// whose faces came before walls.
const kBehindVertex = `
  in vec3 position;
  uniform mat4 viewMatrix, projectionMatrix;
  out vec3 vDirection;
  void main() {
    vec4 far = inverse(projectionMatrix * mat4(mat3(viewMatrix))) * vec4(position.xy, 1.0, 1.0);
    vDirection = far.xyz / far.w;
    gl_Position = vec4(position.xy, 1.0, 1.0);
  }`;
// `finish` is the function of the surfaces that brings radiance to the target.
const kBehindFragment = (finish: string) => `
  precision highp float;
  precision highp int;
  precision highp sampler2D;
  uniform sampler2D uSky;
  in vec3 vDirection;
  out vec4 outColor;
  ${finish}
  void main() {
    vec3 d = normalize(vDirection);
    vec2 uv = vec2(0.5 + atan(d.x, -d.z) / 6.28318531, acos(clamp(d.y, -1.0, 1.0)) / 3.14159265);
    outColor = vec4(finish(textureLod(uSky, uv, 0.0).rgb * ${kUnit.toFixed(1)}, vec3(0.0)), 10000.0); // far, to a probe
  }`;

export class Sky {
  readonly mesh: THREE.Mesh;
  private readonly target: THREE.WebGLRenderTarget;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.Camera();
  private readonly parts: Part[] = [];

  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    private readonly width: number,
    private readonly height: number,
    finish: string,
    uniforms: Record<string, THREE.IUniform>,
  ) {
    this.target = new THREE.WebGLRenderTarget(width, height, {
      type: THREE.HalfFloatType,
      depthBuffer: false,
      wrapS: THREE.RepeatWrapping,
      minFilter: THREE.LinearFilter,
      magFilter: THREE.LinearFilter,
    });
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: kBehindVertex,
      fragmentShader: kBehindFragment(finish),
      uniforms: { ...uniforms, uSky: { value: this.target.texture } },
      side: THREE.DoubleSide, // the eyes of a probe are mirrored
      depthWrite: false,
    });
    const geometry = screenTriangle();
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 1; // behind what is solid, before panes
  }

  add(layer: number, texels: Uint32Array<ArrayBuffer>, width: number, scale: number): void {
    const geometry = screenTriangle();
    const height = texels.length / width;
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: kScreenVertex,
      fragmentShader: kSumFragment,
      uniforms: {
        uTexels: { value: sharedExponentTexture(texels, width) },
        uFactor: { value: new THREE.Vector3() },
        uShare: { value: new THREE.Vector2(width / this.width, height / this.height) },
      },
      ...kAdditive,
    });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
    this.parts.push({ mesh, layer, scale });
  }

  update(factors: readonly Vec3[], only?: number): void {
    setFactors(this.parts, factors, only);
    drawInto(this.renderer, this.target, this.scene, this.camera, only === undefined);
  }
}
