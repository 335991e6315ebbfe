// The program in this tab as the other end of the line: it says what the server would.
//
// The text with its history is kept here; workers answer the newest version. Nothing is sent anywhere.

import { Text } from "@codemirror/state";
import { shownScene, type Link } from "../link";
import {
  Hearers,
  type Asked,
  type Beginning,
  type Heard,
  type HeardMessage,
  type Said,
  type SaidMessage,
} from "../messages";
import { Desk } from "./desk";
import { Document } from "./document";
import { kernel, unpackedScene } from "./kernel";
import { Shelf } from "./shelf";

// The only window.
const WINDOW = "1";
// How often a text that is not saved is kept (ms); how long nothing newer comes before a map is made finer.
const OFTEN = 1000,
  REST = 20;
const LEVELS = 3;

interface Reply {
  type: "reply";
  number: number;
  value?: unknown;
  error?: string;
}
// What a worker tells: what a window hears, and what is for this end of the line.
type FoundMessage = HeardMessage | Reply | { type: "source"; hash: string; judged: boolean };

interface Pin {
  name: string;
  text: string;
  hash: string;
  judged: boolean;
}

export class Tab implements Link {
  readonly known = true;
  answer: (frame: ArrayBuffer) => void = () => {};
  state: (connected: boolean) => void = () => {};
  private readonly heard = new Hearers();
  private readonly shelf = new Shelf();
  private readonly replies = new Map<number, { done: (value: never) => void; failed: (error: Error) => void }>();
  private readonly runs: Desk;
  private readonly maps: Desk;
  private readonly questions: Desk;
  private readonly asides: Desk;
  private name = "";
  private document: Document | null = null;
  private saved = "";
  private isAsking = false;
  // Another window of this browser has saved another text, or has taken the scene away.
  private disk: "same" | "changed" | "gone" = "same";
  private status = "";
  private kept = 0;
  private replyNumber = 0;
  private connected = false;
  // What the window sees besides the run, and the run that it could pin.
  private pins: Pin[] = [];
  private over: [string, string] | null = null;
  private run: { version: number; text: string; hash: string; judged: boolean } | null = null;
  private asked: { version: number; text: string } = { version: 0, text: "" };
  private map: unknown = null;
  private question: Asked | null = null;
  private level = 0;
  private finer = 0;

  constructor() {
    const module = kernel();
    addEventListener("storage", () => this.look());
    // What is not kept yet is, or the browser asks before it goes.
    addEventListener("beforeunload", (event) => {
      if (!this.keep() || !this.shelf.isLasting) event.preventDefault();
    });
    const hear = (found: { text: string } | { answer: ArrayBuffer }) => {
      if ("answer" in found) this.answer(found.answer);
      else this.told(JSON.parse(found.text));
    };
    const failed = (words: string) =>
      this.tell({ type: "failed", version: this.document?.version ?? 0, message: words });
    this.runs = new Desk(module, hear, failed, true);
    this.maps = new Desk(module, hear, failed);
    this.questions = new Desk(module, hear, (words) =>
      this.tell({ type: "question", version: this.document?.version ?? 0, question: this.question, refused: words }),
    );
    this.asides = new Desk(module, hear, (words, request) =>
      this.reply({ type: "reply", number: Number(request.number), error: words }),
    );
  }

  get isOpen(): boolean {
    return this.connected;
  }

  on<K extends keyof Heard>(type: K, act: (message: Heard[K]) => void): void {
    this.heard.on(type, act);
  }

  connect(): void {
    void this.shared().then((scene) => {
      this.connected = true;
      this.state(true);
      this.tell({ type: "welcome", window: WINDOW, folder: "this browser", scene, settings: {}, program: PROGRAM });
    });
  }

  // The scene that the address holds or names; null: none.
  private async shared(): Promise<string | null> {
    const [, sort, given] = /^#(scene|scenario)=([A-Za-z0-9_/-]+)$/.exec(location.hash) ?? [];
    if (!given) return null;
    history.replaceState(null, "", location.pathname + location.search);
    shownScene.forget();
    try {
      return sort === "scene"
        ? this.add("shared.json", await unpackedScene(given))
        : this.add(`${given.split("/").at(-1)}.json`, await this.aside({ ask: "begin", from: { scenario: given } }));
    } catch (error) {
      const words = `The scene in the address cannot be read: ${(error as Error).message}`;
      setTimeout(() => this.tell({ type: "error", message: words }));
      return null;
    }
  }

  // Looks whether the kept text is still that which was opened or saved here.
  private look(): void {
    if (!this.document) return;
    const kept = this.shelf.text(this.name)?.replaceAll("\r\n", "\n");
    this.disk = kept === undefined ? "gone" : kept === this.saved ? "same" : "changed";
    this.tellStatus();
  }

