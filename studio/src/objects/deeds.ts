// What is done with the objects that are selected, and with a connection that is chosen.

import { useEffect, useReducer, useRef, useState } from "preact/hooks";
import { clip, copied, pasted } from "../copy";
import { freeName, ownerOf, type Outline } from "../graph";
import { isInField } from "../keys";
import type { Part, Parts } from "../kinds";
import { put } from "../starter";
import { Steps, type Change, type Edits } from "../tree";
import { connection, released, removed } from "./edits";

export interface Graph {
  objects: Outline[];
  parts: Parts;
  selected: string[];
  select: (ids: string[]) => void;
  edit: (make: (edits: Edits) => Change[]) => boolean;
}

export function useDeeds({ objects, parts, selected, select, edit }: Graph) {
  // A connection that is chosen; what is connected by the keyboard; why it could not be.
  const [edge, setEdge] = useState<string | null>(null),
    [joining, setJoining] = useState<string | null>(null),
    [refused, setRefused] = useState(""),
    [isAdding, setAdding] = useState(false),
    [, redraw] = useReducer((count: number) => count + 1, 0);
  // Does steps, and selects what they made.
  const made = (make: (steps: Steps) => string[]): boolean => {
    let ids: string[] = [];
    const isDone = edit((edits) => {
      const steps = new Steps(edits);
      ids = make(steps);
      return steps.changes;
    });
    if (isDone) select(ids);
    return isDone;
  };
  const add = (part: Part) => {
    const driver = (selected.length === 1 && objects.find((one) => one.id === selected[0])) || objects.at(-1);
    made((steps) => [put(steps, part, parts, driver ?? null)]);
    setAdding(false);
  };
  const remove = () => {
    if (edge) {
      const address = edge;
      setEdge(null);
      edit((edits) => released(edits, address));
    } else if (selected.length && edit((edits) => removed(edits, selected, objects))) select([]);
  };
  const duplicate = () =>
    made((steps) => {
      const taken = objects.map((one) => one.id),
        copies: string[] = [];
      for (const id of selected) {
        const copy = freeName(id, [...taken, ...copies]);
        copies.push(copy);
        steps.do((now) => now.duplicate(["objects", id], copy));
      }
      return copies;
    });
  const copy = (): string | null => {
    let text: string | null = null;
    edit((edits) => {
      text = copied(edits, selected);
      return [];
    });
    if (text !== null) {
      clip.text = text;
      redraw(0);
    }
    return text;
  };
  const paste = (text: string): boolean => made((steps) => pasted(steps, text));
  const connect = (output: string, object: Outline, address: string | null) => {
    let why = ownerOf(output) === object.id ? `${object.id} cannot drive itself.` : "";
    if (!why)
      edit((edits) => {
        const found = connection(edits, object, address, output);
        if (typeof found !== "string") return found;
        why = found;
        return [];
      });
    setRefused(why);
    setJoining(null);
  };
  const release = (address: string) => edit((edits) => released(edits, address));
  useClipboard({ copy, paste, remove });
  return {
    ...{ edge, setEdge, joining, setJoining, refused, setRefused, isAdding, setAdding },
    ...{ add, remove, duplicate, copy, paste, connect, release },
  };
}
export type Deeds = ReturnType<typeof useDeeds>;

// By the keyboard, from and to the clipboard that all windows and programs have.
function useClipboard(deeds: { copy: () => string | null; paste: (text: string) => boolean; remove: () => void }) {
  const newest = useRef(deeds);
  newest.current = deeds;
  useEffect(() => {
    const act = (event: ClipboardEvent) => {
      const at = document.activeElement;
      if ((at && at !== document.body && !at.closest(".objects")) || isInField(at)) return;
      const taken =
        event.type === "paste"
          ? newest.current.paste(event.clipboardData?.getData("text/plain") ?? "")
          : newest.current.copy();
      if (!taken) return;
      event.preventDefault();
      if (typeof taken === "string") event.clipboardData?.setData("text/plain", taken);
      if (event.type === "cut") newest.current.remove();
    };
    for (const type of ["copy", "cut", "paste"] as const) document.addEventListener(type, act);
    return () => {
      for (const type of ["copy", "cut", "paste"] as const) document.removeEventListener(type, act);
    };
  }, []);
}
