// Objects on the clipboard: JSON as it stands in the scene, so that it can be pasted into another
// scene, another window or a text as well.

import { freeName } from "./graph";
import { Edits, find, member, parse, Steps } from "./tree";

// What was copied last in this window, whatever was looked at since.
export const clip: { text: string | null } = { text: null };

// The objects of these ids in the order of the text; null: there are none.
export function copied({ text, root }: Edits, ids: string[]): string | null {
  const own = find(root, ["objects"])?.members.filter((one) => ids.includes(one.name)) ?? [];
  return own.length ? `{\n${own.map((one) => `    ${text.slice(one.from, one.to)}`).join(",\n")}\n}` : null;
}

// Puts objects of the clipboard into a scene, under names that are free there; what they say of each
// other goes along. The names; none: the text is no objects.
export function pasted(steps: Steps, text: string): string[] {
  const scene = `{ "objects": ${text} }`,
    root = parse(scene),
    own = find(root ?? undefined, ["objects"])?.members ?? [];
  const fits =
    own.length > 0 &&
    own.every(({ value }) => ["kind", "from"].some((name) => member(value, name)?.value.sort === "string"));
  if (!root || !fits) return [];
  const taken = new Set((find(steps.root, ["objects"])?.members ?? []).map((one) => one.name)),
    renamed = new Steps(new Edits(scene, root));
  const names = own.map(({ name }) => {
    const others = own.map((one) => one.name).filter((one) => one !== name),
      free = freeName(name, [...taken, ...others]);
    taken.add(free);
    if (free !== name) renamed.do((edits) => edits.rename(name, free));
    return free;
  });
  for (const { name, value } of find(renamed.root, ["objects"])?.members ?? [])
    steps.set(["objects", name], renamed.edits.text.slice(value.from, value.to));
  return names;
}
