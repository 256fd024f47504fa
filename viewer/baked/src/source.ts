// Finds the file of the home: in the page as text, or beside it.
import { BadFile } from "./bad_file.js";
import { bytesOf } from "./page_text.js";
import { inflate } from "./texels.js";

const kId = "roomlight-home";

// `progress`: share that has come.
export async function homeBytes(progress: (share: number) => void): Promise<Uint8Array> {
  const element = document.getElementById(kId);
  if (element instanceof HTMLScriptElement) {
    const text = element.textContent ?? "";
    element.textContent = "";
    if (text === "") throw new BadFile("missing");
    const bytes = bytesOf(text);
    const unpacked = Number(element.dataset.bytes ?? 0); // of a zlib stream
    return unpacked > 0 ? inflate(bytes, unpacked, "home") : bytes;
  }
  if (element instanceof HTMLLinkElement) return download(element.href, progress);
  throw new BadFile("missing");
}

async function download(address: string, progress: (share: number) => void): Promise<Uint8Array> {
  if (location.protocol === "file:") throw new BadFile("unserved"); // browsers let pages read no files
  const response = await fetch(address).catch(() => null);
  if (!response?.ok || !response.body) throw new BadFile("missing", address.slice(address.lastIndexOf("/") + 1));
  const expected = Number(response.headers.get("content-length") ?? 0);
  const parts: Uint8Array[] = [];
  let length = 0;
  const reader = response.body.getReader();
  for (;;) {
    const part = await reader.read().catch(() => null);
    if (!part) throw new BadFile("cut", `${length} bytes`);
    if (part.done) break;
    parts.push(part.value);
    length += part.value.length;
    if (expected > 0) progress(Math.min(1, length / expected));
  }
  const bytes = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}
