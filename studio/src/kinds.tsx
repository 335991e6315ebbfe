// The kinds of objects: small pictures, and the list that objects are added from.

import type { Begins } from "./starter";
import { useLayoutEffect, useRef, useState } from "preact/hooks";

export interface Part {
  from?: string;
  kind: string;
  meaning: string;
  begins: Begins;
}
export interface Parts {
  kinds: Part[];
  objects: Part[];
}

// Lines on 24 by 24.
const PICTURES: Record<string, string> = {
  drive: "M12 4a8 8 0 1 1-7.4 5M12 4l4-2M12 4l3 3.4M12 12h.01",
  shaft: "M2 12h20M6 6v12M18 6v12M6 6h3v12H6M18 6h-3v12h3",
  crank: "M6 18a3 3 0 1 1 .01 0M8 13l9-7M19 5a2 2 0 1 1-.01 0M3 21h7",
  rocker: "M12 14a2 2 0 1 1 .01 0M10.5 15.5L3 20M13.5 11L21 5M12 16l-4 6h8z",
  slider: "M3 18h18M5 21h.01M9 21h.01M13 21h.01M17 21h.01M6 9h12v8H6zM12 9V3",
  cam_follower: "M12 21a6 6 0 1 1 4-10.5c3 2.500 2 9-4 10.500zM12 15h.01M14 8.500a2.300 2.300 0 1 1 .01 0M14 4V1",
  differential: "M8 12a5 5 0 1 1 .01 0M8 22a5 5 0 1 1 .01 0M13 7h5v10h-5M18 12h4",
  linkage: "M4 20l3-9 9-6 4 15M4 20h.01M2 22h5M18 22h5M7 11h.01M16 5h.01",
};

export function Picture({ kind, size = 22, x, y }: { kind: string; size?: number; x?: number; y?: number }) {
  return (
    <svg
      class="kind-picture"
      viewBox="0 0 24 24"
      width={size}
      height={size}
      {...(x === undefined ? {} : { x, y })}
      aria-hidden="true"
    >
      <path d={PICTURES[kind] ?? "M6 6h12v12H6z"} />
    </svg>
  );
}

// Everything that can be added, by the words of its name and meaning.
export function Palette({
  parts,
  add,
  close,
}: {
  parts: Parts;
  add: (part: Part) => void;
  close: (() => void) | null;
}) {
  const [words, setWords] = useState("");
  const search = useRef<HTMLInputElement>(null);
  useLayoutEffect(() => {
    if (close) search.current!.focus();
  }, []);
  const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
  const fits = (part: Part) => {
    const own = `${part.from ?? ""} ${part.kind.replace("_", " ")} ${part.meaning}`.toLowerCase();
    return wanted.every((word) => own.includes(word));
  };
  const kinds = parts.kinds.filter(fits),
    objects = parts.objects.filter(fits);
  const first = kinds[0] ?? objects[0];
  const row = (part: Part) => (
    <button type="button" class="part" key={part.from ?? part.kind} onClick={() => add(part)} title={part.meaning}>
      <Picture kind={part.kind} />
      <b>{part.from ? part.from.replace(/^[^/]*\//, "").replaceAll("-", " ") : part.kind.replace("_", " ")}</b>
      <span class="soft">{part.meaning}</span>
    </button>
  );
  return (
    <div
      class="palette"
      role="dialog"
      aria-label="add an object"
      onKeyDown={(event) => {
        if (event.key === "Escape" && close) {
          event.preventDefault();
          close();
        }
      }}
    >
      <div class="tools">
        <input
          type="text"
          ref={search}
          placeholder="Search kinds and catalogue"
          aria-label="search kinds and catalogue"
          value={words}
          onInput={(event) => setWords(event.currentTarget.value)}
          onKeyDown={(event) => {
            if (event.key === "Enter" && first) add(first);
          }}
        />
        {close && (
          <button type="button" onClick={close}>
            Close
          </button>
        )}
      </div>
      <div class="parts">
        {kinds.length > 0 && <h2>Kinds</h2>}
        {kinds.map(row)}
        {objects.length > 0 && <h2>Catalogue</h2>}
        {objects.map(row)}
        {!first && <p class="soft">Nothing is called so.</p>}
      </div>
    </div>
  );
}
