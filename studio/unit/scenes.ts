// Scenes of the project, and JSON made at random in the ways in which people write it.

import fc from "fast-check";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Change } from "../src/tree";

const folder = new URL("../../scenarios/", import.meta.url).pathname;

// The texts of all scenarios, by their names.
export const scenarios: [string, string][] = readdirSync(folder, { recursive: true })
  .map(String)
  .filter((name) => name.endsWith(".json") && !name.endsWith("schema.json"))
  .sort()
  .map((name) => [name, readFileSync(join(folder, name), "utf8")]);

// A text after changes whose places are those of the text before.
export function applied(text: string, changes: Change[]): string {
  let made = "",
    at = 0;
  for (const { from, to, insert } of [...changes].sort((a, b) => a.from - b.from || a.to - b.to)) {
    made += text.slice(at, from) + insert;
    at = to;
  }
  return made + text.slice(at);
}

// The changes that take back others.
export function inverse(text: string, changes: Change[]): Change[] {
  let shift = 0;
  return [...changes]
    .sort((a, b) => a.from - b.from || a.to - b.to)
    .map(({ from, to, insert }) => {
      const back = { from: from + shift, to: from + shift + insert.length, insert: text.slice(from, to) };
      shift += insert.length - (to - from);
      return back;
    });
}

const name = fc.oneof(
  fc.stringMatching(/^[a-z_]{1,8}$/),
  fc.string({ maxLength: 6, unit: "grapheme" }),
  fc.constantFrom("__proto__", "constructor", "kind", 'a"b', "a\\b", "\n"),
);
const leaf = fc.oneof(
  fc.string({ maxLength: 8, unit: "grapheme" }),
  fc.integer(),
  fc.double({ noNaN: true, noDefaultInfinity: true }),
  fc.boolean(),
  fc.constant(null),
);
// A value with distinct names, as entries, so that no name is special.
export type Json =
  | { sort: "leaf"; value: unknown }
  | { sort: "list"; items: Json[] }
  | { sort: "map"; of: [string, Json][] };
const { value } = fc.letrec<{ value: Json }>((tie) => ({
  value: fc.oneof(
    { depthSize: "small", withCrossShrink: true },
    leaf.map((value): Json => ({ sort: "leaf", value })),
    fc.array(tie("value"), { maxLength: 4 }).map((items): Json => ({ sort: "list", items })),
    fc
      .uniqueArray(fc.tuple(name, tie("value")), { maxLength: 4, selector: ([name]) => name })
      .map((of): Json => ({ sort: "map", of })),
  ),
}));
export const anyValue = value;
export const anyMap = fc
  .uniqueArray(fc.tuple(name, value), { maxLength: 5, selector: ([name]) => name })
  .map((of): Json => ({ sort: "map", of }));

// JSON with the blanks that a style has: on one line, or on lines of their own.
export function printed(json: Json, style: number[], depth = 0): string {
  if (json.sort === "leaf") return JSON.stringify(json.value);
  const parts =
    json.sort === "list"
      ? json.items.map((one) => printed(one, style, depth + 1))
      : json.of.map(
          ([name, one]) => `${JSON.stringify(name)}:${style[2]! % 2 ? " " : ""}${printed(one, style, depth + 1)}`,
        );
  const [open, close] = json.sort === "list" ? "[]" : "{}",
    isTall = style[depth % style.length]! % 3 === 0,
    unit = style[1]! % 2 ? "  " : "\t";
  if (!parts.length) return open + (isTall ? "" : " ".repeat(style[0]! % 2)) + close;
  return isTall
    ? `${open}\n${parts.map((one) => unit.repeat(depth + 1) + one).join(",\n")}\n${unit.repeat(depth)}${close}`
    : `${open} ${parts.join(", ")} ${close}`;
}
export const anyStyle = fc.array(fc.nat(11), { minLength: 3, maxLength: 5 });