  // Takes what another window has saved, or stays with the own text, which may then be saved over it.
  private settle(document: Document, reload: boolean): void {
    const kept = this.shelf.text(this.name)?.replaceAll("\r\n", "\n");
    if (kept === undefined) return;
    this.saved = kept;
    this.disk = "same";
    if (reload) this.updated(document, document.version, [document.replace(kept)], "0");
    queueMicrotask(() => this.tellStatus());
  }

  // Keeps a text under a name that is free, or that it has already.
  add(name: string, text: string): string {
    if (this.shelf.text(name) === text) return name;
    const free = this.shelf.free(name);
    this.shelf.save(free, text);
    return free;
  }

  private tell(message: HeardMessage): void {
    this.heard.tell(message);
  }

  private error(message: string): void {
    queueMicrotask(() => this.tell({ type: "error", message }));
  }

  // What a worker found.
  private told(message: FoundMessage): void {
    if (message.type === "reply") {
      this.reply(message);
      return;
    }
    if (message.type === "source") {
      this.run = { ...this.asked, hash: message.hash, judged: message.judged };
      return;
    }
    if (message.type === "map" && !message.refused) {
      clearTimeout(this.finer);
      if (this.level + 1 < LEVELS)
        this.finer = setTimeout(() => {
          this.level++;
          this.chart();
        }, REST);
    }
    this.tell(message);
  }

  private reply({ number, value, error }: Reply): void {
    const waiting = this.replies.get(number);
    this.replies.delete(number);
    if (error === undefined) waiting?.done(value as never);
    else waiting?.failed(new Error(error));
  }

  send(message: SaidMessage): boolean {
    try {
      this.obey(message);
    } catch (error) {
      this.error((error as Error).message);
    }
    return true;
  }

  private obey(message: SaidMessage): void {
    switch (message.type) {
      case "open":
        this.open(message.scene);
        return;
      case "new":
        void this.begin(message.scene, message.from);
        return;
      case "ping":
        queueMicrotask(() => this.tell({ type: "pong", number: message.number }));
        return;
      case "keep":
        return;
      case "shown":
        this.runs.taken();
        return;
      case "map_shown":
      case "question_shown":
        return;
      case "sight":
        this.runs.submit({ ask: "sight", charts: message.charts }, false);
        return;
    }
    const document = this.document;
    if (!document) throw new Error("no scene is open");
    switch (message.type) {
      case "push":
        this.push(document, message);
        return;
      case "undo":
      case "redo":
        this.updated(document, document.version, [document.step(message.type === "undo")], "0");
        return;
      case "go_to":
        this.updated(document, document.version, document.goTo(message.count, message.version), "0");
        return;
      case "save":
        this.save(document);
        return;
      case "save_as":
        this.saveAs(document, message.scene);
        return;
      case "reload":
      case "keep_mine":
        this.settle(document, message.type === "reload");
        return;
      case "draft":
        this.decide(document, message.restore);
        return;
      case "map":
        this.map = message.question;
        this.level = 0;
        this.chart();
        return;
      case "question":
        this.question = message.question;
        this.inquire();
        return;
      case "over":
        this.over = message.signals;
        this.compute();
        return;
      case "pin":
        this.pin(message.name);
        return;
      case "unpin":
        this.pins = this.pins.filter((_, at) => at !== message.pin);
        this.compute();
        return;
      case "rename":
        this.pins = this.pins.map((pin, at) => (at === message.pin ? { ...pin, name: message.name } : pin));
        this.compute();
        return;
      default:
        throw new Error(`“${message.type}” is not known here`);
    }
  }

  private open(name: string): void {
    const text = this.shelf.text(name);
    if (text === null) throw new Error("there is no such scene in this browser");
    const unix = text.replaceAll("\r\n", "\n"),
      draft = this.shelf.draft(name);
    this.name = name;
    this.document = new Document(Text.of(unix.split("\n")));
    this.saved = unix;
    this.pins = [];
    this.over = this.run = this.map = this.question = null;
    const offered = draft && draft.text !== unix ? { time: draft.time, other_base: false } : null;
    this.isAsking = offered !== null;
    this.disk = "same";
    this.status = "";
    queueMicrotask(() => {
      this.tell({ type: "opened", scene: name, epoch: `${Date.now()}`, version: 0, text: unix, draft: offered });
      this.tellStatus();
      this.compute();
    });
  }

  private async begin(name: string, from: Beginning | null | undefined): Promise<void> {
    const refused = this.shelf.refusal(name);
    if (refused) {
      this.error(refused);
      return;
    }
    const title = JSON.stringify(name.replace(/\.json$/, "").replaceAll(/[_-]/g, " "));
    const empty = `{\n  "dam": 1,\n  "name": ${title},\n  "objects": {\n  },\n  "run": { "duration": "1 s", "start": "static" }\n}\n`;
    try {
      this.shelf.save(name, from ? await this.aside({ ask: "begin", from }) : empty);
      this.open(name);
    } catch (error) {
      this.error((error as Error).message);
    }
  }

