// The scene in its views: objects, drawing, text, dynamic model, equations; its faults below.

import { Drawing } from "./drawing/drawing";
import { Host } from "./host";
import { Models } from "./models";
import { Objects } from "./objects/objects";
import { scene } from "./store/file";
import { type Found, faults, newest, objects, parts } from "./store/findings";
import { link } from "./store/line";
import { placed } from "./store/places";
import { drag, edit, isAt, revision, tree } from "./store/text";
import { lookAt, lookAtFault, lookAtObject, select, selection, view, type View, VIEWS } from "./store/views";
import { Tabs } from "./tabs";

// Faults that are listed.
const MOST = 100;

// Drawn anew where something of it is another: not while numbers move.
const Graph = () => (
  <Objects
    objects={objects.value}
    faults={faults.value}
    parts={parts.value}
    selected={selection.value}
    select={select}
    edit={edit}
  />
);

function Mechanism() {
  void revision.value;
  return (
    <Drawing
      key={`drawing ${scene.value}`}
      link={link}
      scene={scene.value}
      version={newest.value}
      parts={parts.value}
      root={() => tree().root}
      isAt={isAt}
      edit={edit}
      drag={drag}
    />
  );
}

const Written = ({ kind }: { kind: "model" | "equations" }) => (
  <Models link={link} scene={scene.value} version={newest.value} kind={kind} choose={lookAtObject} />
);

const FaultButton = ({ fault }: { fault: Found }) => (
  <button type="button" class={fault.severity} onClick={() => lookAtFault(fault)}>
    <b>{fault.severity}</b> {fault.path && <code>{fault.path}</code>} {fault.message}
    {fault.hints.length ? ` (${fault.hints.join("; ")})` : ""}
  </button>
);

const Faults = () => (
  <div class="faults" aria-label="faults" role="region">
    {faults.value.slice(0, MOST).map((fault, k) => (
      <FaultButton key={k} fault={fault} />
    ))}
    {faults.value.length > MOST && <p class="soft">{faults.value.length - MOST} more.</p>}
  </div>
);

export function SceneViews() {
  const own = view.value;
  return (
    <div class={`pane-left shows-${own}${own === "drawing" ? " draws" : ""}`}>
      <Tabs
        label="views of the scene"
        chosen={own}
        choose={(name) => lookAt(name as View)}
        tabs={VIEWS.map(([name, words]) => ({ name, words }))}
      />
      {own === "objects" && <Graph />}
      {own === "drawing" && <Mechanism />}
      {(own === "model" || own === "equations") && <Written key={own} kind={own} />}
      <Host key="text" class="text-pane" of={placed("text")} />
      <Faults key="faults" />
    </div>
  );
}
