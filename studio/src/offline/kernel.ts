// The program as it lies in the page: WebAssembly, compressed, as text.

import { XzReadableStream } from "xz-decompress";

const bytes = (text: string): Uint8Array => Uint8Array.from(atob(text), (one) => one.charCodeAt(0));

const stream = (bytes: Uint8Array) => new Blob([bytes as BlobPart]).stream();

export async function kernel(): Promise<WebAssembly.Module> {
  const element = document.getElementById("kernel");
  const packed = bytes(element?.textContent?.trim() ?? "");
  element?.remove();
  return WebAssembly.compile(await new Response(new XzReadableStream(stream(packed))).arrayBuffer());
}

// What this browser lacks; null: nothing.
export function lack(): string | null {
  if (typeof WebAssembly === "undefined") return "WebAssembly";
  if (typeof DecompressionStream === "undefined") return "DecompressionStream";
  if (typeof Worker === "undefined") return "workers";
  return null;
}

// A scene in an address: compressed, in letters that an address may have.
export async function packedScene(text: string): Promise<string> {
  const deflated = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const packed = new Uint8Array(await new Response(deflated).arrayBuffer());
  let letters = "";
  for (const byte of packed) letters += String.fromCharCode(byte);
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

// The text again. Of an address that is too long when it is unpacked, or is none, it throws.
export async function unpackedScene(letters: string): Promise<string> {
  const packed = stream(bytes(letters.replaceAll("-", "+").replaceAll("_", "/")));
  const reader = packed.pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  const parts: Uint8Array[] = [];
  for (let size = 0; ; ) {
    const { done, value } = await reader.read();
    if (done) break;
    parts.push(value);
    size += value.length;
    if (size > 1 << 20) {
      void reader.cancel();
      throw new Error("the scene is larger than 1 MB");
    }
  }
  return new TextDecoder("utf-8", { fatal: true }).decode(await new Blob(parts as BlobPart[]).arrayBuffer());
}
