// The text of a scene as a tree that knows its places, and edits of it that keep what the author
// wrote around them: every change of the graph and of the forms is a change of the text.
//
// An edit continues as the author wrote: on a line of its own, or within one.

import { jsonLanguage } from "@codemirror/lang-json";
import { ChangeSet, Text } from "@codemirror/state";
import type { SyntaxNode } from "@lezer/common";

export type Step = string | number;

export interface Member {
  name: string;
  from: number;
  to: number;
  nameAt: [number, number];
  value: Value;
}
export interface Value {
  sort: "object" | "array" | "string" | "number" | "true" | "false" | "null" | "wrong";
  from: number;
  to: number;
  // As written: of a string the string.
  text: string;
  members: Member[];
  items: Value[];
}
export interface Change {
  from: number;
  to: number;
  insert: string;
}

const SORTS: Record<string, Value["sort"]> = {
  Object: "object",
  Array: "array",
  String: "string",
  Number: "number",
  True: "true",
  False: "false",
  Null: "null",
};

function string(raw: string): string {
  try {
    return String(JSON.parse(raw));
  } catch {
    return raw.replace(/^"|"$/g, "");
  }
}

function read(text: string, node: SyntaxNode | null, place: number): Value {
  if (!node) return { sort: "wrong", from: place, to: place, text: "", members: [], items: [] };
  const raw = text.slice(node.from, node.to),
    sort = SORTS[node.name] ?? "wrong";
  const value: Value = {
    sort,
    from: node.from,
    to: node.to,
    text: sort === "string" ? string(raw) : raw,
    members: [],
    items: [],
  };
  if (sort === "object") {
    for (const property of node.getChildren("Property")) {
      const name = property.getChild("PropertyName"),
        last = property.lastChild;
      if (!name) continue;
      const inner = last && last.name !== "PropertyName" && !last.type.isError ? last : null;
      value.members.push({
        name: string(text.slice(name.from, name.to)),
        from: property.from,
        to: property.to,
        nameAt: [name.from, name.to],
        value: read(text, inner, property.to),
      });
    }
  }
  if (sort === "array")
    for (let at = node.firstChild; at; at = at.nextSibling)
      if (SORTS[at.name]) value.items.push(read(text, at, at.from));
  return value;
}

// The tree of a text; null: it is no JSON object, or not whole.
export function parse(text: string): Value | null {
  const tree = jsonLanguage.parser.parse(text);
  let whole = true;
  tree.iterate({
    enter: (node) => {
      if (node.type.isError) whole = false;
    },
  });
  const root = read(text, tree.topNode.firstChild, 0);
  return whole && root.sort === "object" ? root : null;
}

export const member = (value: Value | undefined, name: string): Member | undefined =>
  value?.members.find((one) => one.name === name);

export function find(root: Value | undefined, path: Step[]): Value | undefined {
  return path.reduce<Value | undefined>(
    (at, step) => (typeof step === "number" ? at?.items[step] : member(at, step)?.value),
    root,
  );
}

// What a text value is, for the engine of forms.
export function plain(value: Value): unknown {
  switch (value.sort) {
    case "object":
      return Object.fromEntries(value.members.map((one) => [one.name, plain(one.value)]));
    case "array":
      return value.items.map(plain);
    case "string":
      return value.text;
    case "number":
      return Number(value.text);
    case "null":
    case "wrong":
      return null;
    default:
      return value.sort === "true";
  }
}

