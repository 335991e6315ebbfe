// What a step of the history changed, in words: from the texts before and after it, so that it is the
// same whoever made the step, and with a server as in the single file.

import { address, parse, type Step, type Value } from "./tree";

// A value that another text has differently; null: it is not there.
interface Difference {
  path: Step[];
  before: Value | null;
  after: Value | null;
}

// The unit of a number that is written without one, by its address; empty: none is known.
type UnitOf = (address: string) => string;

// How long a value and the words of a step are at most (characters).
const VALUE = 28,
  WORDS = 100;

// On one line, and not longer than that: whatever stands in a text.
function short(text: string, most: number): string {
  const line = Array.from(text.replace(/[\p{C}\p{Z}\s]+/gu, " ").trim());
  return line.length > most ? `${line.slice(0, most - 1).join("")}…` : line.join("");
}

const isSimple = ({ sort }: Value): boolean => sort !== "object" && sort !== "array";
// Points and rows of tables are one value each.
const isLeaf = (value: Value): boolean => isSimple(value) || (value.sort === "array" && value.items.every(isSimple));

class Comparison {
  readonly all: Difference[] = [];
  constructor(
    private readonly before: string,
    private readonly after: string,
  ) {}

  of(path: Step[], before: Value, after: Value): void {
    if (this.before.slice(before.from, before.to) === this.after.slice(after.from, after.to)) return;
    if (before.sort === "object" && after.sort === "object") this.members(path, before, after);
    else if (before.sort === "array" && after.sort === "array" && !(isLeaf(before) && isLeaf(after)))
      this.items(path, before.items, after.items);
    else if (before.sort !== after.sort || this.words(before) !== this.words(after))
      this.all.push({ path, before, after });
  }

  private words(value: Value): string {
    return value.sort === "array" ? JSON.stringify(value.items.map((one) => [one.sort, one.text])) : value.text;
  }

  private members(path: Step[], before: Value, after: Value): void {
    const now = new Map(after.members.map((one) => [one.name, one.value])),
      known = new Set(before.members.map((one) => one.name));
    for (const { name, value } of before.members) {
      const there = now.get(name);
      if (there) this.of([...path, name], value, there);
      else this.all.push({ path: [...path, name], before: value, after: null });
    }
    for (const [name, value] of now)
      if (!known.has(name)) this.all.push({ path: [...path, name], before: null, after: value });
  }

  // What was put in or taken out stands between what is the same on both sides.
  private items(path: Step[], before: Value[], after: Value[]): void {
    const text = (one: Value | undefined) => one && this.before.slice(one.from, one.to),
      other = (one: Value | undefined) => one && this.after.slice(one.from, one.to);
    const shorter = Math.min(before.length, after.length);
    let start = 0,
      end = 0;
    while (start < shorter && text(before[start]) === other(after[start])) start++;
    while (end < shorter - start && text(before.at(-1 - end)) === other(after.at(-1 - end))) end++;
    const longer = Math.max(before.length, after.length) - end;
    for (let k = start; k < longer; k++) {
      const one = k < before.length - end ? before[k]! : null,
        own = k < after.length - end ? after[k]! : null;
      if (one && own) this.of([...path, k], one, own);
      else this.all.push({ path: [...path, k], before: one, after: own });
    }
  }
}

