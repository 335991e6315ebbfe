// A desk: a worker that answers the newest request; what goes on too long beside a newer one is ended
// with its worker, and another takes its place.

import type { Found } from "./worker";
import Program from "./worker?worker&inline";

// How long a request goes on after it was superseded (ms).
const GRACE = 400;

export interface Request {
  ask: string;
  [name: string]: unknown;
}

export class Desk {
  private worker: Worker | null = null;
  private begun: number | null = null;
  private waiting: Request[] = [];
  private late = 0;
  // Something was told that was not taken up yet: the next waits.
  private owed = 0;

  constructor(
    private readonly kernel: Promise<WebAssembly.Module>,
    private readonly hear: (found: { text: string } | { answer: ArrayBuffer }) => void,
    private readonly failed: (words: string, request: Request) => void,
    // Answers are taken up one after the other.
    private readonly isPaced = false,
  ) {}

  // In place of all that wait of the same sort; `isUrgent` false: it waits for its turn, and ends nothing.
  submit(request: Request, isUrgent = true): void {
    if (isUrgent) this.waiting = this.waiting.filter((one) => one.ask !== request.ask);
    this.waiting.push(request);
    if (this.begun === null) {
      void this.next();
      return;
    }
    if (!isUrgent || this.late) return;
    this.late = setTimeout(() => this.end(), Math.max(0, GRACE - (performance.now() - this.begun)));
  }

  get isIdle(): boolean {
    return this.begun === null && !this.waiting.length;
  }

  // What was told was taken up.
  taken(): void {
    this.owed = Math.max(0, this.owed - 1);
    if (this.begun === null) void this.next();
  }

  private request: Request | null = null;

  private async next(): Promise<void> {
    if (this.begun !== null || !this.waiting.length || (this.isPaced && this.owed)) return;
    this.begun = performance.now();
    try {
      this.worker ??= await this.hired();
    } catch (error) {
      const refused = this.waiting.splice(0);
      this.rest();
      for (const request of refused)
        this.failed(`the program in this page cannot be started: ${(error as Error).message}`, request);
      return;
    }
    this.begun = performance.now();
    this.request = this.waiting.shift()!;
    this.worker.postMessage(JSON.stringify(this.request));
  }

  private async hired(): Promise<Worker> {
    const module = await this.kernel,
      worker = new Program();
    worker.onmessage = (event: MessageEvent<Found>) => {
      if (worker !== this.worker) return;
      const found = event.data;
      if ("text" in found) this.hear(found);
      else if ("answer" in found) {
        if (this.isPaced) this.owed++;
        this.hear(found);
      } else {
        const request = this.request!;
        if ("failed" in found) {
          this.dismiss();
          this.failed(found.failed, request);
        } else this.rest();
        void this.next();
      }
    };
    worker.onerror = (event) => {
      if (worker === this.worker) {
        const request = this.request;
        this.dismiss();
        if (request) this.failed(event.message || "the worker ended", request);
        void this.next();
      }
    };
    worker.postMessage(module);
    return worker;
  }

  private rest(): void {
    this.begun = null;
    this.request = null;
    clearTimeout(this.late);
    this.late = 0;
  }

  private dismiss(): void {
    this.worker?.terminate();
    this.worker = null;
    this.rest();
  }

  // Ends what is under way; what waits goes on.
  private end(): void {
    if (this.request) this.dismiss();
    else this.late = 0;
    void this.next();
  }
}
