// What is chosen beside the drawing: the linkage, what drives it, whose lengths are shown; and what it is made of.

import type { Sketch } from "../linkage";
import { GROUND, type Owner } from "./owner";

const option = (name: string) => (
  <option key={name} value={name}>
    {name}
  </option>
);

export const LinkageChoice = ({ all, id, choose }: { all: Sketch[]; id: string; choose: (id: string) => void }) => (
  <label>
    linkage{" "}
    <select value={id} onChange={(event) => choose(event.currentTarget.value)}>
      {all.map((one) => option(one.id))}
    </select>
  </label>
);

export function DrivenChoice({ pairs, drive }: { pairs: Sketch["pairs"]; drive: (pair: string) => void }) {
  const driven = pairs.find((pair) => pair.driven);
  return (
    <label>
      driven{" "}
      <select
        aria-label="driven pair"
        value={driven?.name ?? ""}
        onChange={({ currentTarget: { value } }) => {
          if (value) drive(value);
        }}
      >
        {!driven && <option value="">none yet</option>}
        {pairs.map((pair) => option(pair.name))}
      </select>
    </label>
  );
}

export const LengthsChoice = ({ links, owner }: { links: Sketch["links"]; owner: Owner }) => (
  <label>
    lengths of{" "}
    <select
      aria-label="lengths of"
      value={owner.measures ? (owner.name ?? "") : ""}
      onChange={({ currentTarget: { value } }) => owner.choose(value || null)}
    >
      <option value="">no link</option>
      {[GROUND, ...links.map(({ name }) => name)].map(option)}
    </select>
  </label>
);

// Why something could not be done; else that the text has faults.
export function Note({ told, stale, draft }: { told: string; stale: boolean; draft: boolean }) {
  const words = draft
    ? "Not whole yet: drawn as its text has it."
    : "Stale: the scene has faults; this is the last good drawing.";
  if (!told && !stale) return null;
  return (
    <p class="drawing-note" role="status">
      {told || words}
    </p>
  );
}

export const Structure = ({ sketch }: { sketch: Sketch }) => (
  <ul class="structure" aria-label="structure">
    {[
      ...sketch.told,
      ...sketch.courses.flatMap(({ name, range }) => (range ? [`input ${name && `${name} `}${range}`] : [])),
    ].map((line) => (
      <li>{line}</li>
    ))}
  </ul>
);
