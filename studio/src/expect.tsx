// What the scene expects of its run, met or not, and expectations made from the run.

import { useState } from "preact/hooks";
import type { Link } from "./link";
import { expectations } from "./store/run";
import { find, member, Steps, written, type Change, type Edits, type Value } from "./tree";
import { choice } from "./units";

export interface Verdict {
  what: string;
  expected: number;
  within: number;
  found: number | null;
  holds: boolean;
  unknown: boolean;
  message: string;
  source: string | null;
  unit: string;
}
interface Offer {
  figure: string;
  value: number;
  unit: string;
  within: number | null;
  why: string;
}

interface Props {
  link: Link;
  scene: string;
  isAt: (version: number) => boolean;
  edit: (make: (edits: Edits) => Change[]) => boolean;
  program: string;
}

const shown = (value: number, unit: string, digits = 7) => numbers.withUnit(value, unit, digits);

// A number with the digits that a bound leaves a meaning.
export function rounded(value: number, within: number): number {
  if (!(within > 0) || value === 0) return value;
  const digits = Math.ceil(Math.log10(Math.abs(value) / within)) + 2;
  return digits < 1 ? 0 : Number(value.toPrecision(Math.min(17, digits)));
}

// Writes what is expected of a figure over the whole motion: into the entry that speaks of it, else into a new one.
export function expected(edits: Edits, offer: Offer, source: string): Change[] {
  const within = offer.within ?? 0,
    value = rounded(offer.value, within);
  const entries = find(edits.root, ["expect"])?.items ?? [];
  const own = entries.findIndex(
    (one: Value) => member(one, "figure")?.value.text === offer.figure && !member(one, "over"),
  );
  const steps = new Steps(edits);
  if (own < 0) steps.set(["expect", entries.length], written({ figure: offer.figure, value, within, source }));
  else
    for (const [name, json] of Object.entries({ value, within, source }))
      steps.set(["expect", own, name], written(json));
  return steps.changes;
}

export function Expectations({ link, scene, isAt, edit, program }: Props) {
  const [offers, setOffers] = useState<{ version: number; figures: Offer[] } | null>(null);
  const [asking, setAsking] = useState(false),
    [words, setWords] = useState(""),
    [figure, setFigure] = useState("");
  const ask = async () => {
    setAsking(true);
    setWords("");
    try {
      const found = await link.get<{ version: number; figures: Offer[]; refused?: string } | null>(
        `/api/figures?scene=${encodeURIComponent(scene)}`,
      );
      if (!found) setWords("The text is no scene that can be run.");
      else if (!found.figures.length) setWords(found.refused ?? "This run has no figures that can be expected.");
      setOffers(found?.figures.length ? found : null);
    } catch {
      setWords("The figures could not be had: the run may take too long.");
    }
    setAsking(false);
  };
  // Verdicts are shown in the units that were chosen.
  void choice.value;
  const { verdicts, others } = expectations.value,
    failed = verdicts.filter((one) => !one.holds).map((one) => one.what),
    met = verdicts.length - failed.length;
  const chosen = offers?.figures.find((one) => one.figure === figure) ?? offers?.figures[0];
  const write = () => {
    if (!offers || !chosen) return;
    if (!isAt(offers.version)) {
      setWords("The scene has been changed since: here are the figures of its run now. Write it once more.");
      void ask();
      return;
    }
    if (edit((edits) => expected(edits, chosen, `a run of dam ${program}`))) {
      setOffers(null);
      setWords(`${chosen.figure} is expected now; Undo takes it back.`);
    }
  };
  return (
    <section class="expectations" aria-label="expectations" aria-busy={asking}>
      {/* One line, so that nothing changes its place while a number moves. */}
      {verdicts.length > 0 && (
        <details>
          <summary class={failed.length ? "failed" : "met"}>
            <b>
              {failed.length ? "✗" : "✓"} Expectations: {met} of {verdicts.length} met
            </b>
            {failed.length > 0 && <span class="soft"> not {failed.join(", ")}</span>}
          </summary>
          <div class="expect-scroll" tabindex={0} role="region" aria-label="expected results">
            <table>
              <thead>
                <tr>
                  <th>figure</th>
                  <th />
                  <th class="number">found</th>
                  <th class="number">expected</th>
                  <th class="number">within</th>
                  <th class="left">source</th>
                </tr>
              </thead>
              <tbody>
                {verdicts.map((one, k) => (
                  <tr key={k} class={one.holds ? "met" : "failed"} title={one.message}>
                    <td>
                      <code>{one.what}</code>
                    </td>
                    <td>{one.holds ? "✓ met" : "✗ not met"}</td>
                    <td class="number">{one.found === null ? "none" : shown(one.found, one.unit)}</td>
                    <td class="number">{shown(one.expected, one.unit)}</td>
                    <td class="number">{shown(one.within, one.unit, 3)}</td>
                    <td class="left soft">{one.source}</td>
                  </tr>
                ))}
              </tbody>
            </table>
          </div>
        </details>
      )}
      {others > 0 && (
        <p class="soft">
          {others === 1 ? "One expectation is" : `${others} expectations are`} not of this run but of the steady motion,
          of kinematics or of forces. They are checked there.
        </p>
      )}
      <div class="tools">
        {!offers && (
          <button type="button" onClick={() => void ask()} disabled={asking}>
            {asking ? "The errors of the figures are looked for …" : "Expect a figure of this run…"}
          </button>
        )}
        {offers && chosen && (
          <>
            <label>
              figure{" "}
              <select value={chosen.figure} onChange={(event) => setFigure(event.currentTarget.value)}>
                {offers.figures.map((one) => (
                  <option key={one.figure} value={one.figure}>
                    {one.figure}
                  </option>
                ))}
              </select>
            </label>
            <span class="offer">
              {shown(chosen.value, chosen.unit)}
              {chosen.within === null ? (
                `: not determined, ${chosen.why}`
              ) : (
                <>
                  {" "}
                  ± {shown(chosen.within, chosen.unit, 3)} <span class="soft">({chosen.why})</span>
                </>
              )}
            </span>
            <button type="button" onClick={write} disabled={asking || chosen.within === null}>
              Write it into the scene
            </button>
            <button type="button" onClick={() => setOffers(null)}>
              Not now
            </button>
          </>
        )}
        {words && <span role="status">{words}</span>}
      </div>
    </section>
  );
}
