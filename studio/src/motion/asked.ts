// The motion of an object as the program has it, asked anew whenever the text is another.

import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Link } from "../link";
import type { Motion } from "./motion";

interface Found {
  version: number;
  faulty: boolean;
  motion: Motion | null;
}

// Time until an edit that is on its way has come to the program (ms).
const SOON = 12;

export function useMotion({
  link,
  scene,
  id,
  text,
  isAt,
}: {
  link: Link;
  scene: string;
  id: string;
  text: string;
  isAt: (version: number) => boolean;
}) {
  const [found, setFound] = useState<Found | null>(null),
    [good, setGood] = useState<Motion | null>(null);
  const asking = useRef(false),
    gone = useRef(false),
    [busy, setBusy] = useState(false);
  const set = (on: boolean) => {
    asking.current = on;
    if (!gone.current) setBusy(on);
  };
  const ask = async () => {
    if (asking.current) return;
    set(true);
    try {
      for (let first = true; !gone.current; first = false) {
        if (!first) await new Promise((done) => setTimeout(done, SOON));
        const now: Found = await link.get(`/api/motion?${new URLSearchParams({ scene, object: id })}`);
        if (gone.current) return;
        if (!isAt(now.version)) continue;
        set(false);
        setFound(now);
        if (!now.faulty) setGood(now.motion);
        return;
      }
    } catch {
      /* The top bar says that the server is gone. */
    }
    set(false);
  };
  useLayoutEffect(() => {
    gone.current = false;
    void ask();
  }, [text, scene, id]);
  useEffect(
    () => () => {
      gone.current = true;
    },
    [],
  );
  // The last good one stays while the text has faults.
  return {
    motion: good,
    faulty: found?.faulty ?? false,
    busy,
    isFree: () => !asking.current && found !== null && isAt(found.version) && !found.faulty,
    round: found,
  };
}
