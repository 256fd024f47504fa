// Writes bytes as the program does into a page (docs/reference/baked.md).
const kCharacters = Array.from({ length: 128 }, (_, code) => String.fromCharCode(code)).filter(
  character => !"\0\r<".includes(character),
);

export function textOf(bytes: Uint8Array): string {
  let text = "";
  for (let from = 0; from < bytes.length; from += 6) {
    const part = bytes.subarray(from, from + 6);
    let group = part.reduce((sum, byte) => sum * 256n + BigInt(byte), 0n);
    let digits = "";
    for (let k = 0; k <= part.length; ++k, group /= 125n) digits = kCharacters[Number(group % 125n)]! + digits;
    text += digits;
  }
  return text;
}
