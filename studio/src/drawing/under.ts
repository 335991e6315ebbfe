// The picture or plan below a linkage: taken from a file or from the clipboard, kept, moved and scaled.

import { useEffect, useRef, useState } from "preact/hooks";
import type { Frame } from "../figure";
import { isInField } from "../keys";
import type { Point } from "../linkage";
import { keep, picture, type Kept } from "./pictures";
import { readFrom } from "./under-files";
import { laidIn, type Underlay } from "./underlay";

// What is done with it: by the pointer, or by the arrow keys.
export type Mode = "rest" | "move" | "scale";

export interface Under {
  url: string | null;
  path: string | null;
  own: Underlay | null;
  mode: Mode;
  // The places that a distance is typed for.
  marks: Point[];
  // What is wrong, or what comes next.
  told: string;
  take: (image: Blob, name: string) => Promise<void>;
  set: (next: Underlay) => void;
  remove: () => void;
  begin: (mode: Mode) => void;
  mark: (place: Point) => void;
}

// `key`: which linkage of which scene.
export function useUnder(key: string | null, view: Frame | null): Under {
  const [kept, setKept] = useState<Kept | null>(null),
    [url, setUrl] = useState<string | null>(null),
    [mode, setMode] = useState<Mode>("rest"),
    [marks, setMarks] = useState<Point[]>([]),
    [told, setTold] = useState("");
  const show = (next: Kept | null) => {
    setKept(next);
    if (next?.image !== kept?.image) setUrl(next?.image ? URL.createObjectURL(next.image) : null);
  };
  const begin = (next: Mode) => {
    setMode(next);
    setMarks([]);
    setTold("");
  };
  useEffect(() => {
    let gone = false;
    begin("rest");
    show(null);
    if (key !== null)
      void picture(key).then((found) => {
        if (!gone && found) show(found);
      });
    return () => {
      gone = true;
    };
  }, [key]);
  useEffect(
    () => () => {
      if (url) URL.revokeObjectURL(url);
    },
    [url],
  );

  const change = (next: Kept | null) => {
    show(next);
    if (key !== null)
      void keep(key, next).then((isKept) => {
        if (!isKept) setTold("This browser keeps no pictures: this one goes with the page.");
      });
  };
  const take = async (image: Blob, name: string) => {
    const found = await readFrom(image, name);
    begin("rest");
    if (typeof found === "string") setTold(found);
    else if (view) {
      const { width, height, unit, words, ...shown } = found;
      change({ ...shown, underlay: laidIn(view, width, height, unit) });
      setTold(words);
    }
  };
  // From the clipboard, unless a field takes it.
  const newest = useRef(take);
  newest.current = take;
  useEffect(() => {
    const paste = (event: ClipboardEvent) => {
      const image = [...(event.clipboardData?.files ?? [])].find(({ type }) => type.startsWith("image/"));
      if (!image || isInField(document.activeElement)) return;
      event.preventDefault();
      void newest.current(image, "The pasted picture");
    };
    document.addEventListener("paste", paste);
    return () => document.removeEventListener("paste", paste);
  }, []);
  return {
    ...{ url, mode, marks, told, take, begin },
    path: kept?.path ?? null,
    own: kept?.underlay ?? null,
    set: (underlay) => {
      if (kept) change({ ...kept, underlay });
    },
    remove: () => {
      begin("rest");
      change(null);
    },
    mark: (place) => setMarks((before) => (before.length < 2 ? [...before, place] : [place])),
  };
}
