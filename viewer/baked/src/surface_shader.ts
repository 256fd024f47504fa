// How surfaces look: glTF's metallic-roughness under the irradiance of the atlas and the reflections of a probe. The
// diffuse base keeps what the specular lobe leaves, as in src/trace/bsdf.h.
import { kReflectionGlsl } from "./reflection.js";
import { kSunGlsl } from "./sunlight.js";
import { kDitherGlsl, kToneGlsl } from "./tone.js";
import { kMostStored, kUnit } from "./units.js";

// What ends every surface: radiance in cd/m², or in false colours lux, as the target wants it.
export const kFinishGlsl = `
  uniform bool uEncode; // no pass follows that would: on headsets
  uniform bool uLux; // the light that arrives, in its colour
  uniform int uTone;
  uniform vec2 uGrade;
  uniform vec3 uExposure; // with the gains of the white balance
  uniform vec3 uMostRadiance; // cd/m2; lamps are no brighter, so that their edges are smooth
  uniform float uDither; // 1: the target has floats of 11, 11 and 10 bits, whose steps are hidden
  ${kDitherGlsl}
  ${kToneGlsl}
  const vec3 kStep = vec3(1.0, 1.0, 2.0) / 64.0;
  vec3 finish(vec3 radiance, vec3 lux) {
    vec3 dithered = 1.0 + uDither * (dither(gl_FragCoord.yx) - 0.5) * kStep;
    if (uLux) return min(lux / ${kUnit.toFixed(1)} * dithered, ${kMostStored.toFixed(1)});
    if (uEncode) return srgbEncode(toneCurve(radiance * uExposure, uTone, uGrade));
    return min(radiance * dithered, uMostRadiance) / ${kUnit.toFixed(1)};
  }`;

export const kSurfaceVertex = `
  precision highp sampler2D;
  in vec3 position;
  in vec3 normal;
  in vec2 lightUv;
  in vec2 tag;
  #ifdef HAS_UV
    in vec2 uv;
    out vec2 vUv;
  #endif
  #ifdef HAS_COLOR
    in vec4 color;
    out vec4 vColor;
  #endif
  uniform mat4 viewMatrix, projectionMatrix;
  uniform sampler2D uLight, uSurfaces;
  out vec3 vPosition, vNormal;
  centroid out vec2 vLightUv;
  #if defined(LEAN) && defined(HAS_NORMAL)
    out vec2 vAxesUv; // the same at the middle of a pixel, as derivatives want it
  #endif
  centroid out vec3 vLight;
  ${kSunGlsl}
  #ifdef SUN_TILE
    centroid out vec3 vSunLeft[2];
  #endif
  flat out int vLit; // above zero: light is that of the vertices
  // The material: fewer vertices than pixels ask for it.
  flat out vec4 vBase; // alpha: 1 - share that passes a pane
  flat out vec4 vEmission; // cd/m2; alpha: cut-off of the mask
  flat out vec4 vGloss; // roughness, metallic, transmission, packed image
  flat out vec4 vF0; // of a dielectric; alpha: f90
  void main() {
    vPosition = position;
    vNormal = normal;
    vLightUv = lightUv;
    #if defined(LEAN) && defined(HAS_NORMAL)
      vAxesUv = lightUv;
    #endif
    int material = int(tag.x);
    vBase = texelFetch(uSurfaces, ivec2(0, material), 0);
    vEmission = texelFetch(uSurfaces, ivec2(1, material), 0);
    vGloss = texelFetch(uSurfaces, ivec2(2, material), 0);
    vF0 = texelFetch(uSurfaces, ivec2(3, material), 0);
    vLit = int(tag.y);
    vLight = vec3(0.0);
    if (vLit > 0) {
      ivec2 size = textureSize(uLight, 0);
      vLight = texelFetch(uLight, min(ivec2(lightUv * vec2(size)), size - 1), 0).rgb;
    }
    #ifdef SUN_TILE
      for (int k = 0; k < 2; ++k) vSunLeft[k] = vLit > 0 && k < uSunCount ? sunLeft(k, lightUv) : vec3(0.0);
    #endif
    #ifdef HAS_UV
      vUv = uv;
    #endif
    #ifdef HAS_COLOR
      vColor = color;
    #endif
    gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
  }`;

