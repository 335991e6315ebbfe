// The tools of the graph, and what is said below it.

import { clip } from "../copy";
import type { Deeds, Graph } from "./deeds";

export function GraphTools({ graph: { selected, select }, deeds }: { graph: Graph; deeds: Deeds }) {
  const { edge, isAdding } = deeds,
    isNone = !selected.length;
  return (
    <div class="tools" role="toolbar" aria-label="graph">
      <button type="button" aria-expanded={isAdding} onClick={() => deeds.setAdding(!isAdding)}>
        Add object
      </button>
      <button type="button" disabled={isNone} onClick={deeds.duplicate} title="Ctrl-D">
        Duplicate
      </button>
      <button type="button" disabled={isNone} onClick={deeds.copy} title="Ctrl-C">
        Copy
      </button>
      <button
        type="button"
        disabled={clip.text === null}
        onClick={() => deeds.paste(clip.text!)}
        title="Ctrl-V, from other windows too"
      >
        Paste
      </button>
      <button type="button" disabled={isNone && !edge} onClick={deeds.remove} title="Delete">
        Delete
      </button>
      <button
        type="button"
        aria-pressed={isNone && !edge}
        onClick={() => {
          deeds.setEdge(null);
          select([]);
        }}
      >
        Scene and run
      </button>
    </div>
  );
}

export function Hint({ graph: { objects, selected }, deeds }: { graph: Graph; deeds: Deeds }) {
  const { joining, refused, edge } = deeds;
  if (joining)
    return (
      <p class="hint-line" role="status">
        Connect {joining} to …: choose an object, Escape ends.
      </p>
    );
  if (refused)
    return (
      <p class="hint-line refused" role="status">
        {refused}
      </p>
    );
  if (!objects.length || selected.length || edge) return null;
  return (
    <p class="hint-line soft">
      Drag from port to port to connect; C connects with the keyboard, Shift selects several.
    </p>
  );
}
