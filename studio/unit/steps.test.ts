import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { wordsOf } from "../src/steps";
import { address, Edits, find, parse, type Step, type Value } from "../src/tree";
import { anyMap, anyStyle, applied, printed, scenarios } from "./scenes";

const scene = (objects: string, more = "") => `{ "dam": 1, "objects": { ${objects} }${more} }`;
const rocker = (inertia: string) => `"rocker": { "kind": "rocker", "inertia": ${inertia} }`;

describe("a step in words", () => {
  it("says numbers with their unit, and both units where they differ", () => {
    const words = (a: string, b: string) => wordsOf(scene(rocker(a)), scene(rocker(b)));
    expect(words('"0.1 kg m^2"', '"0.2 kg m^2"')).toBe("rocker.inertia 0.1 → 0.2 kg m²");
    expect(words('"0.1 kg m^2"', '"2 kg cm^2"')).toBe("rocker.inertia 0.1 kg m² → 2 kg cm²");
    expect(words("0.1", "0.2")).toBe("rocker.inertia 0.1 → 0.2");
    expect(words("0.1", '"2*m + 5 kg m^2"')).toBe("rocker.inertia 0.1 → 2*m + 5 kg m^2");
    expect(wordsOf(scene(rocker("0.1")), scene(rocker("0.2")), (address) => `${address}^2`)).toBe(
      "rocker.inertia 0.1 → 0.2 rocker.inertia²",
    );
    expect(words("0.1", "[1, 2]")).toBe("rocker.inertia 0.1 → [1, 2]");
    expect(words("0.1", '{ "a": 1 }')).toBe("rocker.inertia changed");
  });
  it("says what came, went and was renamed", () => {
    const one = scene(rocker("1")),
      two = scene(`${rocker("1")}, "cam": { "kind": "cam_follower", "input": "rocker" }`);
    expect(wordsOf(one, two)).toBe("cam added");
    expect(wordsOf(two, one)).toBe("cam removed");
    const { root, text } = new Edits(two, parse(two)!);
    expect(wordsOf(text, applied(text, new Edits(text, root).rename("rocker", "lever")))).toBe("rocker renamed lever");
    expect(wordsOf(one, scene(rocker("1"), ', "run": { "turns": 2 }'))).toBe("run added");
    expect(wordsOf(one, scene('"rocker": { "kind": "rocker", "inertia": 1, "gap": "1 mm" }'))).toBe(
      "rocker.gap 1 mm added",
    );
  });
  it("says which links moved", () => {
    const linkage = (b: string, ground: string, more = "") =>
      scene(
        `"bars": { "kind": "linkage", "ground": { "o": ${ground} }, "links": { "a": { "points": { "p": [1, 2] } }, "b": { "points": { "p": ${b} } }${more} } }`,
      );
    const before = linkage("[0, 1]", "[0, 0]");
    expect(wordsOf(before, linkage("[0, 2]", "[0, 0]"))).toBe("link b of bars moved");
    expect(wordsOf(before, linkage("[0, 2]", "[1, 0]"))).toBe("link b and ground of bars moved");
    expect(wordsOf(before, linkage("[0, 1]", "[1, 0]"))).toBe("ground of bars moved");
    expect(wordsOf(before, linkage("[0, 1]", "[0, 0]", ', "c": {}'))).toBe("link c added of bars");
  });
  it("says where a text was edited that is not whole, and that nothing but its layout is another", () => {
    expect(wordsOf('{\n  "a": 1\n}', '{\n  "a": \n}')).toBe("text edited in line 2");
    fc.assert(
      fc.property(anyMap, anyStyle, anyStyle, (map, one, other) => {
        expect(wordsOf(printed(map, one), printed(map, other))).toBe("layout of the text");
      }),
    );
  });
  // All single values of a scene.
  const scalars = (value: Value, path: Step[] = []): Step[][] =>
    value.sort === "object"
      ? value.members.flatMap((one) => scalars(one.value, [...path, one.name]))
      : value.sort === "number" || value.sort === "string"
        ? [path]
        : [];
  it("names the address of any value that is changed, before and after, and both ways", () => {
    for (const [name, text] of scenarios) {
      const edits = new Edits(text, parse(text)!);
      for (const path of scalars(edits.root).filter((_, k) => k % 17 === name.length % 17)) {
        const after = applied(text, edits.set(path, "4711")),
          words = wordsOf(text, after),
          back = wordsOf(after, text);
        expect(words, name).toContain(address(path).slice(0, 50));
        expect(words.endsWith("→ 4711"), `${name}: ${words}`).toBe(true);
        expect(back, name).toContain("4711 →");
        expect(find(parse(after)!, path)!.text).toBe("4711");
      }
    }
  });
  it("says of objects of every scenario that it was removed, and added again", () => {
    for (const [name, text] of scenarios) {
      const edits = new Edits(text, parse(text)!);
      for (const { name: id } of find(edits.root, ["objects"])?.members.slice(-2) ?? []) {
        const after = applied(text, edits.remove(["objects", id]));
        expect(wordsOf(text, after), name).toBe(`${id} removed`);
        expect(wordsOf(after, text), name).toBe(`${id} added`);
      }
    }
  });
  it("is one short line, whatever the texts are", () => {
    fc.assert(
      fc.property(anyMap, anyMap, anyStyle, fc.nat(), (one, other, style, cut) => {
        const before = printed(one, style),
          after = printed(other, style);
        for (const words of [wordsOf(before, after), wordsOf(before, after.slice(0, cut % after.length))]) {
          expect(words.length).toBeGreaterThan(0);
          expect(Array.from(words).length).toBeLessThanOrEqual(100);
          expect(words).not.toMatch(/\p{C}/u);
        }
      }),
    );
  });
});
