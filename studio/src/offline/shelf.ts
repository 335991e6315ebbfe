// Scenes that this browser keeps, and texts that were not saved.

interface Draft {
  text: string;
  time: number;
}

const SCENE = "dam-tab-scene ",
  DRAFT = "dam-tab-draft ";
const NAME = /^[^/\\:\0]{1,200}\.json$/;

export class Shelf {
  // Of a browser that keeps nothing, for this page alone.
  private readonly own = new Map<string, string>();
  private get(key: string): string | null {
    try {
      return localStorage.getItem(key) ?? this.own.get(key) ?? null;
    } catch {
      return this.own.get(key) ?? null;
    }
  }
  // False: it is kept for this page alone.
  private set(key: string, value: string): boolean {
    try {
      localStorage.setItem(key, value);
      this.own.delete(key);
      return true;
    } catch {
      this.own.set(key, value);
      return false;
    }
  }
  private forget(key: string): void {
    this.own.delete(key);
    try {
      localStorage.removeItem(key);
    } catch {
      /* It was never there. */
    }
  }

  // Whether all lasts longer than this page.
  get isLasting(): boolean {
    return this.own.size === 0;
  }

  names(): string[] {
    let keys = [...this.own.keys()];
    try {
      keys = keys.concat(Object.keys(localStorage));
    } catch {
      /* Those of this page are all. */
    }
    return [...new Set(keys.filter((key) => key.startsWith(SCENE)).map((key) => key.slice(SCENE.length)))].sort();
  }
  text(name: string): string | null {
    return this.get(SCENE + name);
  }
  save(name: string, text: string): boolean {
    this.forget(DRAFT + name);
    return this.set(SCENE + name, text);
  }
  draft(name: string): Draft | null {
    const kept = this.get(DRAFT + name);
    try {
      return kept === null ? null : (JSON.parse(kept) as Draft);
    } catch {
      return null;
    }
  }
  keepDraft(name: string, text: string): boolean {
    return this.set(DRAFT + name, JSON.stringify({ text, time: Date.now() / 1000 } satisfies Draft));
  }
  forgetDraft(name: string): void {
    this.forget(DRAFT + name);
  }

  // Why a new scene cannot have this name; null: it can.
  refusal(name: string): string | null {
    if (!NAME.test(name)) return "the name of a scene ends with .json and has no slash";
    return this.text(name) === null ? null : "a scene of this name is there already";
  }
  // A name that is free.
  free(name: string): string {
    const stem =
      name
        .replace(/\.json$/, "")
        .replace(/[/\\:\0]/g, "-")
        .slice(0, 150) || "scene";
    for (let count = 1; ; count++) {
      const tried = count === 1 ? `${stem}.json` : `${stem}-${count}.json`;
      if (this.text(tried) === null) return tried;
    }
  }
}
