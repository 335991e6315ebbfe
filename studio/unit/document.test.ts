import { ChangeSet, Text } from "@codemirror/state";
import fc from "fast-check";
import { expect, it } from "vitest";
import { Document } from "../src/offline/document";

const lines = (text: string): Text => Text.of(text.split("\n"));
const applied = (text: Text, changes: unknown[]): Text =>
  changes.reduce((now: Text, one) => ChangeSet.fromJSON(one).apply(now), text);

// A document after edits, some of one drag, and the texts between its steps.
function edited(pieces: [number, number, string][]): { document: Document; texts: string[] } {
  const document = new Document(lines("{}")),
    texts = [document.text];
  pieces.forEach(([at, removed, insert], k) => {
    const from = at % (document.text.length + 1),
      to = Math.min(document.text.length, from + (removed % 4));
    document.take(ChangeSet.of({ from, to, insert: lines(insert) }, document.text.length).toJSON(), k >> 1);
    if (k % 2) texts[texts.length - 1] = document.text;
    else texts.push(document.text);
  });
  return { document, texts };
}
const pieces = fc.array(fc.tuple(fc.nat(), fc.nat(), fc.constantFrom("a", "", '"µ😀"', "\n\n", "7")), {
  minLength: 1,
  maxLength: 12,
});

it("listed steps lead to the texts between them, back and forward, from wherever it stands", () => {
  fc.assert(
    fc.property(pieces, fc.nat(), (all, pick) => {
      const { document, texts } = edited(all),
        count = pick % texts.length,
        changes = document.goTo(count, document.version);
      expect(applied(lines(texts.at(-1)!), changes).toString()).toBe(texts[count]);
      expect(document.text).toBe(texts[count]);
      const { steps } = document;
      expect([steps.count, steps.version, steps.more]).toEqual([count, document.version, false]);
      let text = lines(document.text);
      const back = steps.done.map((one) => (text = applied(text, one)).toString());
      expect(back).toEqual(texts.slice(0, count).reverse());
      text = lines(document.text);
      const forward = steps.undone.map((one) => (text = applied(text, one)).toString());
      expect(forward).toEqual(texts.slice(count + 1));
    }),
  );
});

it("goes nowhere from another version, and no further than there are steps", () => {
  const { document, texts } = edited([
    [1, 0, "a"],
    [1, 0, "b"],
    [1, 0, "c"],
  ]);
  expect(() => document.goTo(0, document.version - 1)).toThrow("meanwhile");
  expect(document.text).toBe(texts.at(-1));
  document.goTo(99, document.version);
  expect(document.text).toBe(texts.at(-1));
  document.goTo(0, document.version);
  expect(document.text).toBe("{}");
});

it("lists 200 steps at most, and says that there are more", () => {
  const document = new Document(lines("x"));
  for (let k = 0; k < 203; k++) document.take(ChangeSet.of({ from: 0, to: 1, insert: "y" }, 1).toJSON(), k);
  expect(document.steps.done).toHaveLength(200);
  expect(document.steps.more).toBe(true);
});
