// The linkages of the scene as they are drawn: asked for anew as the text changes, or as another place
// of several inputs is looked at. Of a text that is not whole its own numbers are drawn.

import { useEffect, useRef, useState } from "preact/hooks";
import { drafted, stances, type Known } from "../draft";
import type { Link } from "../link";
import { basePose, type Sketch } from "../linkage";
import { find, member, type Value } from "../tree";

interface Asked {
  link: Link;
  scene: string;
  version: number;
  root: () => Value | null;
}

export interface Sketches {
  all: Sketch[];
  // The last good drawing, or one of a text that is not whole.
  stale: boolean;
  // How links stood when their linkage was whole, and where they were drawn.
  known: Map<string, Known>;
  // The version that the drawing shows.
  drawn: number;
  shown: { current: number };
  // Where linkages of several inputs are asked for: in the server's words.
  place: { current: string };
  // Whether the place asked for is shown; whether the newest text is, too.
  isSettled: () => boolean;
  isNewest: () => boolean;
}

const addressOf = (scene: string, place: string): string =>
  `/api/linkages?scene=${encodeURIComponent(scene)}${place && `&at=${encodeURIComponent(place)}`}`;

export function useSketches({ link, scene, version, root }: Asked): Sketches {
  const [all, setAll] = useState<Sketch[]>([]),
    [stale, setStale] = useState(false),
    [drawn, setDrawn] = useState(-1),
    [, setRound] = useState(0);
  const known = useRef(new Map<string, Known>()),
    asking = useRef(false),
    wanted = useRef(version),
    shown = useRef(-1),
    place = useRef(""),
    placeShown = useRef("");
  wanted.current = version;

  // Of a text that is not whole what it has; of copies the last good drawing.
  const draftsOf = (before: Sketch[]): Sketch[] => {
    const texts = find(root() ?? undefined, ["objects"])?.members ?? [];
    const made = texts.flatMap(({ name, value }) => {
      if (member(value, "kind")?.value.text !== "linkage") return [];
      const stood = known.current.get(name) ?? new Map(),
        draft = drafted(name, value, stood) ?? before.find((one) => one.id === name);
      if (draft?.draft) known.current.set(name, stances(draft, basePose(draft)!));
      return draft ? [draft] : [];
    });
    return made.length ? made : before;
  };
  const take = (found: { linkages: Sketch[] } | null) => {
    for (const one of found?.linkages ?? []) {
      const pose = basePose(one);
      if (pose) known.current.set(one.id, stances(one, pose));
    }
    setAll(found ? found.linkages : draftsOf);
    setStale(!found);
  };
  const isSettled = () => placeShown.current === place.current,
    isShown = () => shown.current === wanted.current && isSettled();
  useEffect(() => {
    let gone = false;
    const ask = async () => {
      if (!scene || asking.current || isShown()) return;
      asking.current = true;
      const asked = wanted.current,
        there = place.current;
      try {
        const found = await link.get<{ linkages: Sketch[] } | null>(addressOf(scene, there));
        if (gone) return;
        take(found);
      } catch {
        if (!gone) setStale(true);
      }
      shown.current = asked;
      placeShown.current = there;
      asking.current = false;
      if (gone) return;
      setDrawn(asked);
      setRound((round) => round + 1);
      if (!isShown()) void ask();
    };
    void ask();
    return () => {
      gone = true;
      asking.current = false;
    };
  }, [version, scene, place.current]);

  const isNewest = () => !asking.current && isShown();
  return { all, stale, known: known.current, drawn, shown, place, isSettled, isNewest };
}
