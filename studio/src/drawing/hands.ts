// What the pointer and the keys do in the drawing: a joint is dragged, a tool is pressed, the picture moved.

import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { spotAt, type Board } from "../build";
import { HEIGHT, toPlace, WIDTH, zoomed, type Frame } from "../figure";
import { snapped, type Point } from "../linkage";
import { TOOLS, type Tool } from "../tools";
import type { Acts, Grip } from "./acts";
import { ARROWS, gripOf } from "./grip";

// What a tool was pressed at: where on the screen (by the keyboard: nowhere), and where in the drawing.
interface Press {
  screen: Point;
  place: Point;
}

// How near to a joint is on it, how far a press moves to be a drag (pixels).
export const REACH = 13;
const MOVED = 5;
const isFar = (a: Point, b: Point): boolean => Math.hypot(a[0] - b[0], a[1] - b[1]) > MOVED;

interface Given {
  // Chosen anew, what was begun is forgotten.
  chosen: { tool: Tool };
  board: Board | null;
  view: Frame;
  grid: number;
  // The picture was moved by hand.
  isMoved: boolean;
  setView: (view: Frame) => void;
  acts: Acts;
  held: { current: Grip | null };
  drag: () => number;
  // A link was pressed, or none.
  pressLink: (name: string | null) => void;
  // Escape, when nothing is pressed.
  leave: () => void;
}

export function useHands({ chosen, board, view, grid, isMoved, setView, acts, held, drag, pressLink, leave }: Given) {
  const svg = useRef<SVGSVGElement>(null),
    pan = useRef<{ screen: Point; view: Frame } | null>(null),
    newest = useRef(view);
  const [pressed, setPressed] = useState<Press | null>(null),
    [cursor, setCursor] = useState<Point | null>(null);
  newest.current = view;
  const { tool } = chosen;
  useLayoutEffect(() => {
    setPressed(null);
    setCursor(null);
  }, [chosen]);

  const screen = (event: PointerEvent | WheelEvent): Point => {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.current!.getScreenCTM()!.inverse());
    return [point.x, point.y];
  };
  const spot = (place: Point) => (board ? spotAt(board, place, REACH / view.scale) : null);
  const use = (from: Point, to: Point) => {
    const own = TOOLS[tool],
      reach = REACH / view.scale;
    acts.act((steps, now) => own.act!(steps, now, spotAt(now, from, reach), spotAt(now, to, reach)));
    setPressed(null);
  };
  const press = (next: Press) => {
    const { two, once } = TOOLS[tool],
      at = spot(next.place);
    if (!two || (!pressed && at && once?.(at))) use(next.place, next.place);
    else if (pressed) use(pressed.place, next.place);
    else setPressed(next);
  };
  const down = (event: PointerEvent) => {
    if (event.button !== 0) return;
    const point = screen(event);
    svg.current!.setPointerCapture(event.pointerId);
    if (tool === "select") {
      pan.current = { screen: point, view };
      return;
    }
    event.preventDefault();
    svg.current!.focus();
    press({ screen: point, place: toPlace(view, point) });
  };
  const move = (event: PointerEvent) => {
    const point = screen(event);
    if (held.current) acts.move({ ...held.current, to: toPlace(view, point) });
    else if (pan.current) {
      const { screen: from, view: old } = pan.current;
      if (isMoved || isFar(point, from))
        setView({
          ...old,
          left: old.left - (point[0] - from[0]) / old.scale,
          bottom: old.bottom + (point[1] - from[1]) / old.scale,
        });
    } else if (tool !== "select") setCursor(toPlace(view, point));
  };
  const up = (event: PointerEvent) => {
    move(event);
    const point = screen(event),
      place = toPlace(view, point);
    if (board && pan.current && !isFar(point, pan.current.screen)) {
      const link = spot(place)?.link ?? null;
      pressLink(link === null ? null : board.sketch.links[link]!.name);
    }
    if (pressed && isFar(point, pressed.screen)) use(pressed.place, place);
    held.current = null;
    pan.current = null;
  };
  const cancel = () => {
    held.current = null;
    pan.current = null;
    setPressed(null);
  };
  useEffect(() => {
    const own = svg.current;
    const wheel = (event: WheelEvent) => {
      event.preventDefault();
      setView(zoomed(newest.current, Math.exp(-Math.sign(event.deltaY) * 0.18), screen(event)));
    };
    own?.addEventListener("wheel", wheel, { passive: false });
    return () => own?.removeEventListener("wheel", wheel);
  }, []);

  // Tools go by the keyboard too: the arrow keys move what would be pressed, Enter presses.
  const keys = (event: KeyboardEvent) => {
    if (event.key === "Escape") {
      if (pressed) setPressed(null);
      else leave();
      return;
    }
    if (tool === "select") return;
    const by = ARROWS[event.key],
      from = cursor ?? toPlace(view, [WIDTH / 2, HEIGHT / 2]),
      size = grid * (event.shiftKey ? 10 : 1);
    if (by) {
      const [x, y] = snapped(from, grid);
      setCursor([x + by[0] * size, y + by[1] * size]);
    } else if (event.key === "Enter" || event.key === " ") press({ screen: [NaN, NaN], place: from });
    else return;
    event.preventDefault();
  };
  return {
    svg,
    placeOf: (event: PointerEvent): Point => toPlace(view, screen(event)),
    begin: pressed && spot(pressed.place),
    target: cursor && tool !== "select" ? spot(cursor) : null,
    // What the pointer leaves; what the focus comes to.
    look: (place: Point | null) => {
      if (place ? tool !== "select" : !pressed) setCursor(place);
    },
    ...gripOf(svg, tool, view, { acts, held, drag }),
    handlers: { onKeyDown: keys, onPointerDown: down, onPointerMove: move, onPointerUp: up, onPointerCancel: cancel },
  };
}
export type Hands = ReturnType<typeof useHands>;
