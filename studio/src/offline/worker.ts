// A worker with the program in it: one request at a time, told as it is found.

interface Kernel {
  memory: WebAssembly.Memory;
  room(length: number): number;
  ask(): void;
}
export type Found = { text: string } | { answer: ArrayBuffer } | { done: true } | { failed: string };

const scope = self as unknown as {
  onmessage: ((event: MessageEvent) => void) | null;
  postMessage(found: Found, transfer?: Transferable[]): void;
};
const encoder = new TextEncoder(),
  decoder = new TextDecoder();
let kernel: Promise<Kernel> | null = null,
  failed = "";

async function begin(module: WebAssembly.Module): Promise<Kernel> {
  const bytes = (at: number, length: number) => new Uint8Array(made.memory.buffer, at, length);
  const page = {
    milliseconds: () => performance.now(),
    text: (at: number, length: number) => scope.postMessage({ text: decoder.decode(bytes(at, length)) }),
    answer: (at: number, length: number) => {
      const answer = bytes(at, length).slice().buffer;
      scope.postMessage({ answer }, [answer]);
    },
    failed: (at: number, length: number) => {
      failed = decoder.decode(bytes(at, length));
    },
  };
  const made = (await WebAssembly.instantiate(module, { page })).exports as unknown as Kernel;
  return made;
}

// Where the program ends without a word there was no more memory to be had.
const MEMORY = "the computation took too much memory and was ended";

async function answer(request: string): Promise<Found> {
  const { memory, room, ask } = await kernel!,
    written = encoder.encode(request);
  failed = "";
  try {
    const at = room(written.length);
    new Uint8Array(memory.buffer, at, written.length).set(written);
    ask();
  } catch (error) {
    return {
      failed: failed
        ? `the computation failed; this is an error of the program, not of the scene: ${failed}`
        : error instanceof WebAssembly.RuntimeError
          ? MEMORY
          : String(error),
    };
  }
  return failed ? { failed } : { done: true };
}

scope.onmessage = async (event) => {
  if (event.data instanceof WebAssembly.Module) kernel = begin(event.data);
  else scope.postMessage(await answer(event.data as string));
};
