// A button that opens a list below it. A press elsewhere or Escape closes it.

import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";

interface Props {
  name: string;
  // Of the list, in words.
  label: string;
  title?: string;
  disabled?: boolean;
  children: () => ComponentChildren;
}

export function Popup({ name, label, title, disabled, children }: Props) {
  const [open, setOpen] = useState(false),
    place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!open) return;
    const away = (event: Event) => {
      if (!place.current?.contains(event.target as Node)) setOpen(false);
    };
    addEventListener("pointerdown", away);
    return () => removeEventListener("pointerdown", away);
  }, [open]);
  const keys = (event: KeyboardEvent) => {
    if (event.key !== "Escape" || !open) return;
    event.preventDefault();
    setOpen(false);
    place.current?.querySelector("button")?.focus();
  };
  return (
    <div class="popup" ref={place} onKeyDown={keys}>
      <button type="button" aria-expanded={open} title={title} disabled={disabled} onClick={() => setOpen(!open)}>
        {name}
      </button>
      {open && (
        <div class="popup-list" role="group" aria-label={label}>
          {children()}
        </div>
      )}
    </div>
  );
}