// JSON on one line, as scenes are written.
export function written(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(written).join(", ")}]`;
  if (value && typeof value === "object") {
    const inner = Object.entries(value).map(([name, one]) => `${JSON.stringify(name)}: ${written(one)}`);
    return inner.length ? `{ ${inner.join(", ")} }` : "{}";
  }
  return JSON.stringify(value);
}

// How long a part may be that stands on one line.
const LINE = 100;
// JSON as scenes are written, in a text with its indent: what is too long for a line with a member on each.
export function laid(value: unknown, text: string, depth: number): string {
  const line = written(value);
  if (line.length <= LINE || !value || typeof value !== "object" || Array.isArray(value)) return line;
  const unit = unitOf(text),
    inner = Object.entries(value).map(
      ([name, one]) => `${unit.repeat(depth + 1)}${JSON.stringify(name)}: ${laid(one, text, depth + 1)}`,
    );
  return `{\n${inner.join(",\n")}\n${unit.repeat(depth)}}`;
}

// Blanks that a line begins with.
const indentAt = (text: string, place: number): string =>
  /^[ \t]*/.exec(text.slice(text.lastIndexOf("\n", place - 1) + 1))![0];
export const unitOf = (text: string): string => /\n([ \t]+)\S/.exec(text)?.[1] ?? "  ";

// A part at the end of an object or a list: on a line of its own where the last one stands so.
function appended(
  text: string,
  owner: Value,
  parts: { from: number; to: number }[],
  json: string,
  lines: boolean,
): Change {
  const last = parts.at(-1);
  if (!last) {
    const inner = text.slice(owner.from + 1, owner.to - 1);
    if (lines || inner.includes("\n")) {
      const own = indentAt(text, owner.from);
      return { from: owner.from + 1, to: owner.to - 1, insert: `\n${own}${unitOf(text)}${json}\n${own}` };
    }
    return { from: owner.from + 1, to: owner.to - 1, insert: owner.sort === "array" ? json : ` ${json} ` };
  }
  const before = parts.length > 1 ? parts.at(-2)!.to : owner.from + 1;
  const ownLine = text.slice(before, last.from).includes("\n");
  const allLines = parts.every((part, k) => text.slice(k ? parts[k - 1]!.to : owner.from, part.from).includes("\n"));
  // Where several stand on a line, what does not fit begins a new one.
  const room =
    last.to - text.lastIndexOf("\n", last.to - 1) + json.length > 118 &&
    text.slice(owner.from, last.from).includes("\n");
  const line = (ownLine && (allLines || parts.length === 1)) || room ? `\n${indentAt(text, last.from)}` : " ";
  return { from: last.to, to: last.to, insert: `,${line}${json}` };
}

// Takes a part out, with the comma and the blanks that belong to it.
function without(owner: Value, parts: { from: number; to: number }[], index: number): Change {
  const part = parts[index]!,
    next = parts[index + 1],
    before = parts[index - 1];
  if (before) return { from: before.to, to: part.to, insert: "" };
  if (next) return { from: part.from, to: next.from, insert: "" };
  return { from: owner.from + 1, to: owner.to - 1, insert: "" };
}

// Changes of one text, all in places of that text.
export class Edits {
  constructor(
    readonly text: string,
    readonly root: Value,
  ) {}

  // Sets what stands at a path; what leads there is made where it is not there.
  set(path: Step[], json: string): Change[] {
    const there = find(this.root, path);
    if (there && there.sort !== "wrong") return [{ from: there.from, to: there.to, insert: json }];
    const last = path.at(-1)!,
      owner = find(this.root, path.slice(0, -1));
    if (there && typeof last === "string") {
      const own = member(owner, last)!;
      return [{ from: own.from, to: own.to, insert: `${JSON.stringify(last)}: ${json}` }];
    }
    if (owner?.sort === "object" && typeof last === "string")
      return [appended(this.text, owner, owner.members, `${JSON.stringify(last)}: ${json}`, path.length <= 2)];
    if (owner?.sort === "array") return [appended(this.text, owner, owner.items, json, false)];
    const made = typeof last === "number" ? `[${json}]` : `{ ${JSON.stringify(last)}: ${json} }`;
    return path.length > 1 ? this.set(path.slice(0, -1), made) : [];
  }

  // Takes out what stands at a path.
  remove(path: Step[]): Change[] {
    const owner = find(this.root, path.slice(0, -1)),
      last = path.at(-1)!;
    if (typeof last === "number") return owner?.items[last] ? [without(owner, owner.items, last)] : [];
    const index = owner?.members.findIndex((one) => one.name === last) ?? -1;
    return owner && index >= 0 ? [without(owner, owner.members, index)] : [];
  }

  // Copies a part behind itself, under another name.
  duplicate(path: Step[], name: string): Change[] {
    const own = find(this.root, path),
      owner = find(this.root, path.slice(0, -1));
    if (!own || !owner) return [];
    return [
      appended(this.text, owner, owner.members, `${JSON.stringify(name)}: ${this.text.slice(own.from, own.to)}`, true),
    ];
  }

  // Gives an object another id, wherever it is named.
  rename(id: string, other: string): Change[] {
    const changes: Change[] = [],
      objects = find(this.root, ["objects"]);
    const own = member(objects, id);
    if (!own) return [];
    changes.push({ from: own.nameAt[0], to: own.nameAt[1], insert: JSON.stringify(other) });
    const names = (text: string): string | null =>
      text === id ? other : text.startsWith(`${id}.`) ? other + text.slice(id.length) : null;
    const value = (at: Value | undefined): void => {
      const renamed = at?.sort === "string" ? names(at.text) : null;
      if (renamed !== null) changes.push({ from: at!.from, to: at!.to, insert: JSON.stringify(renamed) });
    };
    const keys = (at: Value | undefined): void => {
      for (const one of at?.members ?? []) {
        const renamed = names(one.name);
        if (renamed !== null) changes.push({ from: one.nameAt[0], to: one.nameAt[1], insert: JSON.stringify(renamed) });
      }
    };
    for (const object of objects?.members ?? []) {
      value(member(object.value, "input")?.value);
      for (const input of member(object.value, "inputs")?.value.members ?? [])
        value(member(input.value, "object")?.value);
    }
    for (const one of find(this.root, ["expect"])?.items ?? []) value(member(one, "figure")?.value);
    for (const name of ["start", "accuracy"]) keys(find(this.root, ["run", name]));
    return changes.sort((a, b) => a.from - b.from);
  }
}

// Edits one after the other, each of what the one before made of the text: one change in the end.
export class Steps {
  private made: ChangeSet;
  constructor(public edits: Edits) {
    this.made = ChangeSet.empty(edits.text.length);
  }

  get root(): Value {
    return this.edits.root;
  }

  do(make: (edits: Edits) => Change[]): void {
    const { text } = this.edits,
      changes = ChangeSet.of(make(this.edits), text.length);
    const next = changes.apply(Text.of(text.split("\n"))).toString(),
      root = parse(next);
    if (!root) return;
    this.made = this.made.compose(changes);
    this.edits = new Edits(next, root);
  }

  set(path: Step[], json: string): void {
    this.do((edits) => edits.set(path, json));
  }
  remove(path: Step[]): void {
    this.do((edits) => edits.remove(path));
  }

  // All of them, in places of the text at first.
  get changes(): Change[] {
    const all: Change[] = [];
    this.made.iterChanges((from, to, _, __, insert) => {
      all.push({ from, to, insert: insert.toString() });
    });
    return all;
  }
}

// An address of the program, `rocker.links[2].length`, and the way there in the text.
export function address(path: Step[]): string {
  const steps = path[0] === "objects" ? path.slice(1) : path;
  return steps.map((step, k) => (typeof step === "number" ? `[${step}]` : k ? `.${step}` : step)).join("");
}
