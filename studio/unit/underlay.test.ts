import fc from "fast-check";
import { expect, it } from "vitest";
import { laidIn, scaledTo, shifted, type Underlay } from "../src/drawing/underlay";
import { HEIGHT, toPixel, WIDTH } from "../src/figure";
import type { Point } from "../src/linkage";

const place = fc.double({ min: -2, max: 2, noNaN: true }),
  anyPoint = fc.tuple(place, place) as fc.Arbitrary<Point>,
  size = fc.integer({ min: 1, max: 8000 }),
  view = fc.record({ left: place, bottom: place, scale: fc.double({ min: 1, max: 1e5, noNaN: true }) }),
  laid = fc.tuple(view, size, size).map(([own, width, height]) => laidIn(own, width, height));
// The pixel of a picture at a place of the drawing, and the other way.
const pixelAt = (own: Underlay, [x, y]: Point): Point => [(x - own.left) / own.pixel, (y - own.bottom) / own.pixel];
const placeOf = (own: Underlay, [u, v]: Point): Point => [own.left + own.pixel * u, own.bottom + own.pixel * v];

it("a new picture lies in sight, in its own proportions", () => {
  fc.assert(
    fc.property(view, size, size, (own, width, height) => {
      const made = laidIn(own, width, height),
        [x, y] = toPixel(own, [made.left, made.bottom]),
        [right, top] = toPixel(own, placeOf(made, [width, height]));
      for (const [value, most] of [
        [x, WIDTH],
        [right, WIDTH],
        [y, HEIGHT],
        [top, HEIGHT],
      ] as const) {
        expect(value).toBeGreaterThan(0);
        expect(value).toBeLessThan(most);
      }
      expect((right - x) / (y - top) / (width / height)).toBeCloseTo(1, 5);
    }),
  );
});

it("two places have the distance that was typed, the first stays where it is", () => {
  fc.assert(
    fc.property(laid, anyPoint, anyPoint, fc.double({ min: 1e-3, max: 10, noNaN: true }), (own, a, b, distance) => {
      fc.pre(Math.hypot(a[0] - b[0], a[1] - b[1]) > 1e-3);
      const made = scaledTo(own, a, b, distance)!,
        [p, q] = [placeOf(made, pixelAt(own, a)), placeOf(made, pixelAt(own, b))];
      expect(Math.hypot(p[0] - a[0], p[1] - a[1])).toBeLessThan(1e-6 * (1 + distance));
      expect(Math.hypot(p[0] - q[0], p[1] - q[1]) / distance).toBeCloseTo(1, 6);
      expect([made.width, made.height, made.opacity]).toEqual([own.width, own.height, own.opacity]);
    }),
  );
  const own = laidIn({ left: 0, bottom: 0, scale: 1000 }, 100, 100);
  expect(scaledTo(own, [1, 1], [1, 1], 1)).toBeNull();
  expect(scaledTo(own, [1, 1], [2, 1], 0)).toBeNull();
});

it("moved there and back it lies where it was", () => {
  fc.assert(
    fc.property(laid, anyPoint, (own, by) => {
      const back = shifted(shifted(own, by), [-by[0], -by[1]]);
      expect(back.left).toBeCloseTo(own.left, 9);
      expect(back.bottom).toBeCloseTo(own.bottom, 9);
      expect(back.pixel).toBe(own.pixel);
    }),
  );
});
