import assert from "node:assert/strict";
import { test } from "node:test";
import { pixelFormat } from "../../baked/src/pixel_format.js";

// A chip with so many samples of short floats, null: it does not draw into them; and of half floats, null: it does not
// tell.
function chip(short: readonly number[] | null, half: readonly number[] | null): WebGL2RenderingContext {
  return {
    RENDERBUFFER: 0x8d41,
    SAMPLES: 0x80a9,
    getExtension: (name: string) => (short && name === "EXT_color_buffer_float" ? {} : null),
    getInternalformatParameter: (target: number, format: number, name: number) => {
      assert.equal(target, 0x8d41);
      assert.equal(name, 0x80a9);
      const counts = format === 0x8c3a ? (short ?? []) : format === 0x881a ? half : [];
      return counts && Int32Array.from(counts);
    },
  } as unknown as WebGL2RenderingContext;
}

test("short floats where they are as smooth, up to the samples that are asked for", () => {
  assert.deepEqual(pixelFormat(chip([8, 4, 2], [8, 4, 2]), 4), { short: true, samples: 4 });
  assert.deepEqual(pixelFormat(chip([4], [16, 4]), 4), { short: true, samples: 4 });
  assert.deepEqual(pixelFormat(chip([], []), 4), { short: true, samples: 0 });
});

test("half floats where short ones have fewer samples or cannot be drawn into", () => {
  assert.deepEqual(pixelFormat(chip([], [4, 2]), 4), { short: false, samples: 4 });
  assert.deepEqual(pixelFormat(chip([2], [4]), 4), { short: false, samples: 4 });
  assert.deepEqual(pixelFormat(chip(null, [2]), 4), { short: false, samples: 2 });
  assert.deepEqual(pixelFormat(chip(null, null), 4), { short: false, samples: 4 });
});
