// The text of the scene that is open: its editor, its tree, its numbers, and edits of it.

import { computed, signal } from "@preact/signals";
import type { Editor } from "../editor";
import { fields as fieldsOf, type Field, type Span } from "../numbers";
import { Edits, parse, type Change, type Value } from "../tree";
import { tell } from "./notices";

// None before the page stands.
export const editor = signal<Editor | null>(null);
// Counts how often the text was drawn: once a frame at most, however often it changes. What shows
// something of the text reads it.
export const revision = signal(0);
export const redraw = (): void => {
  revision.value = revision.peek() + 1;
};

const NONE: Field[] = [];
export const fields = computed<Field[]>(() => {
  void revision.value;
  return editor.value?.state.field(fieldsOf) ?? NONE;
});
// How far the numbers may be moved, by their addresses.
export const spans = new Map<string, Span>();

// Whether the server has all edits.
export const isSettled = computed<boolean>(() => {
  void revision.value;
  return editor.value?.isSettled ?? true;
});

interface Tree {
  text: string;
  root: Value | null;
  // The last text that was JSON.
  good: Value | null;
  goodText: string;
}
let treeOf: unknown = null;
const known: Tree = { text: "", root: null, good: null, goodText: "" };

// The text as a tree, made where it is looked at.
export function tree(): Tree {
  const { doc } = editor.peek()!.state;
  if (treeOf !== doc) {
    treeOf = doc;
    known.text = doc.toString();
    known.root = parse(known.text);
    if (known.root) {
      known.good = known.root;
      known.goodText = known.text;
    }
  }
  return known;
}

// False: the text was not changed.
export function edit(make: (edits: Edits) => Change[], step?: number): boolean {
  const own = editor.peek()!,
    { text, root } = tree();
  if (!root) {
    tell("The text is not whole at present: mend it in the text view first.");
    // A field shows again what stands in the text.
    redraw();
    return false;
  }
  const changes = make(new Edits(text, root));
  return changes.length > 0 && own.change(changes, step ?? own.drag());
}

// A new step of undo.
export const drag = (): number => editor.peek()!.drag();
// Whether the text is that of a version.
export const isAt = (version: number): boolean => editor.peek()!.isAt(version);
