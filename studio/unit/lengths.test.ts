import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { measuresOf, resized, typedMeasure } from "../src/drawing/lengths";
import { lengthOf, type Point, type Sketch } from "../src/linkage";
import { Edits, find, parse } from "../src/tree";
import { applied } from "./scenes";

// A linkage with one link of two points, as a text and as it is drawn.
const linkage = (b: string, dimensions = "{}") =>
  `{ "objects": { "bars": { "dimensions": ${dimensions}, "ground": { "O": [0, 0], "P": ["90 mm", 0] }, "links": { "a": { "points": { "A": ["10 mm", 0], "B": ${b} } } } } } }`;
function drawn(text: string): Sketch {
  const bars = find(parse(text)!, ["objects", "bars"])!,
    points = (path: string[]) =>
      find(bars, path)!.members.map(({ name, value }) => ({
        name,
        at: value.items.map((one) => lengthOf(one, find(bars, ["dimensions"]))!) as Point,
      }));
  return {
    id: "bars",
    told: [],
    ground: points(["ground"]),
    links: [{ name: "a", points: points(["links", "a", "points"]) }],
    pairs: [],
    courses: [],
  };
}
// The text after the length or direction of B was typed; why it was not.
function typed(text: string, asked: { length?: number; angle?: number }): { text: string } | { why: string } {
  const sketch = drawn(text),
    measure = measuresOf(sketch, 0, []).find((one) => one.point === "B")!;
  const made = resized(new Edits(text, parse(text)!), sketch, measure, asked);
  return typeof made === "string" ? { why: made } : { text: applied(text, made) };
}
const measured = (text: string) => measuresOf(drawn(text), 0, []).find((one) => one.point === "B")!;

describe("a typed length", () => {
  const coordinate = fc.double({ min: -0.5, max: 0.5, noNaN: true }).filter((one) => Math.abs(one) > 1e-3),
    length = fc.double({ min: 1e-3, max: 2, noNaN: true }),
    angle = fc.double({ min: -3.1, max: 3.1, noNaN: true });
  it("is that of the text afterwards, the direction stays, and the other way round", () => {
    fc.assert(
      fc.property(coordinate, coordinate, length, angle, fc.boolean(), (x, y, size, turn, isTurn) => {
        const text = linkage(`["${1e3 * x} mm", ${y}]`),
          before = measured(text),
          made = typed(text, isTurn ? { angle: turn } : { length: size });
        if (!("text" in made)) throw new Error(made.why);
        const after = measured(made.text);
        expect(after.length).toBeCloseTo(isTurn ? before.length : size, 10);
        expect(after.angle).toBeCloseTo(isTurn ? turn : before.angle, 7);
        // Nothing else is another, and the unit stays.
        expect(made.text.replace(/"B": \[.*?\]/, "")).toBe(text.replace(/"B": \[.*?\]/, ""));
        expect(made.text).toMatch(/"B": \["[-\d.e]+ mm", [-\d.e]+\]/);
      }),
    );
  });
  it("along an axis changes one number, and a right angle leaves a zero", () => {
    const text = linkage('["60 mm", 0]'),
      sketch = drawn(text);
    expect(measuresOf(sketch, 0, []).map((one) => one.name)).toEqual(["A–B"]);
    expect(typed(text, { length: 0.075 })).toEqual({ text: linkage('["85 mm", 0]') });
    expect(typed(text, { angle: Math.PI / 2 })).toEqual({ text: linkage('["10 mm", "50 mm"]') });
  });
  it("is the number of a dimension where the text names one", () => {
    expect(typed(linkage('["r", 0]', '{ "r": "60 mm" }'), { length: 0.03 })).toEqual({
      text: linkage('["r", 0]', '{ "r": "40 mm" }'),
    });
    expect(typed(linkage('["-r", 0]', '{ "r": "60 mm" }'), { length: 0.03 })).toEqual({
      text: linkage('["-r", 0]', '{ "r": "20 mm" }'),
    });
  });
  it("is held back where the text has a formula, in words that show it", () => {
    for (const [b, dimensions, formula] of [
      ['["r/2", 0]', '{ "r": "60 mm" }', "r/2"],
      ['["r", 0]', '{ "r": "n*2", "n": "30 mm" }', "n*2"],
    ] as const) {
      const text = linkage(b, dimensions);
      const sketch: Sketch = { ...drawn(text), links: [{ name: "a", points: [{ name: "B", at: [0.06, 0] }] }] },
        [measure] = measuresOf(sketch, 0, [{ at: [0, 0], origins: [0], points: [], names: [] }]);
      const made = resized(new Edits(text, parse(text)!), sketch, measure!, { length: 0.03 });
      expect(made).toBe(`links.a.points.B is worked out: it is “${formula}”. Change the numbers of that formula.`);
    }
  });
  it("of the ground is a distance of its points", () => {
    const text = linkage('["60 mm", 0]'),
      sketch = drawn(text),
      [measure] = measuresOf(sketch, null, []);
    expect(measure!.name).toBe("O–P");
    const made = resized(new Edits(text, parse(text)!), sketch, measure!, { length: 0.1 });
    expect(applied(text, made as never)).toBe(text.replace("90 mm", "100 mm"));
  });
});

it("what is typed has a unit of its sort, or the one shown", () => {
  expect(typedMeasure("60", "length", "mm")).toBeCloseTo(0.06, 15);
  expect(typedMeasure("2 in", "length", "mm")).toBeCloseTo(0.0508, 15);
  expect(typedMeasure("3*20 mm", "length", "m")).toBeCloseTo(0.06, 15);
  expect(typedMeasure("-90", "angle", "deg")).toBeCloseTo(-Math.PI / 2, 15);
  for (const [text, sort] of [
    ["-5", "length"],
    ["0", "length"],
    ["60 kg", "length"],
    ["long", "length"],
    ["60 mm", "angle"],
  ] as const)
    expect(typedMeasure(text, sort, sort === "length" ? "mm" : "deg"), text).toBeTypeOf("string");
});
