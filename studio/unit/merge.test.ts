import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { difference, merged } from "../src/merge";
import { applied } from "./scenes";

// Short texts of few letters, so that much is alike.
const anyText = fc.stringMatching(/^[ab\n]{0,12}$/);

describe("what makes a text another", () => {
  it("applied to the one gives the other", () => {
    fc.assert(
      fc.property(anyText, anyText, (before, after) => {
        expect(applied(before, [difference(before, after)])).toBe(after);
      }),
    );
  });
  it("is nothing where they are alike, and no longer than they are", () => {
    fc.assert(
      fc.property(anyText, anyText, (before, after) => {
        const { from, to, insert } = difference(before, after);
        if (before === after) expect([to - from, insert]).toEqual([0, ""]);
        expect(to - from).toBeLessThanOrEqual(before.length);
        expect(insert.length).toBeLessThanOrEqual(after.length);
      }),
    );
  });
});

describe("the text with the changes of both sides", () => {
  const anyLines = fc.array(fc.stringMatching(/^[a-z]{1,6}$/), { minLength: 3, maxLength: 8 });
  it("has both, where they are of different lines", () => {
    fc.assert(
      fc.property(anyLines, fc.nat(), fc.nat(), fc.string(), fc.string(), (lines, i, j, own, theirs) => {
        const [a, b] = [i % lines.length, j % lines.length];
        fc.pre(a !== b && own !== lines[a] && theirs !== lines[b]);
        const changed = (...which: [number, string][]) => {
          const all = [...lines];
          for (const [k, text] of which) all[k] = `<${text}>`;
          return all.join("\n");
        };
        const both = merged(lines.join("\n"), changed([a, own]), changed([b, theirs]));
        expect(both).toBe(changed([a, own], [b, theirs]));
      }),
    );
  });
  it("is the same from either side", () => {
    fc.assert(
      fc.property(anyText, anyText, anyText, (base, own, theirs) => {
        expect(merged(base, own, theirs)).toBe(merged(base, theirs, own));
      }),
    );
  });
  it("is that of one side where the other changed nothing, or both the same", () => {
    fc.assert(
      fc.property(anyText, anyText, (base, own) => {
        expect(merged(base, own, base)).toBe(own);
        expect(merged(base, base, own)).toBe(own);
        expect(merged(base, own, own)).toBe(own);
      }),
    );
  });
  it("is none where both changed the same place", () => {
    expect(merged("one two", "one three", "one four")).toBeNull();
    expect(merged("ab", "aXb", "aYb")).toBeNull();
  });
});
