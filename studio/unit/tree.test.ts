import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { address, Edits, find, member, parse, plain, Steps, written, type Step, type Value } from "../src/tree";
import { anyMap, anyStyle, anyValue, applied, inverse, printed, scenarios } from "./scenes";

// Every place of a tree, as paths.
function pathsOf(value: Value, at: Step[] = []): Step[][] {
  return [
    ...value.members.flatMap((one) => [[...at, one.name], ...pathsOf(one.value, [...at, one.name])]),
    ...value.items.flatMap((one, k) => [[...at, k], ...pathsOf(one, [...at, k])]),
  ];
}
const anyText = fc.tuple(anyMap, anyStyle).map(([json, style]) => printed(json, style));
const root = (text: string): Value => {
  const found = parse(text);
  expect(found, text).not.toBeNull();
  return found!;
};

describe("a text as a tree", () => {
  it("has the values of JSON.parse, in every scenario", () => {
    expect(scenarios.length).toBeGreaterThan(80);
    for (const [name, text] of scenarios) expect(plain(root(text)), name).toEqual(JSON.parse(text));
  });
  it("has the values of JSON.parse, of any names and values", () => {
    fc.assert(
      fc.property(anyText, (text) => {
        const own = plain(root(text));
        expect(JSON.stringify(own)).toBe(JSON.stringify(JSON.parse(text)));
      }),
    );
  });
  it("knows where each value stands: the text there is the value", () => {
    fc.assert(
      fc.property(anyText, (text) => {
        const tree = root(text);
        for (const path of pathsOf(tree)) {
          const { from, to } = find(tree, path)!,
            wanted = path.reduce<unknown>(
              (at, step) => Object.entries(at as object).find(([name]) => name === String(step))![1],
              JSON.parse(text),
            );
          expect(JSON.parse(text.slice(from, to))).toEqual(wanted);
        }
      }),
    );
  });
  it("is none of a text that is not whole", () => {
    fc.assert(
      fc.property(anyText, fc.nat(), (text, at) => {
        // A JSON object without its end, however much of it is left, is none.
        expect(parse(text.slice(0, at % text.length))).toBeNull();
      }),
    );
    for (const text of ["", "[]", "1", "{", '{"a":}', '{"a":1,}', '{"a" 1}', "{} {}"])
      expect(parse(text), text).toBeNull();
  });
  it("written JSON is read as what was written", () => {
    fc.assert(
      fc.property(anyValue, (json) => {
        const value = JSON.parse(printed(json, [1, 1, 1]));
        expect(JSON.parse(written(value))).toEqual(value);
        expect(written(value)).not.toContain("\n");
      }),
    );
  });
});