// Defines: HAS_UV, HAS_COLOR, HAS_BASE or HAS_PACKED, HAS_NORMAL, HAS_ROUGHNESS, HAS_EMISSION; MASK; PANE, TINT; LEAN;
// SUN_TILE; PROBE with the sizes that three.js has for its filtered cube.
export const kSurfaceFragment = `
  precision highp float;
  precision highp int;
  precision highp sampler2D;
  #define texture2D texture
  #define texture2DGradEXT textureGrad
  uniform sampler2D uLight;
  #ifdef LEAN
    uniform sampler2D uLean;
  #endif
  uniform vec3 cameraPosition;
  uniform bool uReflect; // false where the probe itself is made
  uniform float uNormalScale;
  #ifdef HAS_BASE
    uniform sampler2D uBase;
  #endif
  #ifdef HAS_PACKED
    uniform highp sampler2DArray uPacked;
  #endif
  #ifdef HAS_NORMAL
    uniform sampler2D uNormal;
  #endif
  #ifdef HAS_ROUGHNESS
    uniform sampler2D uRoughness;
  #endif
  #ifdef HAS_EMISSION
    uniform sampler2D uEmission;
  #endif
  in vec3 vPosition, vNormal;
  centroid in vec3 vLight; // beyond the edge of a triangle it could be below zero
  centroid in vec2 vLightUv;
  #if defined(LEAN) && defined(HAS_NORMAL)
    in vec2 vAxesUv;
  #endif
  ${kSunGlsl}
  #ifdef SUN_TILE
    centroid in vec3 vSunLeft[2];
  #endif
  flat in int vLit;
  flat in vec4 vBase, vEmission, vGloss, vF0;
  #ifdef HAS_UV
    in vec2 vUv;
  #endif
  #ifdef HAS_COLOR
    in vec4 vColor;
  #endif
  out vec4 outColor;
  ${kFinishGlsl}
  #define ENVMAP_TYPE_CUBE_UV
  #include <cube_uv_reflection_fragment>

  const float kPi = 3.14159265, kMostTowards = 4.0;
  float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

  // Directional albedo of GGX: f0 * x + f90 * y (fit of Karis 2014, "Physically based shading on mobile").
  vec2 specularTerms(float cosine, float roughness) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * cosine)) * r.x + r.y;
    return vec2(-1.04, 1.04) * a + r.zw;
  }

  // GGX over the cosine of the viewer, times that of the light (Walter et al. 2007; Smith's masking as Heitz 2014 has
  // it for both ways), without Fresnel.
  float lobe(vec3 n, vec3 v, vec3 l, vec3 h, float alpha) {
    float nv = max(dot(n, v), 1e-4), nl = max(dot(n, l), 1e-4), nh = dot(n, h), a2 = alpha * alpha;
    float k = nh * nh * (a2 - 1.0) + 1.0;
    float masked = nl * sqrt(a2 + (1.0 - a2) * nv * nv) + nv * sqrt(a2 + (1.0 - a2) * nl * nl);
    return a2 / (kPi * k * k) * 0.5 / masked * nl;
  }

  #ifdef PROBE
    ${kReflectionGlsl(kUnit.toFixed(1))}
  #else
    vec3 reflected(vec3 n, vec3 v, float roughness, float weight, vec3 lux) { return lux / kPi; }
  #endif

  #ifdef HAS_NORMAL
    // Unit axes along which coordinates grow, from how place and coordinates change over the screen; zero where these
    // do not.
    mat2x3 axesOf(vec2 coordinates, vec3 n) {
      vec3 px = dFdx(vPosition), py = dFdy(vPosition);
      vec2 tx = dFdx(coordinates), ty = dFdy(coordinates);
      vec3 across = cross(py, n), along = cross(n, px);
      vec3 t = across * tx.x + along * ty.x, b = across * tx.y + along * ty.y;
      return mat2x3(t * inversesqrt(max(dot(t, t), 1e-30)), b * inversesqrt(max(dot(b, b), 1e-30)));
    }
  #endif

  // How much more light arrives from where a normal map turns a place to. Layers tell it on charts; elsewhere the probe
  // does, for the room as a whole, with the lamps as they are dimmed.
  float towards(vec3 n) {
    #if defined(HAS_NORMAL) && defined(LEAN)
      vec3 side = normalize(vNormal);
      mat2x3 axes = axesOf(vAxesUv, side);
      vec3 lean = texture(uLean, vLightUv).rgb;
      if (vLit == 0 && lean.b > 0.0) {
        vec2 along = 4.0 * lean.rg / lean.b - 2.0;
        return clamp(dot(n, side) + dot(along, n * axes), 0.0, kMostTowards);
      }
    #endif
    #if defined(HAS_NORMAL) && defined(PROBE)
      if (!uReflect) return 1.0;
      float there = luminance(textureCubeUV(uProbe, n, 1.0).rgb);
      float here = luminance(textureCubeUV(uProbe, normalize(vNormal), 1.0).rgb);
      return here > 0.0 ? clamp(there / here, 0.5, 2.0) : 1.0;
    #else
      return 1.0;
    #endif
  }

  vec3 shadingNormal() {
    vec3 n = normalize(vNormal);
    #ifdef HAS_NORMAL
      vec3 m = texture(uNormal, vUv).xyz * 2.0 - 1.0;
      n = normalize(axesOf(vUv, n) * (vec2(m.x, -m.y) * uNormalScale) + m.z * n);
    #endif
    return n;
  }

  void main() {
    vec4 base = vBase, emission = vEmission, gloss = vGloss;
    #ifdef HAS_BASE
      base *= texture(uBase, vUv);
    #endif
    #ifdef HAS_PACKED
      base.rgb *= texture(uPacked, vec3(vUv, gloss.w)).rgb;
    #endif
    #ifdef HAS_COLOR
      base *= vColor;
    #endif
    #ifdef MASK
      if (base.a < emission.a) discard;
    #endif
    #ifdef HAS_ROUGHNESS
      gloss.xy *= texture(uRoughness, vUv).gb;
    #endif
    #ifdef HAS_EMISSION
      emission.rgb *= texture(uEmission, vUv).rgb;
    #endif
    vec3 lux = max(vLit > 0 ? vLight : texture(uLight, vLightUv).rgb, 0.0) * ${kUnit.toFixed(1)};
    vec3 v = normalize(cameraPosition - vPosition);
    vec3 n = shadingNormal();
    if (dot(n, v) < 0.0) n = normalize(n - 1.02 * dot(n, v) * v);
    float roughness = clamp(gloss.x, 0.045, 1.0);
    vec2 terms = specularTerms(clamp(dot(n, v), 0.0, 1.0), roughness);
    vec3 specular = mix(vF0.rgb, base.rgb, gloss.y) * terms.x + mix(vF0.a, 1.0, gloss.y) * terms.y;
    float kept = 1.0 - min(1.0, max(specular.r, max(specular.g, specular.b)));
    vec3 straight = vec3(0.0), turned = vec3(0.0), glint = vec3(0.0);
    #ifdef SUN_TILE
      for (int k = 0; k < uSunCount; ++k) {
        vec3 arrives = (vLit > 0 ? max(vSunLeft[k], 0.0) : sunLeft(k, vLightUv)) * uSunLux[k] * ${kUnit.toFixed(1)};
        vec3 l = uSunDirection[k];
        straight += arrives * max(dot(normalize(vNormal), l), 0.0);
        turned += arrives * max(dot(n, l), 0.0);
        if (!uReflect || dot(n, l) <= 0.0 || arrives.g <= 0.0) continue;
        vec3 h = normalize(v + l);
        // As wide as the sun's disc at least: what a smooth surface mirrors is half as wide in half vectors.
        float alpha = length(vec2(roughness * roughness, 0.5 * uSunSize[k]));
        float grazing = pow(clamp(1.0 - dot(h, v), 0.0, 1.0), 5.0);
        vec3 fresnel = mix(mix(vF0.rgb, base.rgb, gloss.y), vec3(mix(vF0.a, 1.0, gloss.y)), grazing);
        glint += arrives * fresnel * lobe(n, v, l, h, alpha);
      }
    #endif
    vec3 diffuse = base.rgb * (1.0 - gloss.y) * kept * (lux * towards(n) + turned) / kPi;
    // Where there is neither glint nor probe, the sun's light is reflected as all other light is.
    vec3 mirrored = uReflect ? lux : lux + straight;
    vec3 shine = glint;
    float matt = luminance(base.rgb) * (1.0 - gloss.y) * kept;
    if (kept < 1.0) shine += specular * reflected(n, v, roughness, (1.0 - kept) / (1.0 - kept + matt), mirrored);
    lux += straight;
    #ifdef PANE
      // Alpha of a colour: how much of a place is covered at all. What lies behind passes by that of the target.
      vec3 passes = mix(vec3(1.0), gloss.z * base.rgb * kept, base.a);
      if (uLux) passes = vec3(1.0 - base.a); // hides what lies behind: that is lit otherwise
      #ifdef TINT
        outColor = vec4(passes, 1.0);
      #else
        vec3 own = diffuse * (1.0 - gloss.z) + shine + emission.rgb;
        outColor = vec4(uLux ? vec3(0.0) : finish(own * base.a, lux), luminance(passes));
      #endif
    #else
      // A probe asks how far things are, too.
      outColor = vec4(finish(diffuse + shine + emission.rgb, lux), 1.0);
      if (!uReflect) outColor.a = distance(vPosition, cameraPosition);
    #endif
  }`;
