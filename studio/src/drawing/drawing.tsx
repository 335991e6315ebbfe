// A linkage drawn to scale, whose joints are dragged, and whose links and points are drawn:
// mobility, groups, branches, range and faults are told while it changes.

import { useRef, useState } from "preact/hooks";
import { begun, driven, type Board } from "../build";
import { framed, START, type Frame } from "../figure";
import { InputRows } from "../inputs";
import type { Parts } from "../kinds";
import type { Link } from "../link";
import { gridOf, joints, type Sketch } from "../linkage";
import { folder } from "../store/file";
import { TOOLS, Tools, type Tool } from "../tools";
import { find, Steps, type Value } from "../tree";
import { useActs, type Edit, type Grip } from "./acts";
import { DrivenChoice, LengthsChoice, LinkageChoice, Note, Structure } from "./choices";
import { useOwner } from "./owner";
import { usePlace } from "./place";
import { PictureTools } from "./picture";
import { Sheet } from "./sheet";
import { useSketches } from "./sketches";
import { useUnder } from "./under";

interface Props {
  link: Link;
  scene: string;
  version: number;
  parts: Parts;
  root: () => Value | null;
  isAt: (version: number) => boolean;
  edit: Edit;
  drag: () => number;
}

// How wide the grid is at least (pixels).
const MESH = 8;

// The picture's place and scale: while a joint is held it stays.
function useView(sketch: Sketch | undefined, held: { current: Grip | null }) {
  const [fixed, setView] = useState<Frame | null>(null),
    frame = useRef<Frame | null>(null);
  if (sketch && (!frame.current || !held.current)) frame.current = fixed ?? framed(sketch);
  return { view: frame.current, isMoved: fixed !== null, setView };
}

export function Drawing({ parts, root, edit, drag, isAt, ...asked }: Props) {
  const [name, setName] = useState(""),
    [chosen, setChosen] = useState<{ tool: Tool }>({ tool: "select" }),
    held = useRef<Grip | null>(null),
    sketches = useSketches({ ...asked, root });
  const { all, stale, known, isSettled } = sketches,
    { tool } = chosen,
    sketch = all.find((one) => one.id === name) ?? all[0],
    { values, pose, see } = usePlace(sketches, sketch, tool !== "select"),
    { view, isMoved, setView } = useView(sketch, held),
    grid = view ? gridOf(MESH / view.scale) : 1;
  const stood = (sketch && known.get(sketch.id)) ?? new Map();
  const board: Board | null =
    sketch && pose ? { sketch, pose, joints: joints(sketch, pose), grid, known: stood, parts } : null;
  if (board) known.set(board.sketch.id, stood);
  const acts = useActs(sketches, board, view?.scale ?? 1, { edit, isAt }),
    owner = useOwner(board, acts.act),
    under = useUnder(sketch ? `${folder.peek()}/${asked.scene} ${sketch.id}` : null, view);

  const choose = (next: Tool) => {
    setChosen({ tool: next });
    acts.forget();
    if (next === "select") return;
    see(null);
    if (view) setView(view);
  };
  const show = (id: string) => {
    setName(id);
    see(null);
    setChosen({ tool: "select" });
    setView(null);
    owner.choose(null);
  };
  const begin = () => {
    const isBegun = edit((edits) => {
      const steps = new Steps(edits);
      setName(begun(steps, parts));
      return steps.changes;
    });
    if (!isBegun) return;
    acts.changed();
    setView(START);
    setChosen({ tool: "ground" });
  };
  // Its drive is one of the parts, which come a moment after the page.
  const Begin = (
    <button type="button" disabled={!parts.kinds.length} onClick={begin}>
      New linkage
    </button>
  );

  if (!sketch || !view)
    return (
      <div class="drawing" aria-busy={acts.busy}>
        <p class="soft">
          {stale ? "The scene has faults: they are told below." : "There is no linkage in this scene."}
        </p>
        {Begin}
      </div>
    );
  const isSeveral = find(root() ?? undefined, ["objects", sketch.id, "inputs"]) !== undefined;
  return (
    <div class="drawing">
      <Tools tool={tool} choose={choose} />
      <div class="tools">
        {all.length > 1 && <LinkageChoice all={all} id={sketch.id} choose={show} />}
        {!sketch.draft && <InputRows sketch={sketch} at={values} disabled={tool !== "select"} set={see} />}
        {!isSeveral && sketch.pairs.length > 0 && (
          <DrivenChoice pairs={sketch.pairs} drive={(pair) => acts.act((steps, now) => driven(steps, now, pair))} />
        )}
      </div>
      <Sheet
        {...{ sketch, pose, board, chosen, view, grid, isMoved, setView, acts, owner, under, held, drag }}
        isBusy={acts.busy || !isSettled()}
        leave={() => choose("select")}
      />
      <Note told={acts.told} stale={stale} draft={sketch.draft === true} />
      <PictureTools under={under} />
      <p class="soft">{TOOLS[tool].help}</p>
      <Structure sketch={sketch} />
      {tool === "select" && <LengthsChoice links={sketch.links} owner={owner} />}
      {Begin}
    </div>
  );
}
