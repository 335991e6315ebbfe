// The pointer and the keys while the picture below the drawing is moved, or marked to be scaled.

import { useRef, useState } from "preact/hooks";
import { HEIGHT, toPlace, WIDTH, type Frame } from "../figure";
import type { Point } from "../linkage";
import { ARROWS } from "./grip";
import type { Under } from "./under";
import { shifted, type Underlay } from "./underlay";

interface Given {
  under: Under;
  view: Frame;
  // How far an arrow key goes (m).
  grid: number;
  placeOf: (event: PointerEvent) => Point;
}

// Null: the drawing has its own.
export function useUnderHands({ under, view, grid, placeOf }: Given) {
  const { own, mode, set, mark, begin } = under,
    held = useRef<{ place: Point; own: Underlay } | null>(null),
    [cursor, setCursor] = useState<Point | null>(null);
  if (mode === "rest" || !own) return null;
  const isMove = mode === "move",
    aim = cursor ?? toPlace(view, [WIDTH / 2, HEIGHT / 2]);
  const down = (event: PointerEvent) => {
    if (event.button !== 0) return;
    const place = placeOf(event),
      svg = event.currentTarget as SVGElement;
    event.preventDefault();
    svg.focus();
    svg.setPointerCapture(event.pointerId);
    if (isMove) held.current = { place, own };
    else mark(place);
  };
  const move = (event: PointerEvent) => {
    const place = placeOf(event),
      from = held.current;
    if (from) set(shifted(from.own, [place[0] - from.place[0], place[1] - from.place[1]]));
    else setCursor(place);
  };
  const end = () => {
    held.current = null;
  };
  const keys = (event: KeyboardEvent) => {
    const by = ARROWS[event.key],
      step = grid * (event.shiftKey ? 10 : 1);
    if (event.key === "Escape") begin("rest");
    else if (by && isMove) set(shifted(own, [by[0] * step, by[1] * step]));
    else if (by) setCursor([aim[0] + by[0] * step, aim[1] + by[1] * step]);
    else if (!isMove && (event.key === "Enter" || event.key === " ")) mark(aim);
    else return;
    event.preventDefault();
  };
  return {
    aim: isMove ? null : aim,
    handlers: { onKeyDown: keys, onPointerDown: down, onPointerMove: move, onPointerUp: end, onPointerCancel: end },
  };
}
