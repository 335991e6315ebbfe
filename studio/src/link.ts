// The line to what answers: JSON in both directions, answers as bytes. A server (`server.ts`), or the
// program in this tab (`offline/link.ts`).

import type { Heard, SaidMessage } from "./messages";

const SCENE = "dam-studio-scene";
// What is kept for this window, by its key.
export const TOKEN = "dam-studio-token",
  TAB = "dam-studio-tab";

// The scene that this window shows, so that it does when it is loaded anew; empty: the first page.
export const shownScene = {
  get: (): string | null => sessionStorage.getItem(SCENE),
  set: (scene: string): void => sessionStorage.setItem(SCENE, scene),
  forget: (): void => sessionStorage.removeItem(SCENE),
};

// What the user chose: in this browser, and with the server for others and for later ones, as
// what a browser keeps goes with the port.
export class Kept {
  constructor(private readonly name: string) {}
  private get key(): string {
    return `dam-studio-${this.name}`;
  }
  get(): string | null {
    try {
      return localStorage.getItem(this.key);
    } catch {
      return null;
    }
  }
  set(value: string, link: Link): void {
    this.take(value);
    link.send({ type: "keep", name: this.name, value });
  }
  // From the server, where this browser has nothing; true: it is taken.
  offer(settings: Record<string, string>): boolean {
    const value = settings[this.name];
    if (value === undefined || this.get() !== null) return false;
    this.take(value);
    return this.get() !== null;
  }
  // A browser that keeps nothing has it for this page alone.
  private take(value: string): void {
    try {
      localStorage.setItem(this.key, value);
    } catch {
      /* Nothing more can be done. */
    }
  }
}

export interface Link {
  // Whether something answers at present; whether anything is known that could.
  readonly isOpen: boolean;
  readonly known: boolean;
  answer: (frame: ArrayBuffer) => void;
  state: (connected: boolean) => void;
  on<K extends keyof Heard>(type: K, act: (message: Heard[K]) => void): void;
  connect(): void;
  // False: nothing hears it.
  send(message: SaidMessage): boolean;
  get<T>(path: string): Promise<T>;
  text(path: string): Promise<string>;
}