describe("edits of a text", () => {
  const made = (text: string, make: (edits: Edits) => ReturnType<Edits["set"]>) => {
    const changes = make(new Edits(text, root(text)));
    return { changes, after: applied(text, changes) };
  };
  // What a value in another's place makes of a value.
  const replaced = (value: unknown, path: Step[], by: unknown): unknown => {
    if (!path.length) return by;
    const [step, ...rest] = path;
    if (Array.isArray(value)) return value.map((one, k) => (k === step ? replaced(one, rest, by) : one));
    return Object.fromEntries(
      Object.entries(value as object).map(([name, one]) => [name, name === step ? replaced(one, rest, by) : one]),
    );
  };

  it("setting what is there changes that value alone, and the inverse gives the text back", () => {
    fc.assert(
      fc.property(anyText, fc.nat(), anyValue, (text, pick, json) => {
        const paths = pathsOf(root(text));
        fc.pre(paths.length > 0);
        const path = paths[pick % paths.length]!,
          raw = printed(json, [1, 1, 1]),
          { changes, after } = made(text, (edits) => edits.set(path, raw));
        expect(JSON.stringify(JSON.parse(after))).toBe(
          JSON.stringify(replaced(JSON.parse(text), path, JSON.parse(raw))),
        );
        expect(applied(after, inverse(text, changes))).toBe(text);
      }),
    );
  });
  it("setting what is not there adds it, and removing it gives the values back", () => {
    fc.assert(
      fc.property(anyText, fc.nat(), anyValue, (text, pick, json) => {
        const tree = root(text),
          owners = [[], ...pathsOf(tree)].filter((path) => find(tree, path)!.sort === "object"),
          path = [...owners[pick % owners.length]!, "a new name"],
          raw = printed(json, [1, 1, 1]),
          { after } = made(text, (edits) => edits.set(path, raw));
        expect(JSON.stringify(plain(find(root(after), path)!))).toBe(JSON.stringify(JSON.parse(raw)));
        const back = made(after, (edits) => edits.remove(path)).after;
        expect(JSON.stringify(JSON.parse(back))).toBe(JSON.stringify(JSON.parse(text)));
      }),
    );
  });
  it("an addition to a scenario is one insertion: every other character stays", () => {
    for (const [name, text] of scenarios) {
      const { changes, after } = made(text, (edits) => edits.set(["objects", "added"], '{ "kind": "shaft" }'));
      expect(changes, name).toHaveLength(1);
      expect(applied(after, inverse(text, changes))).toBe(text);
      const object = made(after, (edits) => edits.remove(["objects", "added"])).after;
      expect(object, name).toBe(text);
    }
  });
  it("removing takes out one value, with its comma", () => {
    fc.assert(
      fc.property(anyText, fc.nat(), (text, pick) => {
        const paths = pathsOf(root(text));
        fc.pre(paths.length > 0);
        const path = paths[pick % paths.length]!,
          { changes, after } = made(text, (edits) => edits.remove(path)),
          owner = find(root(after), path.slice(0, -1))!,
          before = find(root(text), path.slice(0, -1))!;
        expect(owner.members.length + owner.items.length).toBe(before.members.length + before.items.length - 1);
        expect(applied(after, inverse(text, changes))).toBe(text);
      }),
    );
  });
  it("several steps are one change that makes the same text", () => {
    fc.assert(
      fc.property(anyText, fc.array(fc.tuple(fc.nat(), fc.boolean()), { maxLength: 5 }), (text, acts) => {
        const steps = new Steps(new Edits(text, root(text)));
        for (const [pick, isRemoval] of acts) {
          const paths = pathsOf(steps.root),
            path = paths[pick % paths.length];
          if (!path) steps.set(["name"], "1");
          else if (isRemoval) steps.remove(path);
          else steps.set(path, '"other"');
        }
        expect(applied(text, steps.changes)).toBe(steps.edits.text);
      }),
    );
  });
  it("a name and back is the same text, in every scenario", () => {
    for (const [name, text] of scenarios)
      for (const { name: id } of find(root(text), ["objects"])?.members ?? []) {
        const other = "renamed_object",
          after = made(text, (edits) => edits.rename(id, other)).after;
        expect(member(find(root(after), ["objects"]), other), `${name} ${id}`).toBeDefined();
        expect(made(after, (edits) => edits.rename(other, id)).after, `${name} ${id}`).toBe(text);
      }
  });
  it("a copy of an object has its values, and its removal gives the text back", () => {
    for (const [name, text] of scenarios)
      for (const { name: id, value } of find(root(text), ["objects"])?.members ?? []) {
        const { after } = made(text, (edits) => edits.duplicate(["objects", id], "copy_of_it"));
        expect(plain(find(root(after), ["objects", "copy_of_it"])!), name).toEqual(plain(value));
        expect(made(after, (edits) => edits.remove(["objects", "copy_of_it"])).after, name).toBe(text);
      }
  });
});

it("an address is that of the program", () => {
  expect(address(["objects", "rocker", "links", 2, "length"])).toBe("rocker.links[2].length");
  expect(address(["run", "turns"])).toBe("run.turns");
  expect(address(["expect", 0, "value"])).toBe("expect[0].value");
});
