// A number that is typed in the drawing: what is wrong stays with its reason.

import { useState } from "preact/hooks";

interface EntryProps {
  id: string;
  label: string;
  words: string;
  // What is wrong with what was typed; null: nothing.
  take: (typed: string) => string | null;
}

export function Entry({ id, label, words, take }: EntryProps) {
  const [typing, setTyping] = useState<string | null>(null),
    [why, setWhy] = useState("");
  const forget = () => {
    setTyping(null);
    setWhy("");
  };
  const enter = (typed: string) => {
    const wrong = typed === words ? null : take(typed);
    setWhy(wrong ?? "");
    setTyping(wrong === null ? null : typed);
  };
  return (
    <span class="measure-entry">
      <input
        type="text"
        id={id}
        size={9}
        spellcheck={false}
        aria-label={label}
        aria-invalid={why !== ""}
        aria-describedby={why ? `${id} wrong` : undefined}
        value={typing ?? words}
        onFocus={(event) => event.currentTarget.select()}
        onInput={(event) => setTyping(event.currentTarget.value)}
        onBlur={(event) => enter(event.currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key === "Enter") enter(event.currentTarget.value);
          if (event.key !== "Escape" || typing === null) return;
          event.stopPropagation();
          forget();
        }}
      />
      {why && (
        <span class="number-note" role="alert" id={`${id} wrong`}>
          {why}
        </span>
      )}
    </span>
  );
}
