// The list beside the button Undo: each step by its name, to go back and forward to.

import { useEffect, useRef, useState } from "preact/hooks";
import { Popup } from "./popup";
import { status } from "./store/file";
import { goTo, steps, type Listed, type Step } from "./store/history";
import { revision } from "./store/text";

// How long the text rests before its steps are listed (ms).
const REST = 60;

// The steps of the text as it is now; null: they are not known yet.
function useSteps(): Listed | null {
  const [listed, setListed] = useState<Listed | null>(null),
    now = revision.value;
  useEffect(() => {
    let timer = 0,
      gone = false;
    const list = async () => {
      const found = await steps();
      if (gone) return;
      if (found) setListed(found);
      else timer = setTimeout(list, 4 * REST);
    };
    timer = setTimeout(list, REST);
    return () => {
      gone = true;
      clearTimeout(timer);
    };
  }, [now]);
  return listed;
}

const MOVES: Record<string, (at: number, last: number) => number> = {
  ArrowUp: (at) => at - 1,
  ArrowDown: (at) => at + 1,
  Home: () => 0,
  End: (_, last) => last,
};

// Arrow keys go from step to step.
function moved(event: KeyboardEvent): void {
  const all = [...(event.currentTarget as Element).querySelectorAll("button")],
    at = all.indexOf(event.target as HTMLButtonElement),
    next = MOVES[event.key]?.(at, all.length - 1);
  if (next === undefined) return;
  event.preventDefault();
  all[Math.max(0, Math.min(all.length - 1, next))]?.focus();
}

function Steps() {
  const listed = useSteps(),
    list = useRef<HTMLOListElement>(null),
    isListed = listed !== null;
  // The keys begin where the text is.
  useEffect(() => {
    list.current?.querySelector<HTMLElement>("[aria-current]")?.focus();
  }, [isListed]);
  if (!listed) return <p class="soft">The steps are listed…</p>;
  const start: Step[] = listed.more ? [] : [{ count: 0, words: "As opened" }];
  return (
    <>
      <ol class="history-steps" ref={list} onKeyDown={moved}>
        {[...listed.steps, ...start].map(({ count, words }) => (
          <li key={count}>
            <button
              type="button"
              class={count > listed.count ? "undone" : undefined}
              aria-current={count === listed.count ? "step" : undefined}
              onClick={() => goTo(count, listed)}
            >
              {words}
            </button>
          </li>
        ))}
      </ol>
      {listed.more && <p class="soft">Undo goes further back than this list.</p>}
    </>
  );
}

export function History() {
  const { undo, redo } = status.value;
  return (
    <span class="history">
      <Popup
        name="History"
        label="steps, the newest first"
        title="all steps by their names: go back or forward to one"
        disabled={!undo && !redo}
      >
        {() => <Steps />}
      </Popup>
    </span>
  );
}
