import fc from "fast-check";
import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { Guide } from "../src/schema";
import { groupOf, literal, shapeOf, type Shape } from "../src/shape";

const guide = new Guide(
  JSON.parse(readFileSync(new URL("../../scenarios/scene.schema.json", import.meta.url), "utf8")),
);
const scalar: Shape = { sort: "scalar", numbers: true, words: [], free: true, units: ["mm"], whole: false };

describe("what was typed, as JSON", () => {
  it("is JSON or a reason, whatever is typed", () => {
    fc.assert(
      fc.property(
        fc.oneof(fc.string(), fc.stringMatching(/^[-+*/^().e0-9 m]{0,10}$/)),
        fc.boolean(),
        (typed, numbers) => {
          const made = literal({ ...scalar, numbers }, typed);
          if ("why" in made) expect(made.why).not.toBe("");
          else expect(["number", "string"]).toContain(typeof JSON.parse(made.json));
        },
      ),
    );
  });
  it("is a number as it is, and one with a unit as text", () => {
    expect(literal(scalar, " 2*3 ")).toEqual({ json: "6" });
    expect(literal(scalar, "2.5 mm")).toEqual({ json: '"2.5 mm"' });
    expect(literal(scalar, "r*2")).toEqual({ json: '"r*2"' });
    expect(literal({ ...scalar, numbers: false }, "2")).toEqual({ json: '"2"' });
    for (const typed of ["1e999", "0x10", "1,5"]) expect(literal(scalar, typed), typed).toHaveProperty("why");
  });
});

describe("the schema of the program", () => {
  it("is a form of every kind: each property has a shape", () => {
    const kinds = Object.entries(guide.root.$defs ?? {}).filter(
      ([name, own]) => own.properties?.kind?.enum?.[0] === name,
    );
    expect(kinds.length).toBeGreaterThanOrEqual(8);
    for (const [name, schema] of kinds) {
      const group = groupOf(guide, schema);
      expect(Object.keys(group.properties).length, name).toBeGreaterThan(1);
      for (const required of [...group.required, ...group.variants])
        expect(group.properties, name).toHaveProperty(required);
      for (const inner of Object.values(group.properties)) expect(shapeOf(guide, inner).sort).toBeTruthy();
    }
  });
});
