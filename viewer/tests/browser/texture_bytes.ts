// Bytes that the textures and buffers of pictures of a page take on the chip, told by `window.textureBytes`.
import type { Page } from "playwright-core";

// In the page, before its own scripts: every call that makes, fills or deletes such memory is counted.
function countBytes(): void {
  const gl = WebGL2RenderingContext.prototype;
  // By internal format; what is not here takes four bytes.
  const sizes = new Map<number, number>([
    [0x8229, 1], // R8
    [0x822b, 2], // RG8
    [0x822d, 2], // R16F
    [0x822e, 4], // R32F
    [0x881a, 8], // RGBA16F
    [0x8814, 16], // RGBA32F
    [0x81a5, 2], // DEPTH_COMPONENT16
    [0x8cad, 8], // DEPTH32F_STENCIL8
  ]);
  const levels = new Map<object, Map<string, number>>();
  const note = (thing: object | null, level: string, format: number, texels: number) => {
    if (!thing) return;
    if (!levels.has(thing)) levels.set(thing, new Map());
    levels.get(thing)!.set(level, texels * (sizes.get(format) ?? 4));
  };
  (window as unknown as { textureBytes: () => number }).textureBytes = () => {
    let sum = 0;
    for (const held of levels.values()) for (const bytes of held.values()) sum += bytes;
    return sum;
  };
  const bindings = new Map<number, number>([
    [0x0de1, 0x8069], // TEXTURE_2D
    [0x8c1a, 0x8c1d], // TEXTURE_2D_ARRAY
    [0x806f, 0x806a], // TEXTURE_3D
  ]);
  const boundAt = (context: WebGL2RenderingContext, target: number) =>
    context.getParameter(bindings.get(target) ?? 0x8514) as object | null; // else a face of a cube
  const pyramid = (texels: number, count: number) => {
    let sum = 0;
    for (let level = 0; level < count; ++level) sum += Math.max(1, texels / 4 ** level);
    return sum;
  };
  const wrap = (name: string, then: (context: WebGL2RenderingContext, args: number[]) => void) => {
    const methods = gl as unknown as Record<string, (...args: unknown[]) => unknown>;
    const own = methods[name]!;
    methods[name] = function (this: WebGL2RenderingContext, ...args: unknown[]) {
      const result = own.apply(this, args);
      then(this, args as number[]);
      return result;
    };
  };
  wrap("texStorage2D", (context, [target, count, format, width, height]) => {
    const faces = target === 0x8513 ? 6 : 1;
    note(boundAt(context, target!), "all", format!, faces * pyramid(width! * height!, count!));
  });
  wrap("texStorage3D", (context, [target, count, format, width, height, depth]) =>
    note(boundAt(context, target!), "all", format!, depth! * pyramid(width! * height!, count!)),
  );
  wrap("texImage2D", (context, args) => {
    const [target, level, format] = args as [number, number, number];
    const image = args[5] as unknown as { width: number; height: number } | undefined;
    const [width, height] = args.length > 6 ? [args[3]!, args[4]!] : [image?.width ?? 0, image?.height ?? 0];
    note(boundAt(context, target), `${target} ${level}`, format, width * height);
  });
  wrap("deleteTexture", (_, [texture]) => levels.delete(texture as unknown as object));
  wrap("renderbufferStorageMultisample", (context, [, samples, format, width, height]) =>
    note(context.getParameter(0x8ca7) as object, "all", format!, Math.max(1, samples!) * width! * height!),
  );
  wrap("renderbufferStorage", (context, [, format, width, height]) =>
    note(context.getParameter(0x8ca7) as object, "all", format!, width! * height!),
  );
  wrap("deleteRenderbuffer", (_, [buffer]) => levels.delete(buffer as unknown as object));
}

export async function countTextureBytes(page: Page): Promise<void> {
  await page.addInitScript(countBytes);
}

export const textureBytes = (page: Page): Promise<number> =>
  page.evaluate(() => (window as unknown as { textureBytes: () => number }).textureBytes());
