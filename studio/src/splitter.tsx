// The bars between the parts of the workbench, dragged or moved with the arrow keys; where they stand
// is remembered.

import { useState } from "preact/hooks";
import { Kept, type Link } from "./link";
import "./splitter.css";

const kept = new Kept("layout");

// Width of the numbers (pixels), and shares of the graph in the width of the canvas and of the canvas
// in the height of the workbench.
export interface Layout {
  side: number;
  graph: number;
  canvas: number;
}
const DEFAULT: Layout = { side: 316, graph: 0.4, canvas: 0.55 };
const LIMITS: Record<keyof Layout, [number, number]> = { side: [200, 640], graph: [0.12, 0.85], canvas: [0.2, 0.85] };
// What an arrow key moves.
const STEP: Record<keyof Layout, number> = { side: 16, graph: 0.02, canvas: 0.02 };

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

// The layout, and what changes it; what another browser was given with `again`.
export function useLayout(link: Link) {
  const [layout, setLayout] = useState(stored);
  const set = (name: keyof Layout, value: number, last: boolean) => {
    const next = { ...layout, [name]: within(name, value) };
    setLayout(next);
    if (last) kept.set(JSON.stringify(next), link);
  };
  const offered = (settings: Record<string, string>) => {
    if (kept.offer(settings)) setLayout(stored());
  };
  return { layout, set, offered };
}

interface Props {
  name: keyof Layout;
  label: string;
  upright: boolean;
  layout: Layout;
  set: (name: keyof Layout, value: number, last: boolean) => void;
}

export function Splitter({ name, label, upright, layout, set }: Props) {
  const value = layout[name],
    [low, high] = LIMITS[name],
    share = Math.round((100 * (value - low)) / (high - low));
  // The parent is divided from left to right; from top to bottom what stands before the bar and behind it.
  const at = (event: PointerEvent, bar: HTMLElement) => {
    const room = bar.parentElement!.getBoundingClientRect();
    if (upright) return (event.clientX - room.left) / (name === "side" ? 1 : room.width);
    const { top } = bar.previousElementSibling!.getBoundingClientRect(),
      { bottom } = bar.nextElementSibling!.getBoundingClientRect();
    return (event.clientY - top) / (bottom - top);
  };
  const keys = (event: KeyboardEvent) => {
    const back = upright ? "ArrowLeft" : "ArrowUp",
      on = upright ? "ArrowRight" : "ArrowDown";
    if (event.key === back || event.key === on) set(name, value + (event.key === on ? 1 : -1) * STEP[name], true);
    else if (event.key === "Home") set(name, DEFAULT[name], true);
    else return;
    event.preventDefault();
  };
  return (
    <div
      class={`splitter ${name}-bar ${upright ? "upright" : "level"}`}
      role="separator"
      tabindex={0}
      aria-label={label}
      aria-orientation={upright ? "vertical" : "horizontal"}
      aria-valuenow={share}
      aria-valuemin={0}
      aria-valuemax={100}
      title={`${label}: drag, or arrow keys; a double click sets it back`}
      onKeyDown={keys}
      onDblClick={() => set(name, DEFAULT[name], true)}
      onPointerDown={(event) => {
        event.preventDefault();
        event.currentTarget.focus();
        event.currentTarget.setPointerCapture(event.pointerId);
      }}
      onPointerMove={(event) => {
        if (event.currentTarget.hasPointerCapture(event.pointerId)) set(name, at(event, event.currentTarget), false);
      }}
      onPointerUp={(event) => {
        if (event.currentTarget.hasPointerCapture(event.pointerId)) set(name, at(event, event.currentTarget), true);
      }}
    />
  );
}
