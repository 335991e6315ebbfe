// The answer of the run that follows the text, and what of it is looked at.

import { batch, computed, effect, signal } from "@preact/signals";
import type { Answer, Board } from "../answer";
import { isFaulty, errorCount } from "./findings";
import { clear } from "./notices";
import { renew, steady } from "./steady";

// Charts of all objects are shown.
export const ALL = "";

// None before the page stands.
export const board = signal<Board | null>(null);
// The answer as it came last, and the last one whose words are others.
const latest = signal<Answer | null>(null);
export const answer = signal<Answer | null>(null);
// The answer shown is not that of the text.
export const isStale = signal(false);
// Counts how often a scene was opened: the server knows no question of this window by then.
export const openings = signal(0);

export const staleness = computed<string | null>(() => {
  if (!isStale.value) return null;
  const count = errorCount.value,
    has = count ? `the text has ${count} ${count === 1 ? "fault" : "faults"}` : "this text has no answer";
  return answer.value ? `Stale: ${has}. This is the last good answer.` : `No answer yet: ${has}.`;
});

export const expectations = steady(() => ({
  verdicts: latest.value?.expect ?? [],
  others: latest.value?.expect_others ?? 0,
}));

type Figures = Answer["figures"];
const NONE: Figures = {};
const found = computed<Figures>(() => latest.value?.figures ?? NONE);

// Addresses of the figures of a run: numbers, however deep they stand.
export const figures = steady(() => addressesOf(found.value));
function addressesOf(objects: Figures): string[] {
  const addresses: string[] = [];
  const walk = (value: unknown, address: string) => {
    if (typeof value === "number") addresses.push(address);
    else if (value && typeof value === "object" && !Array.isArray(value))
      for (const [name, inner] of Object.entries(value)) walk(inner, address ? `${address}.${name}` : name);
  };
  walk(objects, "");
  return addresses;
}

// Objects that have charts.
export const charted = signal<string[]>([]);
// The object whose charts were chosen, or `ALL`; null: none was.
export const chosenCharts = signal<string | null>(null);
// The object whose charts are shown, or `ALL`.
export const shownCharts = computed<string | null>(() => lookedAt(chosenCharts.value, found.value, charted.value));

function lookedAt(chosen: string | null, objects: Figures, charted: string[]): string | null {
  return chosen !== null && (chosen === ALL || chosen in objects) ? chosen : mostLoaded(objects, charted);
}

// The object whose charts are looked at first: the one that is separated longest, else the last elastic one.
export function mostLoaded(objects: Figures, charted: string[]): string | null {
  const apart = (id: string): number => objects[id]?.pair?.separated_time ?? 0;
  const longest = charted.reduce<string | null>(
    (best, id) => (apart(id) > (best === null ? 0 : apart(best)) ? id : best),
    null,
  );
  return longest ?? charted.filter((id) => (objects[id]?.delta_abs ?? 0) > 0).at(-1) ?? charted.at(-1) ?? null;
}

// The object that the page looks at; null: all are.
const objectOf = (shown: string | null): string | null => (shown === ALL ? null : shown);

effect(() => {
  const object = shownCharts.value;
  // Another scene begins with all of them.
  void openings.value;
  board.value?.only(objectOf(object));
});

// What of an answer is told in words.
const wordsOf = (one: Answer): string =>
  JSON.stringify([one.verdict, one.warnings, one.coarse, one.title, one.pins, one.signals]);

// Shows an answer of the server.
export function show(frame: ArrayBuffer): void {
  const own = board.peek()!,
    head = own.show(frame, ({ figures }, charted) => objectOf(lookedAt(chosenCharts.peek(), figures, charted)));
  performance.mark("answer", { detail: head.version });
  const before = latest.peek();
  batch(() => {
    latest.value = head;
    renew(charted, own.charts.objects);
    // It stays while numbers move, whichever is loaded most by then.
    if (chosenCharts.peek() === null) chosenCharts.value = shownCharts.value;
    clear("run");
    isStale.value = isFaulty.peek();
    if (!before || wordsOf(before) !== wordsOf(head)) answer.value = head;
  });
}

// Nothing of another scene stays.
export function forget(): void {
  batch(() => {
    board.peek()?.clear();
    chosenCharts.value = null;
    latest.value = null;
    charted.value = [];
    answer.value = null;
  });
}
