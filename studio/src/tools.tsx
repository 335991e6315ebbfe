// The tools of a drawing: what a press in it does.

import { grounded, guided, linked, pointed, removed, type Board, type Spot } from "./build";
import { outputAdded, driveAdded } from "./ends";
import type { Steps } from "./tree";

export type Tool = "select" | "ground" | "link" | "point" | "guide" | "drive" | "output" | "delete";
type Act = (steps: Steps, board: Board, from: Spot, to: Spot) => string | null;

// Name, whether it goes from one place to another, what it does, and what is said of it.
// `once`: what may be pressed at already where it goes from one place to another.
interface Use {
  words: string;
  two: boolean;
  once?: (at: Spot) => boolean;
  act: Act | null;
  help: string;
}
export const TOOLS: Record<Tool, Use> = {
  select: {
    words: "Select",
    two: false,
    act: null,
    help: "Press a link to see and type its lengths. Drag a joint, or move it with the arrow keys: the other joints and the angles of the links stay as they are at this input. Delete takes it away.",
  },
  ground: {
    words: "Ground",
    two: false,
    act: grounded,
    help: "Click where the ground has a point; at a joint it holds the joint.",
  },
  link: {
    words: "Link",
    two: true,
    act: linked,
    help: "Drag, or click twice, from place to place: a joint or a link that is there gets a pin, a new place a point. The first pin on the ground is driven.",
  },
  point: {
    words: "Point",
    two: true,
    act: pointed,
    help: "Press on a link and let go where its further point is to be.",
  },
  guide: {
    words: "Guide",
    two: true,
    act: guided,
    help: "Press at a joint of a link and let go in the direction in which it is to slide on the ground.",
  },
  drive: {
    words: "Drive",
    two: false,
    act: (steps, board, from) => driveAdded(steps, board, from),
    help: "Click a pin: a drive of its own turns it, beside those that there are.",
  },
  output: {
    words: "Output",
    two: true,
    once: ({ joint, link }) => !joint && link !== null,
    act: outputAdded,
    help: "Click a link: a lever follows its angle. Drag from a joint: a slide follows its travel in that direction.",
  },
  delete: {
    words: "Delete",
    two: false,
    act: (steps, board, from) => removed(steps, board, from),
    help: "Click a joint, which loses its pairs and points, or a link.",
  },
};

export function Tools({ tool, choose }: { tool: Tool; choose: (tool: Tool) => void }) {
  return (
    <div class="tools" role="toolbar" aria-label="tools of the drawing">
      {(Object.keys(TOOLS) as Tool[]).map((name) => (
        <button
          type="button"
          key={name}
          aria-pressed={tool === name}
          title={TOOLS[name].help}
          onClick={() => choose(name)}
        >
          {TOOLS[name].words}
        </button>
      ))}
    </div>
  );
}
