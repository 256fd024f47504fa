// From radiance to the screen: the scene is drawn into short floats with antialiasing, then exposed,
// balanced, toned and encoded. A small copy of it says how bright it is.
import * as THREE from "three";
import type { Home, ToneName } from "./document.js";
import { falseColour, type Scale } from "./false_colour.js";
import { drawInto } from "./light_sum.js";
import { pixelFormat } from "./pixel_format.js";
import { kR2 } from "./reflection.js";
import { kReadoutGlsl, readoutAt } from "./readout.js";
import type { Uniforms } from "./surfaces.js";
import { exposureFromEv100, kDitherGlsl, kToneGlsl, kToneNumbers } from "./tone.js";
import { kMostStored, kUnit } from "./units.js";
import { meanLight } from "./white_balance.js";
import type { Vec3 } from "../../src/vector.js";
import { screenTriangle } from "./screen_triangle.js";

const kMeterWidth = 48;
const kMeterHeight = 27;
// A channel is all but white from there on, behind a pane too: the more it were, the less smooth the edges of what is
// bright.
const kMostExposed: Readonly<Record<ToneName, number>> = { neutral: 8, agx: 16, filmic: 8, clip: 4 };
const kMostRadiance = kMostStored * kUnit;
const kRampColours = 256;
const kWeighted = {
  blending: THREE.CustomBlending,
  blendSrc: THREE.SrcAlphaFactor,
  blendDst: THREE.OneMinusSrcAlphaFactor,
};

const kVertex = `
  in vec3 position;
  out vec2 vUv;
  void main() {
    vUv = position.xy * 0.5 + 0.5;
    gl_Position = vec4(position.xy, 0.0, 1.0);
  }`;
const kHead = `
  precision highp float;
  precision highp int;
  precision highp sampler2D;
  uniform sampler2D uImage;
  in vec2 vUv;
  out vec4 outColor;
  ${kToneGlsl}
  ${kDitherGlsl}
  void encoded(vec3 shown) {
    outColor = vec4(clamp(srgbEncode(shown) + (dither(gl_FragCoord.xy) - 0.5) / 255.0, 0.0, 1.0), 1.0);
  }`;
const kDeveloped = `
  uniform vec3 uExposure;
  uniform int uTone;
  uniform vec2 uGrade;
  vec3 developed() {
    vec3 exposed = texture(uImage, vUv).rgb * ${kUnit.toFixed(1)} * uExposure;
    return clamp(toneCurve(exposed, uTone, uGrade), 0.0, 1.0);
  }`;
const kFragment = `${kHead}${kDeveloped}
  uniform sampler2D uRamp;
  uniform bool uLux;
  uniform vec2 uScale; // lux: logarithms of the ends
  void main() {
    if (!uLux) {
      encoded(developed());
      return;
    }
    float lux = dot(texture(uImage, vUv).rgb, vec3(0.2126, 0.7152, 0.0722)) * ${kUnit.toFixed(1)};
    float t = clamp((log(max(lux, 1e-6)) - uScale.x) / (uScale.y - uScale.x), 0.0, 1.0);
    outColor = vec4(lux > 0.0 ? texture(uRamp, vec2((t * 255.0 + 0.5) / 256.0, 0.5)).rgb : vec3(0.09), 1.0);
  }`;
// Pictures are averaged as the screen shows them: an edge of a window is as bright as it covers a pixel.
const kAddFragment = `${kHead}${kDeveloped}
  uniform float uWeight;
  void main() { outColor = vec4(developed(), uWeight); }`;
const kAverageFragment = `${kHead}
  void main() { encoded(texture(uImage, vUv).rgb); }`;
const kReadHead = `
  precision highp float;
  precision highp int;
  precision highp sampler2D;
  uniform sampler2D uImage;
  in vec2 vUv;
  out vec4 outColor;
  ${kReadoutGlsl}`;
const kMeterFragment = `${kReadHead}
  void main() {
    vec2 size = vec2(${kMeterWidth}.0, ${kMeterHeight}.0);
    vec2 cell = floor(vUv * size);
    float sum = 0.0, count = 0.0;
    for (int i = 0; i < 16; ++i) {
      vec2 at = (cell + (vec2(i % 4, i / 4) + 0.5) / 4.0) / size;
      vec3 c = texture(uImage, at).rgb * ${kUnit.toFixed(1)};
      float amount = dot(c, vec3(0.2126, 0.7152, 0.0722));
      if (amount > 1e-6) sum += log2(amount), count += 1.0;
    }
    outColor = readout(count > 0.0 ? exp2(sum / count) : 0.0);
  }`;
