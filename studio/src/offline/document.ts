// A scene's text with its history, as the server keeps it for its windows: here for one.

import { ChangeSet, type Text } from "@codemirror/state";

// Which edits are one step: those of a drag, and typing that goes on at the same place.
type Group = { drag: number } | "typing" | "alone";
interface Step {
  before: Text;
  all: ChangeSet;
  group: Group;
  time: number;
  end: number;
}

// Typing that stops for so long begins a new step (ms).
const PAUSE = 600;
const LARGEST = 1 << 20;
// Steps that are listed, back and forward each.
const LISTED = 200;

export class Document {
  version = 0;
  private done: Step[] = [];
  private undone: Step[] = [];

  constructor(private content: Text) {}

  get text(): string {
    return this.content.toString();
  }
  get undo(): boolean {
    return this.done.length > 0;
  }
  get redo(): boolean {
    return this.undone.length > 0;
  }

  // Takes an edit of the newest version.
  take(json: unknown, drag: number | undefined): void {
    const changes = ChangeSet.fromJSON(json),
      before = this.content,
      time = performance.now();
    const after = changes.apply(before);
    if (after.length > LARGEST) throw new Error("the scene would be larger than 1 MB");
    let start = -1,
      end = 0,
      lines = false,
      pieces = 0;
    changes.iterChanges((_, to, from, until, insert) => {
      pieces++;
      if (start < 0) start = from;
      end = until;
      lines ||= insert.lines > 1;
      void to;
    });
    const last = this.done.at(-1),
      group: Group = drag === undefined ? "typing" : { drag };
    const isSame =
      last !== undefined &&
      (typeof group === "object"
        ? typeof last.group === "object" && last.group.drag === group.drag
        : last.group === "typing" &&
          pieces === 1 &&
          !lines &&
          time - last.time < PAUSE &&
          Math.abs(start - last.end) <= 1);
    this.content = after;
    this.version++;
    this.undone = [];
    if (isSame) Object.assign(last, { all: last.all.compose(changes), time, end });
    else this.done.push({ before, all: changes, group, time, end });
  }

  // Takes a step back, or does it again; the change that does it, null: there is none.
  step(back: boolean): unknown {
    const step = (back ? this.done : this.undone).pop();
    if (!step) return null;
    (back ? this.undone : this.done).push({ ...step, group: "alone" });
    return this.make(back ? step.all.invert(step.before) : step.all);
  }

  // The steps as the program lists them: what takes them back one after the other, what does them again.
  get steps() {
    const { version, done, undone } = this;
    return {
      version,
      count: done.length,
      done: done
        .slice(-LISTED)
        .reverse()
        .map(({ all, before }) => [all.invert(before).toJSON()]),
      undone: undone
        .slice(-LISTED)
        .reverse()
        .map(({ all }) => [all.toJSON()]),
      more: done.length > LISTED,
    };
  }

  // Takes steps back, or does them again, until so many are done; the changes that do it.
  goTo(count: number, version: number): unknown[] {
    if (version !== this.version) throw new Error("the text was changed meanwhile: choose the step again");
    const changes: unknown[] = [];
    for (let one: unknown = true; one && this.done.length !== count; ) {
      one = this.step(this.done.length > count);
      if (one) changes.push(one);
    }
    return changes;
  }

  // Puts another text in its place, as one step.
  replace(text: string): unknown {
    const before = this.content,
      all = ChangeSet.of({ from: 0, to: before.length, insert: text }, before.length);
    this.undone = [];
    this.done.push({ before, all, group: "alone", time: 0, end: 0 });
    return this.make(all);
  }

  private make(changes: ChangeSet): unknown {
    this.content = changes.apply(this.content);
    this.version++;
    return changes.toJSON();
  }
}
