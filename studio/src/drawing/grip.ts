// A joint that is taken by the pointer, or moved by the arrow keys.

import { removed } from "../build";
import type { Frame } from "../figure";
import { stepOf, type Joint, type Point } from "../linkage";
import type { Tool } from "../tools";
import type { Acts, Grip } from "./acts";

export const ARROWS: Record<string, Point> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

interface Given {
  acts: Acts;
  held: { current: Grip | null };
  drag: () => number;
}

export function gripOf(
  svg: { readonly current: SVGSVGElement | null },
  tool: Tool,
  view: Frame,
  { acts, held, drag }: Given,
) {
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
  return { take, jointKeys };
}
