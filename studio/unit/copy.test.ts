import { expect, it } from "vitest";
import { copied, pasted } from "../src/copy";
import { Edits, find, parse, plain, Steps } from "../src/tree";
import { applied, scenarios } from "./scenes";

it("all objects of every scenario are copied and pasted beside themselves, with what they say of each other", () => {
  for (const [name, text] of scenarios) {
    const root = parse(text)!,
      ids = find(root, ["objects"])?.members.map((one) => one.name) ?? [];
    if (!ids.length) continue;
    const clip = copied(new Edits(text, root), ids)!;
    expect(JSON.parse(clip), name).toEqual(plain(find(root, ["objects"])!));
    const steps = new Steps(new Edits(text, root)),
      names = pasted(steps, clip),
      after = applied(text, steps.changes),
      objects = JSON.parse(after).objects;
    expect(Object.keys(objects), name).toEqual([...ids, ...names]);
    // None is driven by one of those before: they drive each other.
    names.forEach((one, k) => {
      const { input } = objects[one];
      if (typeof input !== "string") return;
      const [owner, ...rest] = objects[ids[k]!].input.split("."),
        place = ids.indexOf(owner);
      expect(input, `${name} ${one}`).toBe([place < 0 ? owner : names[place], ...rest].join("."));
    });
  }
});

it("what is no objects is not pasted", () => {
  const text = '{ "objects": {} }';
  for (const clip of ["", "{}", "[]", "hello", '{ "a": 1 }', '{ "a": {} }', '{ "a": { "kind": 3 } }', '} , "x": {'])
    expect(pasted(new Steps(new Edits(text, parse(text)!)), clip), clip).toEqual([]);
});
