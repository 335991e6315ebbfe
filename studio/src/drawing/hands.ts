// What the pointer and the keys do in the drawing: a joint is dragged, a tool is pressed, the picture moved.

import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { removed, spotAt, type Board } from "../build";
import { HEIGHT, toPlace, WIDTH, zoomed, type Frame } from "../figure";
import { snapped, stepOf, type Joint, type Point } from "../linkage";
import { TOOLS, type Tool } from "../tools";
import type { Acts, Grip } from "./acts";

// What a tool was pressed at: where on the screen (by the keyboard: nowhere), and where in the drawing.
interface Press {
  screen: Point;
  place: Point;
}

// How near to a joint is on it, how far a press moves to be a drag (pixels).
export const REACH = 13;
const MOVED = 5;
const ARROWS: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
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

  // A joint is taken.
  const take = (joint: Joint, event: PointerEvent) => {
    if (event.button !== 0 || tool !== "select") return;
    event.preventDefault();
    event.stopPropagation();
    (event.currentTarget as SVGElement).focus();
    svg.current!.setPointerCapture(event.pointerId);
    held.current = { joint: joint.names[0]!, drag: drag() };
  };
  const jointKeys = (joint: Joint, event: KeyboardEvent) => {
    if (tool !== "select" || event.ctrlKey || event.metaKey) return;
    const name = joint.names[0]!,
      by = ARROWS[event.key],
      size = stepOf(1.5 / view.scale) * (event.shiftKey ? 10 : 1);
    if (event.key === "Delete" || event.key === "Backspace")
      acts.act((steps, now) => {
        const own = now.joints.find((one) => one.names.includes(name)) ?? null;
        return removed(steps, now, { at: joint.at, joint: own, link: null });
      });
    else if (by) acts.move({ joint: name, drag: drag(), to: [joint.at[0] + by[0] * size, joint.at[1] + by[1] * size] });
    else return;
    event.preventDefault();
  };
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
    begin: pressed && spot(pressed.place),
    target: cursor && tool !== "select" ? spot(cursor) : null,
    // What the pointer leaves; what the focus comes to.
    look: (place: Point | null) => {
      if (place ? tool !== "select" : !pressed) setCursor(place);
    },
    jointKeys,
    take,
    handlers: { onKeyDown: keys, onPointerDown: down, onPointerMove: move, onPointerUp: up, onPointerCancel: cancel },
  };
}
export type Hands = ReturnType<typeof useHands>;
