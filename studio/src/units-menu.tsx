// The menu in which units are chosen.

import { Popup } from "./popup";
import { link } from "./store/line";
import { unitsChanged } from "./store/opening";
import { CHOICES, SYSTEMS } from "./unit-choices";
import { chooseSystem, chooseUnit, systemChosen, unitOf } from "./units";

function SystemChoice() {
  const chosen = systemChosen();
  return (
    <label>
      <span>all of them</span>
      <select
        aria-label="system of units"
        value={chosen ?? "own"}
        onChange={(event) => {
          chooseSystem(event.currentTarget.value, link);
          unitsChanged();
        }}
      >
        <option value="">whichever reads best</option>
        {Object.keys(SYSTEMS).map((name) => (
          <option key={name} value={name}>
            {name}
          </option>
        ))}
        {chosen === null && <option value="own">each its own</option>}
      </select>
    </label>
  );
}

const Choices = () => (
  <>
    <p class="soft">Figures, charts and numbers are shown in these; the text stays as it is.</p>
    <SystemChoice />
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
  </>
);

export const UnitsMenu = () => (
  <Popup name="Units" label="units shown">
    {() => <Choices />}
  </Popup>
);
