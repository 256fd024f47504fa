// What pictures being drawn are made of: the format of their pixels and the samples of each.

// Half of what 16-bit floats ask of the memory. Display hides their steps.
const kShortFloats = 0x8c3a; // R11F_G11F_B10F
const kHalfFloats = 0x881a; // RGBA16F

export interface PixelFormat {
  readonly short: boolean; // floats of 11 and 10 bits, else of 16
  readonly samples: number;
}

// Infinity: the browser does not tell.
function mostSamples(gl: WebGL2RenderingContext, format: number): number {
  const counts = gl.getInternalformatParameter(gl.RENDERBUFFER, format, gl.SAMPLES) as Int32Array | null;
  return counts ? (counts[0] ?? 0) : Infinity; // the largest comes first
}

// Short floats where the chip draws into them with as many samples as into 16-bit ones, up to `wanted`.
export function pixelFormat(gl: WebGL2RenderingContext, wanted: number): PixelFormat {
  const samplesOf = (format: number) => Math.min(wanted, mostSamples(gl, format));
  if (!gl.getExtension("EXT_color_buffer_float")) return { short: false, samples: samplesOf(kHalfFloats) };
  const short = samplesOf(kShortFloats);
  const half = samplesOf(kHalfFloats);
  return short >= half ? { short: true, samples: short } : { short: false, samples: half };
}
