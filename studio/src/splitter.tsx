// The bars between the parts of the workbench, dragged or moved with the arrow keys.

import { DEFAULT, layout, LIMITS, place, type Layout } from "./store/layout";
import "./splitter.css";

// What an arrow key moves.
const STEP: Record<keyof Layout, number> = { side: 16, graph: 0.02, canvas: 0.02 };

interface Props {
  name: keyof Layout;
  label: string;
  upright: boolean;
}

export function Splitter({ name, label, upright }: Props) {
  const value = layout.value[name],
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
    if (event.key === back || event.key === on) place(name, value + (event.key === on ? 1 : -1) * STEP[name], true);
    else if (event.key === "Home") place(name, DEFAULT[name], true);
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
      onDblClick={() => place(name, DEFAULT[name], true)}
      onPointerDown={(event) => {
        event.preventDefault();
        event.currentTarget.focus();
        event.currentTarget.setPointerCapture(event.pointerId);
      }}
      onPointerMove={(event) => {
        if (event.currentTarget.hasPointerCapture(event.pointerId)) place(name, at(event, event.currentTarget), false);
      }}
      onPointerUp={(event) => {
        if (event.currentTarget.hasPointerCapture(event.pointerId)) place(name, at(event, event.currentTarget), true);
      }}
    />
  );
}
