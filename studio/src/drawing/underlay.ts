// A picture or a DXF plan below the drawing: where it lies, how large it is, and how it is moved and scaled.

import { HEIGHT, toPlace, WIDTH, type Frame } from "../figure";
import { far, type Point } from "../linkage";

export interface Underlay {
  // Of its lower left corner (m), and the size of one of its pixels, or of the unit of its file (m).
  left: number;
  bottom: number;
  pixel: number;
  // In pixels of its own.
  width: number;
  height: number;
  opacity: number;
}

// In the middle of what is in sight: four fifths of it, or as large as its own unit (m) makes it.
export function laidIn(view: Frame, width: number, height: number, unit: number | null = null): Underlay {
  const pixel = unit ?? 0.8 * Math.min(WIDTH / view.scale / width, HEIGHT / view.scale / height),
    [x, y] = toPlace(view, [WIDTH / 2, HEIGHT / 2]);
  return { left: x - (pixel * width) / 2, bottom: y - (pixel * height) / 2, pixel, width, height, opacity: 0.5 };
}

export const shifted = (own: Underlay, [x, y]: Point): Underlay => ({
  ...own,
  left: own.left + x,
  bottom: own.bottom + y,
});

// So large that two places of it are as far from each other as was typed; the first stays. Null: they
// are one place.
export function scaledTo(own: Underlay, a: Point, b: Point, distance: number): Underlay | null {
  const factor = distance / far(a, b);
  if (!Number.isFinite(factor) || factor <= 0) return null;
  const { left, bottom, pixel } = own;
  return {
    ...own,
    left: a[0] + factor * (left - a[0]),
    bottom: a[1] + factor * (bottom - a[1]),
    pixel: factor * pixel,
  };
}
