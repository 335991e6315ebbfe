import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  gridOf,
  length,
  lengthOf,
  placed,
  poseAt,
  snapped,
  stepOf,
  within,
  type Point,
  type Sketch,
} from "../src/linkage";
import { parse, find, type Value } from "../src/tree";

const place = fc.double({ min: -10, max: 10, noNaN: true });
const anyPoint = fc.tuple(place, place) as fc.Arbitrary<Point>;
const value = (json: string): Value => find(parse(`{ "a": ${json} }`)!, ["a"])!;

describe("points of a linkage", () => {
  it("go from a link to the ground and back", () => {
    fc.assert(
      fc.property(anyPoint, anyPoint, place, (origin, point, angle) => {
        const pose = [9, 9, 1, 0, ...origin, Math.cos(angle), Math.sin(angle)],
          back = within(pose, 1, placed(pose, 1, point));
        expect(back[0]).toBeCloseTo(point[0], 9);
        expect(back[1]).toBeCloseTo(point[1], 9);
        expect(placed(pose, null, point)).toEqual(point);
      }),
    );
  });
  it("keep their distances on a link", () => {
    fc.assert(
      fc.property(anyPoint, anyPoint, anyPoint, place, (origin, a, b, angle) => {
        const pose = [...origin, Math.cos(angle), Math.sin(angle)],
          [p, q] = [placed(pose, 0, a), placed(pose, 0, b)];
        expect(Math.hypot(p[0] - q[0], p[1] - q[1])).toBeCloseTo(Math.hypot(a[0] - b[0], a[1] - b[1]), 9);
      }),
    );
  });
});

describe("lengths as text", () => {
  it("are read as they were written, in the unit of the one before", () => {
    fc.assert(
      fc.property(place, fc.constantFrom('"3 mm"', '"3 cm"', '"0.1 m"', "0.2", "0", '"7 µm"'), (metres, before) => {
        const text = length(metres, value(before)),
          back = lengthOf(value(text), undefined)!;
        expect(Math.abs(back - metres)).toBeLessThanOrEqual(1e-11 * Math.abs(metres) + 1e-12);
        const unit = /[a-zµ]+/.exec(before)?.[0];
        if (unit) expect(text).toContain(unit);
      }),
    );
  });
  it("are those of dimensions, of multiples and with a sign", () => {
    const dimensions = value('{ "r": "20 mm", "n": 0.5 }');
    const of = (json: string) => lengthOf(value(json), dimensions);
    expect(of('"r"')).toBeCloseTo(0.02, 15);
    expect(of('"-r"')).toBeCloseTo(-0.02, 15);
    expect(of('"r*3"')).toBeCloseTo(0.06, 15);
    expect(of('"r/4"')).toBeCloseTo(0.005, 15);
    expect(of('"n"')).toBe(0.5);
    for (const json of ['"other"', '"3 kg"', "true", '"r+1"', "null"]) expect(of(json), json).toBeNull();
  });
});

describe("steps and grids", () => {
  const size = fc.double({ min: 1e-8, max: 1e6, noNaN: true });
  it("a grid is 1, 2 or 5 by a power of ten, at least as large and at most two and a half times", () => {
    fc.assert(
      fc.property(size, (metres) => {
        const grid = gridOf(metres),
          digit = Math.round(grid / 10 ** Math.floor(Math.log10(grid) + 1e-9));
        expect([1, 2, 5, 10]).toContain(digit);
        expect(grid).toBeGreaterThanOrEqual(metres * (1 - 1e-8));
        expect(grid).toBeLessThanOrEqual(2.5 * metres * (1 + 1e-8));
        expect(stepOf(metres)).toBeLessThanOrEqual(metres * (1 + 1e-9));
      }),
    );
  });
  it("a snapped point is on the grid, at most half of it away, and stays there", () => {
    fc.assert(
      fc.property(anyPoint, fc.constantFrom(0.001, 0.02, 0.5), (point, grid) => {
        const own = snapped(point, grid);
        for (const k of [0, 1] as const) expect(Math.abs(own[k] - point[k])).toBeLessThanOrEqual(grid / 2 + 1e-12);
        expect(snapped(own, grid)).toEqual(own);
      }),
    );
  });
});

it("a position is found where a course leads to it, and nowhere else", () => {
  const course = (name: string, poses: number[][]) => ({
    name,
    unit: "rad",
    range: "",
    values: [0, 1, 2],
    start: 1,
    poses,
  });
  const sketch: Sketch = {
    id: "a",
    told: [],
    links: [],
    ground: [],
    pairs: [],
    courses: [course("x", [[10], [11], [12]]), course("y", [[20], [11], [22]])],
  };
  expect(poseAt(sketch, [1, 1])).toEqual([11]);
  expect(poseAt(sketch, [2, 1])).toEqual([12]);
  expect(poseAt(sketch, [1, 0])).toEqual([20]);
  expect(poseAt(sketch, [2, 0])).toBeUndefined();
});
