// Where the bars between the parts of the workbench stand, which is remembered.

import { signal } from "@preact/signals";
import { Kept } from "../link";
import { link } from "./line";

const kept = new Kept("layout");

// Width of the numbers (pixels), and shares of the graph in the width of the canvas and of the canvas
// in the height of the workbench.
export interface Layout {
  side: number;
  graph: number;
  canvas: number;
}
export const DEFAULT: Layout = { side: 316, graph: 0.4, canvas: 0.55 };
export const LIMITS: Record<keyof Layout, [number, number]> = {
  side: [200, 640],
  graph: [0.12, 0.85],
  canvas: [0.2, 0.85],
};

const within = (name: keyof Layout, value: number): number =>
  Math.min(LIMITS[name][1], Math.max(LIMITS[name][0], value));

function stored(): Layout {
  const layout = { ...DEFAULT };
  try {
    const found = JSON.parse(kept.get() ?? "{}");
    for (const name of Object.keys(layout) as (keyof Layout)[])
      if (Number.isFinite(found[name])) layout[name] = within(name, found[name]);
  } catch {
    /* What cannot be read was not chosen. */
  }
  return layout;
}

export const layout = signal(stored());

// Moves a bar; it is kept once it is let go.
export function place(name: keyof Layout, value: number, isLast: boolean): void {
  layout.value = { ...layout.peek(), [name]: within(name, value) };
  if (isLast) kept.set(JSON.stringify(layout.peek()), link);
}

// The layout that another browser was given.
export function offered(settings: Record<string, string>): void {
  if (kept.offer(settings)) layout.value = stored();
}
