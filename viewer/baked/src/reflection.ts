// Reflections: what a mirrored ray meets of what the room's probe sees.

// Points of a square that spread well however many of them there are (R2 sequence, Roberts 2018).
export const kR2 = [0.75487767, 0.56984029] as const;

// Needs kPi, kUnit's factor and three.js' cube_uv_reflection_fragment above it.
export const kReflectionGlsl = (unit: string): string => `
  uniform sampler2D uProbe;
  uniform highp samplerCube uAround; // alpha: metres from the probe to what it sees
  uniform vec3 uProbeAt;
  uniform float uPicture; // which of those that are averaged; below zero: it stands alone
  const float kSmooth = 0.12, kFaint = 0.15, kStrong = 0.5, kRough = 0.8, kFarthestM = 200.0, kNearM = 1.0;
  const float kWideSteps = 14.0, kHalfTexel = 1.41421 / exp2(CUBEUV_MAX_MIP);
  const int kRays = 6, kMostRays = 12, kMostSteps = 24, kHalvings = 5;

  // A ray as the probe sees it: it comes nearest to the probe at foot, and sweeps angles from there.
  struct Ray {
    vec3 foot; // towards it, of length 1
    float height; // metres from the probe to the foot
    vec3 direction;
  };
  struct Step {
    float angle;
    vec3 towards; // from the probe
    float range; // metres from the probe to the ray
    float seen; // metres from the probe to what it sees there
  };
  Step stepAt(Ray ray, float angle) {
    vec3 at = ray.height * (ray.foot + sin(angle) / max(cos(angle), 1e-5) * ray.direction);
    float range = max(length(at), 1e-3);
    return Step(angle, at / range, range, textureLod(uAround, at, 0.0).a);
  }
  // What the distance of the surface that a ray starts from may be off by in a texel of the probe: the more, the
  // flatter the probe looks at it. side: its normal.
  float slackM(Step s, vec3 side) { return 0.03 + kHalfTexel * s.range / max(abs(dot(s.towards, side)), 0.05); }
  bool hides(Step s, float slack) { return s.seen < s.range - slack; }

  struct Sight {
    bool found;
    vec3 at; // from the probe
    float distanceM; // 0: a guess
  };
  // Follows a ray from a surface until it meets what the probe sees. Nothing is found where it ends at what the probe
  // does not see. A ray that goes behind something and comes out again was not held up; one that comes out through a
  // surface was. side: the surface's normal.
  Sight follow(vec3 from, vec3 direction, vec3 side) {
    float along = dot(from, direction);
    vec3 foot = from - along * direction;
    float height = max(length(foot), 1e-3);
    Ray ray = Ray(foot / height, height, direction);
    float last = atan(along + kFarthestM, height);
    Step near = stepAt(ray, atan(along, height));
    float wide = (last - near.angle) / kWideSteps, next = wide;
    bool hidden = hides(near, slackM(near, side)), inSight = !hidden;
    Sight guess = Sight(false, direction, 0.0);
    for (int i = 0; i < kMostSteps && near.angle < last; ++i) {
      Step far = stepAt(ray, min(near.angle + next, last));
      // Just above its own surface a ray may lie behind that by a texel.
      float above = dot(far.range * far.towards - from, side);
      float own = slackM(far, side) * clamp(1.0 - above / (2.0 * kHalfTexel * far.range), 0.0, 1.0);
      if (hides(far, own) == hidden) {
        near = far;
        next = min(1.6 * next, wide);
        continue;
      }
      Step before = near;
      for (int k = 0; k < kHalvings; ++k) {
        Step middle = stepAt(ray, 0.5 * (before.angle + far.angle));
        if (hides(middle, own) == hidden) before = middle;
        else far = middle;
      }
      // At an edge what is seen jumps, and the ray passes well behind it.
      float behind = hidden ? before.range - before.seen : far.range - far.seen;
      if (min(abs(before.seen - far.seen), behind) < 0.03 + 0.04 * before.seen)
        return Sight(!hidden, before.range * before.towards, height * tan(before.angle) - along);
      // If it does not come out again, what is seen beside the edge goes on behind it.
      if (!hidden && inSight) guess = Sight(true, before.towards, 0.0);
      hidden = !hidden;
      near = far;
      next = 0.125 * wide;
    }
    if (hidden || near.angle < last) return guess;
    return Sight(true, kFarthestM * near.towards, kFarthestM);
  }

  // A normal of the microfacets that are seen from v, in the frame of the surface (Heitz 2018).
  vec3 microNormal(vec3 v, float alpha, vec2 u) {
    vec3 stretched = normalize(vec3(alpha * v.xy, v.z));
    float flat2 = dot(stretched.xy, stretched.xy);
    vec3 t = flat2 > 1e-8 ? vec3(-stretched.y, stretched.x, 0.0) * inversesqrt(flat2) : vec3(1.0, 0.0, 0.0);
    vec3 b = cross(stretched, t);
    float r = sqrt(u.x), phi = 2.0 * kPi * u.y, s = 0.5 + 0.5 * stretched.z;
    vec2 p = r * vec2(cos(phi), sin(phi));
    p.y = mix(sqrt(max(0.0, 1.0 - p.x * p.x)), p.y, s);
    vec3 m = p.x * t + p.y * b + sqrt(max(0.0, 1.0 - dot(p, p))) * stretched;
    return normalize(vec3(alpha * m.xy, max(m.z, 1e-3)));
  }

  // Radiance in cd/m2 along a mirrored ray; mean where the probe does not see what is there.
  vec3 seenAlong(vec3 direction, vec3 side, float roughness, vec3 mean) {
    direction -= 2.0 * min(dot(direction, side), 0.0) * side;
    Sight sight = follow(vPosition - uProbeAt, direction, side);
    if (!sight.found) return mean;
    vec3 sharp = textureLod(uAround, sight.at, 0.0).rgb * ${unit};
    bool single = uPicture < 0.0 && roughness >= kSmooth;
    if (sight.distanceM <= 0.0 && !single) return sharp;
    // Blurred by what the lobe is wide there, seen from the probe; but what is far brighter before it or behind it is
    // not what the ray meets. A single picture has no other rays to tell.
    float wide = min(roughness * sqrt(max(sight.distanceM, kNearM) / length(sight.at)), 1.0);
    vec3 blurred = textureCubeUV(uProbe, normalize(sight.at), wide).rgb * ${unit};
    float most = 3.0 * luminance(sharp) + (single ? 1.0 : 0.2) * luminance(mean);
    return blurred * min(1.0, most / max(luminance(blurred), 1e-4));
  }

  // Two numbers of a pixel, from 0 to 1, that have nothing to do with those of its neighbours (PCG, Jarzynski and
  // Olano 2020).
  vec2 scattered(uvec2 pixel) {
    uvec2 x = pixel * 1664525u + 1013904223u;
    x.x += x.y * 1664525u;
    x.y += x.x * 1664525u;
    x ^= x >> 16u;
    x.x += x.y * 1664525u;
    x.y += x.x * 1664525u;
    x ^= x >> 16u;
    return vec2(x) / 4294967296.0;
  }

  // A ray of the lobe: another one for each picture of those that are averaged, and for each pixel.
  vec3 sampleLobe(vec3 n, vec3 v, float alpha, vec2 u) {
    vec3 t = normalize(abs(n.y) < 0.9 ? vec3(n.z, 0.0, -n.x) : vec3(0.0, n.z, -n.y)), b = cross(n, t);
    vec3 from = vec3(dot(v, t), dot(v, b), dot(v, n));
    vec3 d = reflect(-from, microNormal(from, alpha, u));
    return d.x * t + d.y * b + d.z * n;
  }

  // Radiance that a surface reflects, in cd/m2. What is very rough reflects the mean of what arrives. A single picture
  // follows one ray, where most of the light comes from (Lagarde and de Rousiers 2014), and blurs what it meets.
  // weight: what is reflected, as a share of all that the surface sends back. On black ones nothing hides the noise.
  vec3 reflected(vec3 n, vec3 v, float roughness, float weight, vec3 lux) {
    vec3 mean = lux / kPi;
    if (!uReflect || roughness >= kRough) return mean;
    float alpha = roughness * roughness;
    vec3 side = normalize(vNormal), seen = vec3(0.0);
    if (dot(side, v) < 0.0) side = -side;
    bool lone = uPicture < 0.0 || roughness < kSmooth;
    int rays = lone ? 1 : weight < kFaint ? 2 : weight < kStrong ? kRays : kMostRays;
    vec3 most = normalize(mix(n, reflect(-v, n), (1.0 - alpha) * (sqrt(1.0 - alpha) + alpha)));
    vec2 start = scattered(uvec2(gl_FragCoord.xy));
    for (int k = 0; k < rays; ++k) {
      vec2 u = fract(start + (uPicture * float(rays) + float(k)) * vec2(${kR2[0]}, ${kR2[1]}));
      vec3 ray = lone ? most : sampleLobe(n, v, 0.5 * alpha, u);
      seen += seenAlong(ray, side, (lone ? 1.0 : 0.93) * roughness, mean) / float(rays);
    }
    return mix(seen, mean, smoothstep(0.6, kRough, roughness));
  }`;