// Red and green of light as shares of all channels, and its logarithm in two bytes.
const kLightFragment = `${kReadHead}
  void main() {
    vec3 c = max(texture(uImage, vUv).rgb, 0.0);
    float sum = c.r + c.g + c.b;
    outColor = vec4(sum > 0.0 ? c.rg / sum : vec2(0.0), readout(dot(c, vec3(0.2126, 0.7152, 0.0722))).rg);
  }`;

function quad(fragmentShader: string, uniforms: Uniforms, blending = {}): THREE.Mesh {
  const geometry = screenTriangle();
  const material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader: kVertex,
    fragmentShader,
    uniforms,
    depthTest: false,
    depthWrite: false,
    ...blending,
  });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}

export class Display {
  // Shared with the surfaces.
  readonly uniforms: Uniforms = {
    uExposure: { value: new THREE.Vector3() },
    uTone: { value: 0 },
    uGrade: { value: new THREE.Vector2(1, 1) },
    uLux: { value: false },
    uEncode: { value: false },
    uMostRadiance: { value: new THREE.Vector3().setScalar(kMostRadiance) },
    uDither: { value: 0 },
    uPicture: { value: -1 },
  };
  private readonly image: THREE.WebGLRenderTarget;
  private readonly meterTarget = new THREE.WebGLRenderTarget(kMeterWidth, kMeterHeight, { depthBuffer: false });
  private readonly lightPicture = new THREE.WebGLRenderTarget(kMeterWidth, kMeterHeight, { type: THREE.HalfFloatType });
  private readonly lightTarget = new THREE.WebGLRenderTarget(kMeterWidth, kMeterHeight, { depthBuffer: false });
  private readonly average = new THREE.WebGLRenderTarget(1, 1, { type: THREE.HalfFloatType, depthBuffer: false });
  private readonly show: THREE.Mesh;
  private readonly add: THREE.Mesh;
  private readonly showAverage: THREE.Mesh;
  private readonly weight = { value: 1 };
  private readonly meterQuad: THREE.Mesh;
  private readonly lightQuad: THREE.Mesh;
  private readonly camera = new THREE.Camera();
  private readonly scale = { value: new THREE.Vector2() };
  private readonly short: boolean;
  private ev100Now = 0;
  private gains: Vec3;

  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    private readonly home: Home,
    samples: number,
  ) {
    const format = pixelFormat(renderer.getContext() as WebGL2RenderingContext, samples);
    this.short = format.short;
    this.image = new THREE.WebGLRenderTarget(1, 1, {
      ...(this.short ? { format: THREE.RGBFormat, type: THREE.UnsignedInt101111Type } : { type: THREE.HalfFloatType }),
      samples: format.samples,
      resolveDepthBuffer: false, // nothing reads it
    });
    const ramp = new Uint8Array(4 * kRampColours);
    for (let i = 0; i < kRampColours; ++i) {
      ramp.set(
        falseColour(i / (kRampColours - 1)).map(c => Math.round(255 * c)),
        4 * i,
      );
      ramp[4 * i + 3] = 255;
    }
    const rampTexture = new THREE.DataTexture(ramp, kRampColours, 1);
    rampTexture.needsUpdate = true;
    const image = { value: this.image.texture };
    this.show = quad(kFragment, { ...this.uniforms, uImage: image, uRamp: { value: rampTexture }, uScale: this.scale });
    this.add = quad(kAddFragment, { ...this.uniforms, uImage: image, uWeight: this.weight }, kWeighted);
    this.showAverage = quad(kAverageFragment, { uImage: { value: this.average.texture } });
    this.meterQuad = quad(kMeterFragment, { uImage: image });
    this.lightQuad = quad(kLightFragment, { uImage: { value: this.lightPicture.texture } });
    this.uniforms.uTone!.value = kToneNumbers[home.display.tone];
    (this.uniforms.uGrade!.value as THREE.Vector2).set(home.display.contrast, home.display.saturation);
    this.gains = home.display.whiteGains;
    this.ev100 = home.display.ev100;
  }

  get ev100(): number {
    return this.ev100Now;
  }
  set ev100(value: number) {
    this.ev100Now = value;
    (this.uniforms.uExposure!.value as THREE.Vector3).set(...this.gains).multiplyScalar(exposureFromEv100(value));
  }

  // Of the white balance.
  get whiteGains(): Vec3 {
    return this.gains;
  }
  set whiteGains(value: Vec3) {
    this.gains = value;
    this.ev100 = this.ev100Now;
  }

  // Lux instead of pictures; null: pictures.
  set luxScale(scale: Scale | null) {
    this.uniforms.uLux!.value = scale !== null;
    if (scale) this.scale.value.set(Math.log(scale.low), Math.log(scale.high));
  }

  resize(widthPx: number, heightPx: number): void {
    this.image.setSize(widthPx, heightPx);
    this.average.setSize(widthPx, heightPx);
  }

  draw(scene: THREE.Scene, camera: THREE.Camera): void {
    this.expose(scene, camera);
    drawInto(this.renderer, null, this.show, this.camera);
  }

  // Adds the picture `index` of a row to their average; what is between pixels and within lobes differs from one to the
  // next (R2 sequence, Roberts 2018).
  refine(scene: THREE.Scene, camera: THREE.PerspectiveCamera, index: number): void {
    const { width, height } = this.image;
    const between = (share: number) => ((0.5 + share * index) % 1) - 0.5; // of a pixel
    const { elements } = camera.projectionMatrix;
    elements[8]! += (2 * between(kR2[0])) / width;
    elements[9]! += (2 * between(kR2[1])) / height;
    this.uniforms.uPicture!.value = index;
    this.expose(scene, camera);
    this.uniforms.uPicture!.value = -1;
    camera.updateProjectionMatrix();
    this.weight.value = 1 / (index + 1);
    drawInto(this.renderer, this.average, this.add, this.camera, index === 0);
  }

  presentAverage(): void {
    drawInto(this.renderer, null, this.showAverage, this.camera);
  }

  private expose(scene: THREE.Scene, camera: THREE.Camera): void {
    const { uMostRadiance, uDither } = this.uniforms;
    const [r, g, b] = (this.uniforms.uExposure!.value as THREE.Vector3).toArray();
    const most = (exposure: number) => Math.min(kMostExposed[this.home.display.tone] / exposure, kMostRadiance);
    (uMostRadiance!.value as THREE.Vector3).set(most(r), most(g), most(b));
    uDither!.value = this.short ? 1 : 0;
    drawInto(this.renderer, this.image, scene, camera);
    (uMostRadiance!.value as THREE.Vector3).setScalar(kMostRadiance);
    uDither!.value = 0;
  }

  // Luminances in cd/m², in false colours lux, of the last picture: rows of `width`, zero where there is nothing.
  async meter(): Promise<{ amounts: number[]; width: number }> {
    const bytes = await this.read(this.meterTarget, this.meterQuad);
    return { amounts: Array.from({ length: bytes.length / 4 }, (_, i) => readoutAt(bytes, i)), width: kMeterWidth };
  }

  // Mean colour of the light on what the camera sees, as in pictures (src/engine/light_colour.cpp).
  async lightColour(scene: THREE.Scene, camera: THREE.Camera): Promise<Vec3> {
    const { uLux } = this.uniforms;
    const before = uLux!.value as boolean;
    uLux!.value = true;
    drawInto(this.renderer, this.lightPicture, scene, camera);
    uLux!.value = before;
    const bytes = await this.read(this.lightTarget, this.lightQuad);
    const places = Array.from({ length: bytes.length / 4 }, (_, i) => 4 * i);
    const shares = places.map(at => [bytes[at]! / 255, bytes[at + 1]! / 255] as const);
    return meanLight(
      shares,
      places.map(at => readoutAt([bytes[at + 2]!, bytes[at + 3]!, 0], 0)),
    );
  }

  private async read(target: THREE.WebGLRenderTarget, from: THREE.Mesh): Promise<Uint8Array> {
    drawInto(this.renderer, target, from, this.camera);
    const bytes = new Uint8Array(4 * kMeterWidth * kMeterHeight);
    await this.renderer.readRenderTargetPixelsAsync(target, 0, 0, kMeterWidth, kMeterHeight, bytes);
    return bytes;
  }
}
