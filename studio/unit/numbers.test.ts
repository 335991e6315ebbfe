import { EditorState } from "@codemirror/state";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { fieldOf, fields, setFields, shareOf, spanOf, typed, valueAt, written, type Field } from "../src/numbers";
import { applied } from "./scenes";

const field = (more: Partial<Field>): Field => ({
  address: "rocker.inertia",
  label: "inertia",
  value_at: [0, 3],
  number_at: [0, 3],
  value: 1,
  unit: "",
  quantity: "inertia",
  si: "kg m^2",
  units: [],
  bounds: [null, null],
  included: [true, true],
  factor: 1,
  whole: false,
  ...more,
});
const size = fc.double({ min: 1e-9, max: 1e9, noNaN: true });
const anyField = fc.oneof(
  size.map((value) => field({ value, bounds: [0, null], included: [false, true] })),
  fc.tuple(size, fc.boolean()).map(([value, isBelow]) => field({ value: isBelow ? -value : value })),
  size.map((value) => field({ value, bounds: [0, null] })),
  fc.nat(1000).map((value) => field({ value, whole: true, bounds: [1, null] })),
  fc.double({ min: 0, max: 1, noNaN: true }).map((value) => field({ value, bounds: [0, 1] })),
);

describe("how far a number may be moved", () => {
  it("a span has its number in it, and stays within the bounds", () => {
    fc.assert(
      fc.property(anyField, (own) => {
        const { low, high } = spanOf(own),
          [least, most] = own.bounds;
        expect(high).toBeGreaterThan(low);
        if (!own.whole || own.value >= 1) expect(own.value).toBeGreaterThanOrEqual(low);
        expect(own.value).toBeLessThanOrEqual(high);
        if (least !== null) expect(low).toBeGreaterThanOrEqual(least);
        if (most !== null) expect(high).toBeLessThanOrEqual(Math.max(most, low + 1));
      }),
    );
  });
  it("share and value are inverse to each other", () => {
    fc.assert(
      fc.property(anyField, fc.double({ min: 0, max: 1, noNaN: true }), (own, share) => {
        const span = spanOf(own);
        // Of the smallest numbers there is no half.
        fc.pre(span.high - span.low > 1e-300);
        expect(shareOf(span, valueAt(span, share))).toBeCloseTo(share, 9);
      }),
    );
  });
  it("a slider at either end gives the ends", () => {
    fc.assert(
      fc.property(anyField, (own) => {
        const span = spanOf(own);
        expect(valueAt(span, 0)).toBe(span.low);
        expect(Math.abs(valueAt(span, 1) - span.high)).toBeLessThanOrEqual(1e-12 * Math.abs(span.high));
      }),
    );
  });
});

describe("a number as text", () => {
  it("is JSON, and close to the value: four digits, or a step of the span", () => {
    fc.assert(
      fc.property(anyField, fc.double({ min: 0, max: 1, noNaN: true }), (own, share) => {
        const span = spanOf(own),
          value = valueAt(span, share),
          text = written(value, "1", own.whole, span),
          back: unknown = JSON.parse(text);
        expect(typeof back).toBe("number");
        const off = Math.abs((back as number) - value),
          allowed = own.whole ? 0.5 : span.log ? 5.1e-4 * Math.abs(value) : (span.high - span.low) / 500;
        expect(off).toBeLessThanOrEqual(allowed * (1 + 1e-9));
      }),
    );
  });
  it("of the smallest size is a number too", () => {
    expect(written(5e-324, "1", false, { low: 0, high: 1.5e-323, log: false })).toBe("5e-324");
  });
  it("is written again as it was: print and read are inverse", () => {
    fc.assert(
      fc.property(fc.double({ min: -1e12, max: 1e12, noNaN: true }), fc.constantFrom("1", "1e7"), (value, before) => {
        const text = written(value, before, false);
        expect(written(Number(text), before, false)).toBe(text);
      }),
    );
  });
  it("keeps to the notation of its author", () => {
    expect(written(2.5e7, "1e7", false)).toBe("2.5e7");
    expect(written(2.5e7, "10000000", false)).toBe("25000000");
    expect(written(0.25, "1e7", false)).toBe("0.25");
    expect(written(-0, "1", false)).toBe("0");
  });
});

describe("a number that is typed into the field of a slider", () => {
  const text = '"10 mm"',
    own = field({ value_at: [0, 7], number_at: [1, 3], unit: "mm", units: ["mm", "m"] });
  it("without a unit, or with its own, changes the number alone", () => {
    for (const entry of ["12", "12 mm"]) expect(applied(text, [typed(own, entry) as never])).toBe('"12 mm"');
  });
  it("with another unit changes the value", () => {
    expect(applied(text, [typed(own, "0.5 m") as never])).toBe('"0.5 m"');
  });
  it("is refused in words where it is none", () => {
    for (const entry of ["", "--", "NaN", "Infinity", "1e999", "0x10", "1,5", "1 / 0", "abc", "1 $", "()"])
      expect(typeof typed(own, entry), entry).toBe("string");
    expect(typed(own, "1,5")).toBe("Use a decimal point: 1.5");
    expect(typed(field({ whole: true }), "2.5")).toBe("This is a whole number.");
    expect(typed(field({ whole: true }), "2 m")).toBe("This is a whole number.");
  });
});

describe("numbers of a text", () => {
  it("move with the text until they are told anew", () => {
    const doc = '{ "a": 5, "b": 7 }',
      at = (name: string, from: number) =>
        field({ address: name, number_at: [from, from + 1], value_at: [from, from + 1] });
    let state = EditorState.create({ doc, extensions: [fields] });
    state = state.update({ effects: setFields.of([at("a", 7), at("b", 15)]) }).state;
    fc.assert(
      fc.property(fc.nat({ max: 10 ** 9 }), (number) => {
        const [from, to] = fieldOf(state, "a")!.number_at,
          next = state.update({ changes: { from, to, insert: String(number) } }).state,
          [a, b] = [fieldOf(next, "a")!, fieldOf(next, "b")!];
        expect(a.value).toBe(number);
        expect(next.sliceDoc(...b.number_at)).toBe("7");
        expect(next.sliceDoc(...a.number_at)).toBe(String(number));
      }),
    );
  });
  it("keep their value while what stands there is no number", () => {
    let state = EditorState.create({ doc: "5", extensions: [fields] });
    state = state.update({ effects: setFields.of([field({ value: 5, number_at: [0, 1], value_at: [0, 1] })]) }).state;
    state = state.update({ changes: { from: 0, to: 1, insert: "-" } }).state;
    expect(fieldOf(state, "rocker.inertia")!.value).toBe(5);
  });
});
