// A scene to begin with, as a card: its machine, its title, what it asks. The machine moves while the
// pointer or the focus is on the card.

import { useEffect, useRef, useState } from "preact/hooks";
import type { Link } from "../link";
import { begun, wanted, type From } from "./picture";

interface Props {
  link: Link;
  from: From;
  title: string;
  words: string;
  name: string;
  act: () => void;
}

const isStill = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;

export function Card({ link, from, title, words, name, act }: Props) {
  const place = useRef<HTMLSpanElement>(null),
    own = useRef<HTMLButtonElement>(null),
    [state, setState] = useState<"waits" | "drawn" | "none">("waits");
  const picture = () => place.current?.querySelector("svg") ?? null;
  useEffect(() => {
    let seen = false,
      done = false;
    const show = async (svg: string | null) => {
      if (done || !place.current) return;
      done = true;
      watch.disconnect();
      place.current.innerHTML = svg ?? "";
      if (svg) await begun(picture()!);
      setState(svg ? "drawn" : "none");
      // What was pointed at meanwhile.
      if (own.current?.matches(":hover, :focus-visible")) play();
    };
    const watch = new IntersectionObserver(
      ([entry]) => {
        const before = seen;
        seen = entry!.isIntersecting;
        if (seen && !before) wanted({ from, link, isSeen: () => seen, done: (svg) => void show(svg) });
      },
      { rootMargin: "80px" },
    );
    watch.observe(own.current!);
    return () => {
      seen = false;
      done = true;
      watch.disconnect();
    };
  }, []);
  const play = () => {
    if (!isStill()) picture()?.unpauseAnimations();
  };
  const pause = () => {
    if (!own.current?.matches(":hover, :focus-visible")) picture()?.pauseAnimations();
  };
  return (
    <button
      type="button"
      class="entry card"
      ref={own}
      data-picture={state}
      onClick={act}
      onPointerEnter={play}
      onFocus={play}
      onPointerLeave={pause}
      onBlur={pause}
    >
      <span class="card-picture" ref={place} aria-hidden="true" />
      <b>{title}</b>
      {words && <span class="card-words">{words}</span>}
      <span class="soft">{name}</span>
    </button>
  );
}