const QUANTITY = /^([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s+([^\d\s*/+-].*)$/;
const raised = (unit: string): string => unit.replaceAll("^2", "²").replaceAll("^3", "³");

// A value as it is written: number and unit, which a number alone has from elsewhere.
function shown(value: Value, unit = ""): [string, string] {
  if (value.sort === "number") return [short(value.text, VALUE), raised(unit)];
  if (value.sort === "array")
    return [short(`[${value.items.map((one) => shown(one).join(" ").trim()).join(", ")}]`, VALUE), ""];
  const [, number, own] = (value.sort === "string" && QUANTITY.exec(value.text)) || [];
  return number && own ? [number, raised(short(own, VALUE))] : [short(value.text, VALUE) || "“”", ""];
}
const joined = (value: Value, unit: string): string => shown(value, unit).join(" ").trim();

// "rocker.inertia 0.1 → 0.2 kg m²".
function one({ path, before, after }: Difference, unitOf: UnitOf): string {
  const name = short(address(path), 60),
    bare = unitOf(address(path)),
    value = before ?? after!;
  if (before && after) {
    if (!isLeaf(before) || !isLeaf(after)) return `${name} changed`;
    const [from, unit] = shown(before, bare),
      [to, other] = shown(after, bare);
    return unit === other
      ? `${name} ${from} → ${to} ${unit}`.trim()
      : `${name} ${joined(before, bare)} → ${joined(after, bare)}`;
  }
  return `${name} ${isLeaf(value) && after ? `${joined(value, bare)} ` : ""}${after ? "added" : "removed"}`;
}

// "a, b and 3 more".
function listed(names: string[]): string {
  const first = names.slice(0, 3).map((name) => short(name, 24));
  return names.length > 3 ? `${first.join(", ")} and ${names.length - 3} more` : first.join(", ");
}

// What came and went of those that stand at a place.
function deeds(all: Difference[], depth: number): string[] {
  const names = (of: "before" | "after") =>
    all.filter((one) => one.path.length === depth + 1 && one[of] === null).map((one) => String(one.path[depth]));
  return [[names("before"), "added"] as const, [names("after"), "removed"] as const].flatMap(([found, deed]) =>
    found.length ? [`${listed(found)} ${deed}`] : [],
  );
}

// Objects that came and went: what else changes then goes with them.
function ofObjects(all: Difference[], texts: [string, string]): string {
  const own = all.filter(({ path }) => path[0] === "objects" && path.length === 2),
    gone = own.filter((one) => one.after === null),
    came = own.filter((one) => one.before === null);
  const [old, next] = [gone[0], came[0]];
  if (old && next && own.length === 2) {
    const [before, after] = [old.before!, next.after!];
    if (texts[0].slice(before.from, before.to) === texts[1].slice(after.from, after.to))
      return `${listed([String(old.path[1])])} renamed ${listed([String(next.path[1])])}`;
  }
  return deeds(own, 1).join("; ");
}

// Links of one linkage that came, went or moved; empty: it is something else.
function ofLinkage(all: Difference[]): string {
  const ids = new Set(all.map(({ path }) => (path[0] === "objects" && path.length > 3 ? path[1] : null))),
    [id] = ids;
  if (ids.size !== 1 || id === null || id === undefined) return "";
  const of = ` of ${short(String(id), 24)}`,
    parts = all.filter(({ path }) => path[2] === "links"),
    made = deeds(parts, 3);
  if (made.length) return `link ${made.join("; ")}${of}`;
  const moved = new Set(all.map(({ path }) => (path[2] === "links" && path[4] === "points" ? String(path[3]) : null))),
    ground = all.some(({ path }) => path[2] === "ground");
  moved.delete(null);
  if (!all.every(({ path }) => path[2] === "ground" || (path[2] === "links" && path[4] === "points"))) return "";
  const links = moved.size ? `${moved.size > 1 ? "links" : "link"} ${listed([...moved] as string[])}` : "";
  return `${[links, ground ? "ground" : ""].filter(Boolean).join(" and ")}${of} moved`;
}

function lineOfChange(before: string, after: string): number {
  const least = Math.min(before.length, after.length);
  let at = 0;
  while (at < least && before[at] === after[at]) at++;
  return after.slice(0, at).split("\n").length;
}

// Of steps one after the other, the text after one is that before the next: it is read once.
let latest: [string, Value | null] = ["", null];
function read(text: string): Value | null {
  if (latest[0] !== text) latest = [text, parse(text)];
  return latest[1];
}

// What was done between two texts of a scene, in words on one line.
export function wordsOf(before: string, after: string, unitOf: UnitOf = () => ""): string {
  const [old, next] = [read(before), read(after)];
  if (!old || !next) return `text edited in line ${lineOfChange(before, after)}`;
  const comparison = new Comparison(before, after);
  comparison.of([], old, next);
  const { all } = comparison;
  if (!all.length) return "layout of the text";
  const first = one(all[0]!, unitOf),
    words = ofObjects(all, [before, after]) || ofLinkage(all) || first,
    isAlone = all.length === 1 || words !== first;
  return short(isAlone ? words : `${words} and ${all.length - 1} more`, WORDS);
}