  private push(document: Document, { version, updates }: Said["push"]): void {
    if (this.isAsking) throw new Error("decide about the draft first");
    if (version !== document.version) {
      queueMicrotask(() => this.tell({ type: "late", version: document.version }));
      return;
    }
    for (const one of updates) document.take(one.changes, one.drag);
    this.updated(
      document,
      version,
      updates.map((one) => one.changes),
      WINDOW,
    );
  }

  private updated(document: Document, version: number, changes: unknown[], by: string): void {
    const made = changes.filter((one) => one !== null);
    if (!made.length) return;
    queueMicrotask(() => {
      if (document !== this.document) return;
      this.tell({ type: "updates", version, updates: made.map((one) => ({ by, changes: one })) });
      this.tellStatus();
    });
    this.keepSoon();
    this.compute();
  }

  private tellStatus(): void {
    const document = this.document!,
      { undo, redo } = document;
    const status = {
      type: "status" as const,
      saved: document.text === this.saved,
      base: "",
      undo,
      redo,
      disk: this.disk,
      draft: this.isAsking,
    };
    const written = JSON.stringify(status);
    if (written !== this.status) {
      this.status = written;
      this.tell(status);
    }
  }

  private keepSoon(): void {
    this.kept ||= setTimeout(() => {
      this.kept = 0;
      this.keep();
    }, OFTEN);
  }

  // Keeps a text that is not saved; false: this browser does not keep it.
  private keep(): boolean {
    const text = this.document?.text;
    if (text === undefined || this.isAsking) return true;
    if (text !== this.saved) return this.shelf.keepDraft(this.name, text);
    this.shelf.forgetDraft(this.name);
    return true;
  }

  private save(document: Document): void {
    this.look();
    if (this.disk === "changed")
      throw new Error("the scene was saved by another window of this browser: choose which text stays");
    this.disk = "same";
    this.saved = document.text;
    const isKept = this.shelf.save(this.name, this.saved);
    queueMicrotask(() => this.tellStatus());
    // After the status, with which other notices go.
    if (!isKept) this.error("This browser keeps nothing more of this page: ⤓ scene writes it to a file.");
  }

  private saveAs(document: Document, name: string): void {
    const refused = this.shelf.refusal(name);
    if (refused) throw new Error(refused);
    this.shelf.forgetDraft(this.name);
    this.shelf.save(name, document.text);
    this.open(name);
  }

  private decide(document: Document, restore: boolean): void {
    const draft = this.shelf.draft(this.name);
    this.isAsking = false;
    if (restore && draft) this.updated(document, document.version, [document.replace(draft.text)], "0");
    else this.shelf.forgetDraft(this.name);
    queueMicrotask(() => this.tellStatus());
  }

  private pin(name: string): void {
    if (!this.run) throw new Error("there is no run to be pinned");
    if (this.pins.length >= 3) throw new Error("3 runs are pinned: unpin one of them first");
    const { text, hash, judged } = this.run;
    this.pins.push({ name, text, hash, judged });
    this.compute();
  }

  // ---- what is computed

  private get version(): { version: number; name: string; text: string } {
    return { version: this.document!.version, name: this.name, text: this.document!.text };
  }

  private compute(): void {
    const of = this.version;
    this.asked = of;
    this.runs.submit({ ask: "run", of, pins: this.pins, ...(this.over ? { over: this.over } : {}) });
    this.level = 0;
    this.chart();
    this.inquire();
  }

  private chart(): void {
    clearTimeout(this.finer);
    if (this.map && this.document)
      this.maps.submit({ ask: "map", of: this.version, question: this.map, level: this.level });
  }

  private inquire(): void {
    if (this.question && this.document)
      this.questions.submit({ ask: "question", of: this.version, question: this.question });
  }

  private aside<T>(request: { ask: string; [name: string]: unknown }): Promise<T> {
    const number = ++this.replyNumber;
    return new Promise((done, failed) => {
      this.replies.set(number, { done, failed });
      this.asides.submit({ ...request, number }, false);
    });
  }

  async get<T>(path: string): Promise<T>;
  async get(path: string): Promise<unknown> {
    const { pathname, searchParams } = new URL(path, "file:///");
    if (pathname === "/api/scenes") return { folder: "this browser", scenes: this.shelf.names() };
    if (pathname === "/api/steps" && this.document) return this.document.steps;
    const of = this.document ? this.version : { version: 0, name: "", text: "" };
    const found = await this.aside<object>({ ask: "get", path: pathname, of, query: Object.fromEntries(searchParams) });
    if (pathname !== "/api/first") return found;
    const scenes = this.shelf
      .names()
      .map((name) => ({ name, title: /"name"\s*:\s*"([^"\\]*)"/.exec(this.shelf.text(name) ?? "")?.[1] ?? null }));
    return { ...found, recent: [], scenes };
  }

  async text(path: string): Promise<string> {
    return this.get(path);
  }
}
