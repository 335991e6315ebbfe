// The link whose lengths are shown, and the one that is typed.

import { useRef, useState } from "preact/hooks";
import type { Board } from "../build";
import { measuresOf, resized, type Measure } from "./lengths";
import type { Acts } from "./acts";

// No link has such a name.
export const GROUND = "the ground";
export type Asked = { length?: number; angle?: number };

export interface Owner {
  name: string | null;
  // None: nothing is chosen.
  measures: Measure[] | null;
  // Which of them is typed, and what was typed before its field is there.
  typed: string | null;
  ahead: { current: string };
  choose: (name: string | null) => void;
  type: (point: string | null) => void;
  resize: (point: string, asked: Asked) => void;
  // Keys at a link: Enter chooses it, a digit begins its first length.
  keys: (name: string, event: KeyboardEvent) => void;
}

function measuresIn({ sketch, joints }: Board, name: string | null): Measure[] | null {
  const index = sketch.links.findIndex((link) => link.name === name);
  return name === GROUND ? measuresOf(sketch, null, joints) : index < 0 ? null : measuresOf(sketch, index, joints);
}

export function useOwner(board: Board | null, act: Acts["act"]): Owner {
  const [name, choose] = useState<string | null>(null),
    [typed, type] = useState<string | null>(null),
    ahead = useRef("");
  const resize = (point: string, asked: Asked) =>
    act((steps, now) => {
      const measure = measuresIn(now, name)?.find((one) => one.point === point);
      if (!measure) return "This length is not in the drawing any more.";
      const made = resized(steps.edits, now.sketch, measure, asked);
      if (typeof made === "string") return made;
      steps.do(() => made);
      return null;
    });
  const keys = (link: string, event: KeyboardEvent) => {
    const isTyped = (ahead.current ? /^.$/ : /^[\d.]$/).test(event.key) && !event.ctrlKey && !event.metaKey;
    if (!isTyped && event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    event.stopPropagation();
    choose(link);
    const [first] = (board && measuresIn(board, link)) ?? [];
    if (!isTyped || !first) return;
    ahead.current += event.key;
    type(first.point);
  };
  return { name, measures: board && measuresIn(board, name), typed, ahead, choose, type, resize, keys };
}
