// The steps of the text that is open, by their names: those that undo takes back, and those that
// redo does again.

import { ChangeSet, type Text } from "@codemirror/state";
import { wordsOf } from "../steps";
import { request, scene } from "./file";
import { link } from "./line";
import { editor, fields } from "./text";

// The text after so many steps, and what the last of them was.
export interface Step {
  count: number;
  words: string;
}
export interface Listed {
  version: number;
  // How many steps are done.
  count: number;
  // The newest first.
  steps: Step[];
  // Older ones are not listed.
  more: boolean;
}

// Steps as the program has them: changes one after the other that take them back, or do them again.
interface Found {
  version: number;
  count: number;
  done: unknown[][];
  undone: unknown[][];
  more: boolean;
}

// How long steps are named before the page is drawn and keys are heard (ms).
const TURN = 12;
const rest = (): Promise<void> => new Promise((done) => setTimeout(done));

const applied = (text: Text, changes: unknown[]): Text =>
  changes.reduce((now: Text, one) => ChangeSet.fromJSON(one).apply(now), text);

// The names of steps, from the present on: back, or forward.
async function named(start: Text, all: unknown[][], isBack: boolean): Promise<string[]> {
  const words: string[] = [];
  let text = start,
    written = start.toString(),
    since = performance.now();
  const units = new Map(fields.peek().map(({ address, si }) => [address, si])),
    unitOf = (address: string) => units.get(address) ?? "";
  for (const changes of all) {
    text = applied(text, changes);
    const other = text.toString();
    words.push(isBack ? wordsOf(other, written, unitOf) : wordsOf(written, other, unitOf));
    written = other;
    if (performance.now() - since > TURN) {
      await rest();
      since = performance.now();
    }
  }
  return words;
}

// The steps at present; null: the text is not that of the answer, or nothing answers.
export async function steps(): Promise<Listed | null> {
  let found: Found;
  try {
    found = await link.get<Found>(`/api/steps?scene=${encodeURIComponent(scene.peek())}`);
  } catch {
    return null;
  }
  const own = editor.peek()!,
    { version, count, more } = found;
  if (!own.isAt(version)) return null;
  const text = own.state.doc;
  const [back, forward] = [await named(text, found.done, true), await named(text, found.undone, false)];
  const done = back.map((words, k) => ({ count: count - k, words })),
    undone = forward.map((words, k) => ({ count: count + k + 1, words }));
  return { version, count, more, steps: [...undone.reverse(), ...done] };
}

// Makes the text what it was after so many steps.
export const goTo = (count: number, { version }: Listed): boolean => request({ type: "go_to", count, version });
