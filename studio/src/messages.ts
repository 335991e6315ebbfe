// What goes over the line, by the type of the message. `unit/messages.test.ts` compares what a window
// says with what the program takes (`src/studio/messages.rs`).

import type { Outline } from "./graph";
import type { Field } from "./numbers";

// Changes of a text, as the editor writes them.
export type Changes = unknown;
export interface Update {
  by: string;
  changes: Changes;
}
export interface Draft {
  // Seconds since 1970.
  time: number;
  // It was made of another text than the file has.
  other_base: boolean;
}
// A fault at the address of its property, and at its place in the text.
export interface FaultHeard {
  path: string;
  severity: "error" | "warning";
  message: string;
  hints: string[];
  label: string | null;
  elsewhere: string | null;
  from: number;
  to: number;
}
// What a new scene begins with.
export type Beginning = { template: string } | { scenario: string };
// A question of a command, with its options.
export interface Asked {
  command: string;
  options: Record<string, string[]>;
}

// What a window says.
export interface Said {
  hello: { token: string; tab: string; author: string };
  back: { name: string; number: string; tab: string; author: string };
  proof: { proof: string };
  open: { scene: string; since?: { epoch: string; version: number } };
  push: { version: number; heard?: number; updates: { changes: Changes; drag?: number | undefined }[] };
  undo: object;
  redo: object;
  go_to: { count: number; version: number };
  save: object;
  save_as: { scene: string };
  new: { scene: string; from?: Beginning | null };
  reload: object;
  keep_mine: object;
  draft: { restore: boolean };
  map: { question: unknown };
  question: { question: Asked | null };
  pin: { name: string };
  unpin: { pin: number };
  rename: { pin: number; name: string };
  over: { signals: [string, string] | null };
  shown: object;
  map_shown: object;
  question_shown: object;
  sight: { charts: number[] };
  keep: { name: string; value: string };
  ping: { number: number };
}
export type SaidMessage = { [K in keyof Said]: { type: K } & Said[K] }[keyof Said];

// What cannot be shown, and why; or what is shown.
interface Refused {
  version: number;
  refused: string;
}
interface Pictured {
  version: number;
  refused?: undefined;
  html: string;
  columns: (number | null)[][];
  plots: Record<number, PlotData>;
}
export interface MapFound extends Pictured {
  figure: string;
  cells: number;
  notes: string[];
}
export interface AnswerFound extends Pictured {
  answer?: string;
  warnings: string;
  subtitle: string;
  files: string[];
}

// What a window hears.
export interface Heard {
  challenge: { number: string; proof: string };
  welcome: {
    window: string;
    token?: string;
    folder: string;
    scene: string | null;
    settings: Record<string, string>;
    program: string;
  };
  opened: { scene: string; epoch: string; version: number; text: string; draft: Draft | null };
  resumed: { scene: string; version: number; updates: Update[] };
  updates: { version: number; updates: Update[] };
  late: { version: number };
  status: { saved: boolean; undo: boolean; redo: boolean; disk: string; base: string; draft: boolean };
  checked: { version: number; numbers: Field[] | null; objects: Outline[] | null; faults: FaultHeard[] };
  failed: { version: number; message: string };
  error: { message: string };
  map: Refused | MapFound;
  map_progress: { done: number; of: number };
  question: { question: Asked | null } & (Refused | AnswerFound);
  question_progress: { done: number; of: number; now: string };
  pong: { number: number };
}
export type HeardMessage = { [K in keyof Heard]: { type: K } & Heard[K] }[keyof Heard];

// Those that hear messages, by their type.
export class Hearers {
  private readonly all = new Map<string, (message: never) => void>();
  on<K extends keyof Heard>(type: K, act: (message: Heard[K]) => void): void {
    this.all.set(type, act as (message: never) => void);
  }
  tell(message: HeardMessage): void {
    this.all.get(message.type)?.(message as never);
  }
}
