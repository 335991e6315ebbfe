// What is done to the text of a linkage, one act after the other: each is made on the drawing as it is
// once everything before has come to it.

import { useEffect, useRef, useState } from "preact/hooks";
import type { Board } from "../build";
import { dragged } from "../drag";
import { stepOf, type Point } from "../linkage";
import { Steps, type Change, type Edits } from "../tree";
import type { Sketches } from "./sketches";

export type Edit = (make: (edits: Edits) => Change[], drag?: number) => boolean;
// Text: what cannot be done.
export type Act = (steps: Steps, board: Board) => string | null;
// A joint that is held, and the step of undo that its moves belong to.
export interface Grip {
  joint: string;
  drag: number;
}
export interface Move extends Grip {
  to: Point;
}

export interface Acts {
  busy: boolean;
  // Why the last one could not be done.
  told: string;
  forget: () => void;
  // Moves a joint: of moves that wait the last.
  move: (next: Move) => void;
  act: (make: Act) => void;
  // The text was changed: what comes waits until that is drawn.
  changed: () => void;
}

export function useActs(
  { drawn, shown, isNewest }: Sketches,
  board: Board | null,
  scale: number,
  { edit, isAt }: { edit: Edit; isAt: (version: number) => boolean },
): Acts {
  const [busy, setBusy] = useState(false),
    [told, setTold] = useState("");
  const now = useRef(board),
    waiting = useRef<Move | null>(null),
    acts = useRef<(() => void)[]>([]),
    // The version that the last change was made on: until another is drawn, further ones wait.
    behind = useRef<number | null>(null);
  now.current = board;

  const isFree = () => isNewest() && behind.current === null && isAt(shown.current);
  const changed = () => {
    behind.current = shown.current;
    setBusy(true);
  };
  const changing = (make: (edits: Edits) => Change[] | string, step?: number) => {
    const isChanged = edit((edits) => {
      const done = make(edits);
      setTold(typeof done === "string" ? done : "");
      return typeof done === "string" ? [] : done;
    }, step);
    if (isChanged) changed();
  };
  const pull = ({ to, joint: name, drag }: Move) => {
    const own = now.current,
      joint = own?.joints.find((one) => one.names.includes(name));
    if (own && joint)
      changing((edits) => dragged(edits, own.sketch, own.pose, own.joints, joint, to, stepOf(1.5 / scale)), drag);
  };
  const move = (next: Move) => {
    if (isFree()) pull(next);
    else {
      waiting.current = next;
      setBusy(true);
    }
  };
  const act = (make: Act) => {
    const run = () => {
      const own = now.current;
      if (own)
        changing((edits) => {
          const steps = new Steps(edits);
          return make(steps, own) ?? steps.changes;
        });
    };
    if (isFree()) run();
    else {
      acts.current.push(run);
      setBusy(true);
    }
  };
  // The next one is made on what the last one came to.
  useEffect(() => {
    if (behind.current !== drawn) behind.current = null;
    while (acts.current.length && isFree()) acts.current.shift()!();
    const next = waiting.current;
    if (next && isFree()) {
      waiting.current = null;
      pull(next);
    }
    setBusy(behind.current !== null || waiting.current !== null || acts.current.length > 0);
  }, [drawn]);
  return { busy, told, forget: () => setTold(""), move, act, changed };
}
