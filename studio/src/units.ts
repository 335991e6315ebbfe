// Units in which figures, charts and numbers are shown, as the user chose: the text stays as it is.
//
// One place chooses a unit, `scaleFor` of `numbers.js` (`numbers.prefer`), for charts, tables,
// fields and sentences. An answer is a `Sentence` (`report/sentence.rs`): words and quantities
// with value and SI unit. In warnings and causes, which come as text, the quantities are read
// (`sentence/reading.rs`).

import { signal } from "@preact/signals";
import { typedNumber } from "./entry";
import { Kept, type Link } from "./link";
import type { Field } from "./numbers";
import { CHOICES, SYSTEMS, TURN } from "./unit-choices";

const kept = new Kept("units");
interface Shown {
  unit: string;
  factor: number;
}

// The unit in which values of an SI unit are shown; undefined: whichever reads best.
const chosen = new Map<string, Shown>();
// Counts the choices: what shows a unit reads it.
export const choice = signal(0);

function choose(si: string, unit: string): void {
  const found = CHOICES[si]?.[1].find(([name]) => name === unit);
  if (found) chosen.set(si, { unit: found[0], factor: found[1] });
  else chosen.delete(si);
  numbers.prefer((unit) => chosen.get(unit));
  choice.value = choice.peek() + 1;
}

function chooseKept(): void {
  try {
    for (const [si, unit] of Object.entries(JSON.parse(kept.get() ?? "{}"))) choose(si, String(unit));
  } catch {
    /* What cannot be read was not chosen. */
  }
}
chooseKept();
// Those that another browser or program was given.
export function offered(settings: Record<string, string>): boolean {
  const taken = kept.offer(settings);
  if (taken) chooseKept();
  return taken;
}

// A sentence of the program: words, and quantities as it told them, with their values.
export type Sentence = (string | { words: string; value: number; unit: string; digits: number })[];

// A sentence in the units that were chosen.
export function said(sentence: Sentence): string {
  void choice.value;
  return sentence
    .map((part) => (typeof part === "string" ? part : (inOwn(part.value, part.unit, part.digits) ?? part.words)))
    .join("");
}

// A value of an SI unit in the one that was chosen; null: in whichever reads best.
function inOwn(value: number, si: string, digits: number): string | null {
  const own = chosen.get(si);
  return own ? `${numbers.significant(value / own.factor, digits)} ${own.unit}` : null;
}

// The SI unit of what is told in degrees.
const ofDegrees: Record<string, [string, number]> = {
  deg: ["rad", TURN / 360],
  "deg/s": ["rad/s", TURN / 360],
  rpm: ["rad/s", TURN / 60],
};

// Figures in a piece of a page, each with its value and SI unit as its title.
export function reshow(piece: ParentNode): void {
  for (const one of piece.querySelectorAll<HTMLElement>("span.quantity[title]")) {
    const [, number, unit] = /^(\S+) (.+)$/.exec(one.title) ?? [];
    one.dataset.words ??= one.textContent ?? "";
    one.textContent = inOwn(Number(number), unit ?? "", Number(one.dataset.digits)) ?? one.dataset.words;
  }
  if (!chosen.size) return;
  for (const one of piece.querySelectorAll<HTMLElement>("td span[title]")) {
    const [, number, unit = ""] = /^(\S+) (.+)$/.exec(one.title) ?? [],
      [si, factor] = ofDegrees[unit] ?? [unit, 1];
    const own = chosen.get(si),
      name = one.querySelector(".unit");
    if (!own || !name || !Number.isFinite(Number(number))) continue;
    one.replaceChildren(`${numbers.significant((Number(number) * factor) / own.factor, 7)} `, name);
    name.textContent = own.unit;
  }
}

// Readings of what moves: places and deviations, which the player tells in the units that stand there.
export function remeasure(place: Element): void {
  for (const { dataset: own } of place.querySelectorAll<HTMLElement>("[data-column][data-unit]")) {
    own.asDrawn ??= JSON.stringify([own.unit, own.scale, own.deltaUnit, own.deltaScale]);
    const drawn: string[] = JSON.parse(own.asDrawn),
      shown = chosen.get(drawn[0] === "deg" ? "rad" : "m"),
      scale = shown && String(1 / shown.factor);
    [own.unit, own.scale, own.deltaUnit, own.deltaScale] = shown ? [shown.unit, scale, shown.unit, scale] : drawn;
  }
}

// A number of the text as it is shown; null: as it is written.
export function fieldIn(field: Field): { text: string; unit: string; back: (typed: string) => string } | null {
  void choice.value;
  const own = chosen.get(field.si.replace("^2", "²")),
    { factor } = field;
  if (!own || factor === null || own.unit === (field.unit || field.si).replace("^2", "²")) return null;
  const digits = (value: number) => String(Number(value.toPrecision(12)));
  return {
    text: String(Number(((field.value * factor) / own.factor).toPrecision(7))),
    unit: own.unit,
    // What was typed without a unit, or in this one, in the unit that the text has.
    back: (typed) => {
      const given = typedNumber(typed);
      if (given.sort !== "number" || (given.entry.unit && given.entry.unit !== own.unit)) return typed;
      return digits((Number(given.entry.number) * own.factor) / factor);
    },
  };
}

// The unit that was chosen for an SI unit; empty: whichever reads best.
export function unitOf(si: string): string {
  void choice.value;
  return chosen.get(si)?.unit ?? "";
}

function keepChosen(link: Link): void {
  kept.set(JSON.stringify(Object.fromEntries([...chosen].map(([si, own]) => [si, own.unit]))), link);
}

// Shows values of an SI unit in another, now and later.
export function chooseUnit(si: string, unit: string, link: Link): void {
  choose(si, unit);
  keepChosen(link);
}

// The units of a system; empty: whichever read best.
export function chooseSystem(name: string, link: Link): void {
  for (const si of Object.keys(CHOICES)) choose(si, SYSTEMS[name]?.[si] ?? "");
  keepChosen(link);
}

// The system whose units are chosen; empty: none is; null: a choice of its own.
export function systemChosen(): string | null {
  void choice.value;
  if (!chosen.size) return "";
  const isChosen = (units: Record<string, string>) =>
    Object.keys(CHOICES).every((si) => chosen.get(si)?.unit === units[si]);
  return Object.keys(SYSTEMS).find((name) => isChosen(SYSTEMS[name]!)) ?? null;
}
