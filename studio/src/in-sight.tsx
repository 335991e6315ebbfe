// A part of a long list, built where it is in sight. Elsewhere it is as high as it was, or as it is
// taken to be.

import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";

interface Props {
  // What scrolls, as a selector.
  scroller: string;
  height: number;
  children: () => ComponentChildren;
}

export function InSight({ scroller, height, children }: Props) {
  const own = useRef<HTMLDivElement>(null),
    room = useRef(height);
  const [isSeen, see] = useState(false);
  useLayoutEffect(() => {
    const { current } = own,
      watch = new IntersectionObserver(
        (entries) => {
          const { isIntersecting, boundingClientRect } = entries.at(-1)!;
          // What is being typed stays.
          if (!isIntersecting && current!.contains(document.activeElement)) return;
          room.current = boundingClientRect.height || room.current;
          see(isIntersecting);
        },
        { root: current!.closest(scroller), rootMargin: "300px" },
      );
    watch.observe(current!);
    return () => watch.disconnect();
  }, []);
  return (
    <div ref={own} style={isSeen ? undefined : { height: room.current }}>
      {isSeen && children()}
    </div>
  );
}
