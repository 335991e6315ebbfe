import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { typedNumber } from "../src/entry";

// An expression with its value, worked out a second way: as it is made.
const { term } = fc.letrec<{ term: { text: string; value: number } }>((tie) => ({
  term: fc.oneof(
    { depthSize: "small", withCrossShrink: true },
    fc.integer({ min: 0, max: 99 }).map((value) => ({ text: String(value), value })),
    fc.double({ min: 0.01, max: 100, noNaN: true }).map((value) => ({ text: String(value), value })),
    fc.tuple(tie("term"), fc.constantFrom("+", "-", "*", "/"), tie("term")).map(([a, sign, b]) => ({
      text: `(${a.text} ${sign} ${b.text})`,
      value:
        sign === "+"
          ? a.value + b.value
          : sign === "-"
            ? a.value - b.value
            : sign === "*"
              ? a.value * b.value
              : a.value / b.value,
    })),
    tie("term").map(({ text, value }) => ({ text: `-${text}`, value: -value })),
    tie("term").map(({ text, value }) => ({ text: `(${text})^2`, value: value ** 2 })),
  ),
}));

describe("a number as it is typed", () => {
  it("is worked out", () => {
    fc.assert(
      fc.property(term, ({ text, value }) => {
        const found = typedNumber(text);
        if (!Number.isFinite(value)) expect(found.sort).toBe("wrong");
        else {
          expect(found.sort).toBe("number");
          if (found.sort === "number") {
            const off = Math.abs(Number(found.entry.number) - value);
            expect(off).toBeLessThanOrEqual(1e-13 * Math.abs(value));
          }
        }
      }),
    );
  });
  it("is printed and read again as the same number", () => {
    fc.assert(
      fc.property(fc.double({ noNaN: true, noDefaultInfinity: true }), (value) => {
        const found = typedNumber(JSON.stringify(value));
        expect(found.sort).toBe("number");
        if (found.sort === "number") expect(Number(found.entry.number)).toBe(value + 0);
      }),
    );
  });
  it("keeps the unit behind it", () => {
    for (const unit of ["mm", "deg", "N m/rad", "°", "%", "µm", "kg m^2"])
      expect(typedNumber(`3.5 ${unit}`)).toEqual({ sort: "number", entry: { number: "3.5", unit } });
  });
  it("obeys precedence", () => {
    const cases: [string, string][] = [
      ["2+3*4", "14"],
      ["2*3^2", "18"],
      ["-2^2", "-4"],
      ["2^-1", "0.5"],
      ["2**3**2", "512"],
      ["8/4/2", "1"],
      ["1-2-3", "-4"],
      ["1/3", "0.333333333333333"],
      ["−2 × 3", "-6"],
    ];
    for (const [text, number] of cases)
      expect(typedNumber(text), text).toEqual({ sort: "number", entry: { number, unit: "" } });
  });
  it("is refused in words where it is none, whatever is typed", () => {
    for (const text of ["1e999", "-1e999", "1/0", "0/0", "1 +", "(1", "1 2 3", "0x10/", "3 $", "1,5 mm"]) {
      const found = typedNumber(text);
      if (found.sort === "wrong") expect(found.why.length, text).toBeGreaterThan(10);
      else expect(found, text).not.toMatchObject({ sort: "number", entry: { unit: "" } });
    }
    for (const text of ["", "--", "NaN", "Infinity", "abc", "r*2", "2*r"])
      expect(typedNumber(text).sort, text).toBe("text");
  });
  it("never throws, and never gives a number that JSON does not have", () => {
    fc.assert(
      fc.property(fc.oneof(fc.string(), fc.stringMatching(/^[-+*/^().e0-9 x]{0,12}$/)), (text) => {
        const found = typedNumber(text);
        if (found.sort === "number") expect(Number.isFinite(JSON.parse(found.entry.number))).toBe(true);
      }),
      { numRuns: 1000 },
    );
  });
});
