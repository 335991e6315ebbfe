// The menu in which units are chosen.

import { useEffect, useRef, useState } from "preact/hooks";
import { link } from "./store/line";
import { unitsChanged } from "./store/opening";
import { CHOICES, chooseUnit, unitOf } from "./units";

export function UnitsMenu() {
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
  return (
    <div
      class="units"
      ref={place}
      onKeyDown={(event) => {
        if (event.key === "Escape" && open) {
          event.preventDefault();
          setOpen(false);
          place.current?.querySelector("button")?.focus();
        }
      }}
    >
      <button type="button" aria-expanded={open} onClick={() => setOpen(!open)}>
        Units
      </button>
      {open && (
        <div class="units-list" role="group" aria-label="units shown">
          <p class="soft">Figures, charts and numbers are shown in these; the text stays as it is.</p>
          {Object.entries(CHOICES).map(([si, [name, units]]) => (
            <label key={si}>
              <span>{name}</span>
              <select
                aria-label={name}
                value={unitOf(si)}
                onChange={(event) => {
                  chooseUnit(si, event.currentTarget.value, link);
                  unitsChanged();
                }}
              >
                <option value="">whichever reads best</option>
                {units.map(([unit]) => (
                  <option key={unit} value={unit}>
                    {unit}
                  </option>
                ))}
              </select>
            </label>
          ))}
        </div>
      )}
    </div>
  );
}
