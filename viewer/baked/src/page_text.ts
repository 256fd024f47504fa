// Bytes in a page as text in base 125 (docs/reference/baked.md).
import { BadFile } from "./bad_file.js";

const kBase = 125;
const kBytes = 6; // of a group, which is one character longer
const kHalf = 2 ** 24; // of a group
const kReturn = 13;
const kLess = 60;

// Values of characters; -1 where one is no digit.
const kDigits = Int8Array.from({ length: 128 }, (_, code) =>
  code === 0 || code === kReturn || code === kLess ? -1 : code - 1 - Number(code > kReturn) - Number(code > kLess),
);

// Throws BadFile where the text is none.
export function bytesOf(text: string): Uint8Array {
  const left = text.length % (kBytes + 1);
  if (left === 1) throw new BadFile("cut", `${text.length} characters`);
  const bytes = new Uint8Array(text.length - Math.ceil(text.length / (kBytes + 1)));
  let end = 0;
  for (let from = 0; from < text.length; from += kBytes + 1) {
    const until = Math.min(from + kBytes + 1, text.length);
    let group = 0; // below 125^7, which is below 2^53
    for (let i = from; i < until; ++i) {
      const digit = kDigits[text.charCodeAt(i)] ?? -1;
      if (digit < 0) throw new BadFile("damaged", `character ${i}`);
      group = group * kBase + digit;
    }
    const count = until - from - 1;
    if (group >= 256 ** count) throw new BadFile("damaged", `character ${from}`);
    // Whole numbers of 24 bits are quick.
    const high = Math.floor(group / kHalf);
    const low = group - high * kHalf;
    for (let i = 0; i < count; ++i) bytes[end + count - 1 - i] = i < 3 ? low >>> (8 * i) : high >>> (8 * (i - 3));
    end += count;
  }
  return bytes;
}
