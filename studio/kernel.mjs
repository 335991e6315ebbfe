// The program as WebAssembly outside of a browser: for building the single file, and for its test.

export class Kernel {
  static async of(program) {
    const kernel = new Kernel(),
      decoder = new TextDecoder();
    const bytes = (at, length) => new Uint8Array(kernel.made.memory.buffer, at, length);
    const page = {
      milliseconds: () => performance.now(),
      text: (at, length) => {
        kernel.told.push(decoder.decode(bytes(at, length)));
      },
      answer: (at, length) => {
        kernel.answers.push(bytes(at, length).slice());
      },
      failed: (at, length) => {
        kernel.failed = decoder.decode(bytes(at, length));
      },
    };
    kernel.made = (await WebAssembly.instantiate(program, { page })).instance.exports;
    return kernel;
  }

  // The messages that answer a request; the answers with numbers are in `answers`.
  ask(request) {
    const written = new TextEncoder().encode(JSON.stringify(request));
    this.told = [];
    this.answers = [];
    this.failed = "";
    const at = this.made.room(written.length);
    new Uint8Array(this.made.memory.buffer, at, written.length).set(written);
    this.made.ask();
    if (this.failed) throw new Error(this.failed);
    return this.told;
  }
}
