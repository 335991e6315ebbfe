// What is shown beside the run: earlier runs that are pinned, and a signal over another.

import type { ComponentChildren } from "preact";
import { useLayoutEffect, useState } from "preact/hooks";
import type { Answer } from "./answer";
import type { Link } from "./link";
import { useTyping } from "./typing";

interface Props {
  link: Link;
  answer: Answer;
  opened: number;
  stale: boolean;
  before: ComponentChildren;
  compare: () => void;
}

export function Beside({ link, answer: { pins, signals }, opened, stale, before, compare }: Props) {
  const [along, setAlong] = useState("t"),
    [up, setUp] = useState("");
  const names = signals.map(([name]) => name);
  useLayoutEffect(() => {
    setAlong("t");
    setUp("");
  }, [opened]);
  const over = (x: string, y: string) => {
    setAlong(x);
    setUp(y);
    link.send({ type: "over", signals: y ? [x, y] : null });
  };
  const choice = (label: string, value: string, all: string[], set: (value: string) => void) => (
    <Choice label={label} value={value} all={all} set={set} />
  );
  return (
    <div class="tools seen-beside" role="group" aria-label="beside the run">
      {before}
      <button
        type="button"
        disabled={stale || pins.length >= 3}
        title="keep this run: later ones are drawn over it, and their figures stand beside its own"
        onClick={() => link.send({ type: "pin", name: "" })}
      >
        Pin this run
      </button>
      {pins.map((name, pin) => (
        <span key={pin} class="pin">
          <Name
            text={name}
            label={`name of pinned run ${pin + 1}`}
            take={(name) => link.send({ type: "rename", pin, name })}
          />
          <button
            type="button"
            class="drop"
            aria-label={`unpin ${name}`}
            title="unpin"
            onClick={() => link.send({ type: "unpin", pin })}
          >
            ×
          </button>
        </span>
      ))}
      {pins.length > 0 && (
        <button type="button" onClick={compare}>
          Figures beside each other
        </button>
      )}
      <span class="space" />
      {choice("Chart of", up, ["", ...names], (y) => over(along, y))}
      {choice("over", along, names, (x) => over(x, up))}
    </div>
  );
}

// Many signals are listed once somebody is about to choose.
const MANY = 300;

export function Choice({
  label,
  value,
  all,
  none = "–",
  set,
}: {
  label: string;
  value: string;
  all: string[];
  none?: string;
  set: (value: string) => void;
}) {
  const [isWanted, want] = useState(false),
    own = all.includes(value) ? value : "",
    open = () => want(true);
  const shown = isWanted || all.length <= MANY ? all : [own];
  return (
    <label onPointerEnter={open}>
      {label}{" "}
      <select value={own} onFocus={open} onChange={(event) => set(event.currentTarget.value)}>
        {shown.map((one) => (
          <option value={one}>{one || none}</option>
        ))}
      </select>
    </label>
  );
}

function Name({ text, label, take }: { text: string; label: string; take: (text: string) => void }) {
  return <input type="text" size={12} aria-label={label} {...useTyping(text, take)} />;
}
