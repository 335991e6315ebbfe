// Tabs in a row: one of them is in the order of the Tab key, the arrow keys go to the others.

import type { ComponentChildren } from "preact";

interface Tab {
  name: string;
  words: ComponentChildren;
  // Why what is behind it does not fit; empty: it does.
  why?: string;
}

interface Props {
  label: string;
  tabs: Tab[];
  chosen: string;
  choose: (name: string) => void;
}

// Where a key goes from a place among some; null: nowhere.
function target(key: string, place: number, count: number): number | null {
  switch (key) {
    case "ArrowRight":
      return (place + 1) % count;
    case "ArrowLeft":
      return (place + count - 1) % count;
    case "Home":
      return 0;
    case "End":
      return count - 1;
    default:
      return null;
  }
}

export function Tabs({ label, tabs, chosen, choose }: Props) {
  const keys = (event: KeyboardEvent) => {
    const all = [...(event.currentTarget as HTMLElement).querySelectorAll<HTMLElement>("[role=tab]")],
      place = all.indexOf(document.activeElement as HTMLElement),
      next = place < 0 ? null : target(event.key, place, all.length);
    if (next === null || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    choose(tabs[next]!.name);
    all[next]!.focus();
  };
  // While none of them is chosen the first is reached.
  const reached = tabs.some((one) => one.name === chosen) ? chosen : tabs[0]?.name;
  return (
    <div class="tabs" role="tablist" aria-label={label} onKeyDown={keys}>
      {tabs.map(({ name, words, why = "" }) => (
        <button
          type="button"
          role="tab"
          key={name}
          class={why ? "unfit" : ""}
          aria-selected={chosen === name}
          tabIndex={name === reached ? 0 : -1}
          title={why}
          onClick={() => choose(name)}
        >
          {words}
        </button>
      ))}
    </div>
  );
}
