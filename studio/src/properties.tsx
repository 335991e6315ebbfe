// The properties of the object that is selected, or of the scene.

import type { Desk } from "./form/desk";
import { ObjectForm, SceneForm } from "./form/form";
import { MotionPanel } from "./motion/panel";
import { scene } from "./store/file";
import { faults, guide, objects } from "./store/findings";
import { link } from "./store/line";
import { drag, edit, editor, isAt, revision, tree } from "./store/text";
import { rename, selection } from "./store/views";
import { find, member } from "./tree";

function OfObject({ id, desk }: { id: string; desk: Desk }) {
  const kind =
    member(find(desk.root, ["objects", id]), "kind")?.value.text ??
    objects.value.find((one) => one.id === id)?.kind ??
    "";
  const coordinates = new Map(
    objects.value.flatMap((one) => one.outputs.map((output) => [output.address, output.coordinate] as const)),
  );
  return (
    <>
      <MotionPanel
        key={`motion ${scene.value} ${id}`}
        {...{ link, scene: scene.value, id, kind, desk, edit, coordinates, isAt, drag }}
      />
      <ObjectForm key={id} desk={desk} id={id} kind={kind} rename={(other) => rename(id, other)} />
    </>
  );
}

export function Properties() {
  void revision.value;
  if (!guide.value || !editor.value) return null;
  const { good, goodText } = tree();
  if (!good) return <p class="soft">The text is no JSON yet: see the text view.</p>;
  const desk: Desk = {
    guide: guide.value,
    root: good,
    text: goodText,
    faults: faults.value,
    outputs: objects.value.flatMap((one) => one.outputs.map((output) => output.address)),
    edit,
  };
  const ids = selection.value.filter((id) => member(find(good, ["objects"]), id));
  if (ids.length > 1)
    return (
      <p class="soft">
        {ids.length} objects are selected: {ids.join(", ")}. Duplicate and Delete take all of them.
      </p>
    );
  return ids[0] === undefined ? <SceneForm desk={desk} /> : <OfObject id={ids[0]} desk={desk} />;
}
