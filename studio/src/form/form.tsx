// The form of an object, or of the scene: every property that the schema knows, with its unit and
// its help. What is filled in is an edit of the text.

import { useLayoutEffect, useState } from "preact/hooks";
import { groupOf } from "../shape";
import { find, member, type Step } from "../tree";
import type { Desk } from "./desk";
import { Properties } from "./field";
import { Faults } from "./row";

// The form of an object.
export function ObjectForm({
  desk,
  id,
  kind,
  rename,
}: {
  desk: Desk;
  id: string;
  kind: string;
  rename: (other: string) => void;
}) {
  const path = ["objects", id],
    value = find(desk.root, path),
    schema = desk.guide.root.$defs?.[kind];
  const [typed, setTyped] = useState(id);
  useLayoutEffect(() => setTyped(id), [id]);
  const write = (at: Step[], json: string) => {
    desk.edit((edits) => edits.set(at, json));
  };
  const kinds: string[] = Object.keys(desk.guide.root.$defs ?? {}).filter(
    (name) => desk.guide.root.$defs?.[name]?.properties?.kind?.enum?.[0] === name,
  );
  if (!value) return null;
  const own = member(value, "kind");
  const group = schema ? groupOf(desk.guide, schema) : null;
  return (
    <form class="form" aria-label={`properties of ${id}`} onSubmit={(event) => event.preventDefault()}>
      <div class="field">
        <label for="object-name">name</label>
        <div class="entry">
          <input
            type="text"
            id="object-name"
            value={typed}
            spellcheck={false}
            onInput={(event) => setTyped(event.currentTarget.value)}
            onBlur={() => {
              if (typed !== id) rename(typed.trim());
            }}
            onKeyDown={(event) => {
              if (event.key === "Enter") event.currentTarget.blur();
            }}
          />
        </div>
      </div>
      <div class="field">
        <label for="object-kind">kind</label>
        <div class="entry">
          <select
            id="object-kind"
            value={kind}
            disabled={!own}
            onChange={(event) => write([...path, "kind"], JSON.stringify(event.currentTarget.value))}
          >
            {!kinds.includes(kind) && <option value={kind}>{own?.value.text || "choose…"}</option>}
            {kinds.map((one) => (
              <option value={one}>{one.replace("_", " ")}</option>
            ))}
          </select>
        </div>
        <p class="help always">
          {schema?.description ?? ""}
          {member(value, "from")
            ? ` Copied from ${member(value, "from")!.value.text}; what is given here replaces what stands there.`
            : ""}
        </p>
        <Faults desk={desk} path={[...path, "kind"]} />
      </div>
      <Faults desk={desk} path={path} />
      {group && (
        <Properties
          key={`${id} ${kind}`}
          desk={desk}
          path={path}
          write={write}
          group={member(value, "from") ? { ...group, required: [] } : group}
        />
      )}
    </form>
  );
}

// The form of what is no object: name, run, steady motion.
export function SceneForm({ desk }: { desk: Desk }) {
  const group = groupOf(desk.guide, desk.guide.root);
  const write = (at: Step[], json: string) => {
    desk.edit((edits) => edits.set(at, json));
  };
  return (
    <form class="form" aria-label="properties of the scene" onSubmit={(event) => event.preventDefault()}>
      <Properties desk={desk} path={[]} write={write} group={group} aside={["objects"]} />
    </form>
  );
}
