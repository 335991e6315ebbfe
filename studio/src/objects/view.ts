// The part of the graph that is in sight: moved, nearer or farther, all of it as objects come and go.

import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { BOX, within, type Box } from "../graph";

export interface View {
  x: number;
  y: number;
  k: number;
}
interface Place {
  x: number;
  y: number;
}
// A graph of more objects is built where it is in sight.
export const MANY = 60;

// Room for the names of several outputs, which stand behind their box.
const NAMES = 48;
const endOf = ({ x, object }: Box): number => x + BOX.width + (object.outputs.length > 1 ? NAMES : 0);

function fitted(drawn: Box[], room: { width: number; height: number }): View {
  const right = drawn.reduce((most, box) => Math.max(most, endOf(box)), BOX.width),
    bottom = drawn.reduce((most, box) => Math.max(most, box.y + box.height), BOX.head);
  const k = Math.max(0.3, Math.min(1.25, (room.width - 48) / right, (room.height - 40) / bottom));
  return { k, x: (room.width - k * right) / 2, y: (room.height - k * bottom) / 2 };
}

export function useView(drawn: Box[]) {
  const svg = useRef<SVGSVGElement>(null),
    pan = useRef<(Place & { view: View }) | null>(null);
  const [view, setView] = useState<View | null>(null);
  const now = view ?? { x: 24, y: 20, k: 1 },
    shape = drawn.map((box) => `${box.object.id} ${box.x} ${box.y} ${box.height}`).join();
  const fit = () => setView(fitted(drawn, svg.current?.getBoundingClientRect() ?? { width: 500, height: 400 }));
  const zoom = (factor: number, clientX?: number, clientY?: number) =>
    setView((before) => {
      const own = svg.current!.getBoundingClientRect(),
        old = before ?? now;
      const k = Math.min(3, Math.max(0.2, old.k * factor)),
        x = (clientX ?? own.left + own.width / 2) - own.left,
        y = (clientY ?? own.top + own.height / 2) - own.top;
      return { k, x: x - ((x - old.x) * k) / old.k, y: y - ((y - old.y) * k) / old.k };
    });
  // What is drawn stays in sight as objects come and go.
  useLayoutEffect(fit, [shape]);
  useEffect(() => {
    const own = svg.current!,
      room = new ResizeObserver(fit);
    room.observe(own);
    const wheel = (event: WheelEvent) => {
      event.preventDefault();
      zoom(Math.exp(-Math.sign(event.deltaY) * 0.18), event.clientX, event.clientY);
    };
    own.addEventListener("wheel", wheel, { passive: false });
    return () => {
      room.disconnect();
      own.removeEventListener("wheel", wheel);
    };
  }, [shape]);
  const placeOf = (event: PointerEvent): Place => {
    const own = svg.current!.getBoundingClientRect();
    return { x: (event.clientX - own.left - now.x) / now.k, y: (event.clientY - own.top - now.y) / now.k };
  };
  // Moved with the pointer.
  const hold = (event: PointerEvent) => {
    if (event.button !== 0) return;
    svg.current!.setPointerCapture(event.pointerId);
    pan.current = { x: event.clientX, y: event.clientY, view: now };
  };
  const move = (event: PointerEvent) => {
    if (!pan.current) return;
    const { x, y, view: old } = pan.current;
    setView({ ...old, x: old.x + event.clientX - x, y: old.y + event.clientY - y });
  };
  const release = () => {
    pan.current = null;
  };
  // The objects in sight; null: all are drawn.
  const inSight = (): Set<string> | null => {
    if (drawn.length <= MANY) return null;
    // The whole view is as large as the window at most.
    const width = svg.current?.clientWidth || innerWidth,
      height = svg.current?.clientHeight || innerHeight;
    return within(drawn, {
      left: -now.x / now.k,
      top: -now.y / now.k,
      right: (width - now.x) / now.k,
      bottom: (height - now.y) / now.k,
    });
  };
  return { svg, now, fit, zoom, placeOf, hold, move, release, inSight };
}
export type Sight = ReturnType<typeof useView>;
