// The connections of the graph.

import { ownerOf, portAt, type Box, type Input } from "../graph";
import type { Pull } from "./pull";
import { MANY } from "./view";

interface Place {
  x: number;
  y: number;
}

function curve(a: Place, b: Place): string {
  const d = Math.max(36, Math.abs(b.x - a.x) / 2);
  return `M${a.x} ${a.y}C${a.x + d} ${a.y} ${b.x - d} ${b.y} ${b.x} ${b.y}`;
}

// What is dragged.
export const PullLine = ({ pull }: { pull: Pull }) => (
  <path class="pull" d={pull.output !== null ? curve(pull.ends, pull) : curve(pull, pull.ends)} />
);

interface EdgeProps {
  input: Input;
  box: Box;
  d: string;
  isChosen: boolean;
  choose: () => void;
}

const Edge = ({ input, box: { object }, d, isChosen, choose }: EdgeProps) => (
  <g
    class={`connection${isChosen ? " chosen" : ""}`}
    tabindex={0}
    role="button"
    data-edge={input.address}
    aria-label={`connection from ${input.output} to ${object.id}`}
    onPointerDown={(event) => {
      event.stopPropagation();
      choose();
    }}
  >
    <title>
      {input.output} drives {object.id}
      {object.open ? ` (${input.name})` : ""}; Delete takes it away
    </title>
    <path class="hit" d={d} />
    <path d={d} />
  </g>
);

interface Props {
  drawn: Box[];
  at: Map<string, Box>;
  isSeen: (box: Box) => boolean;
  chosen: string | null;
  choose: (address: string) => void;
}

export function Edges({ drawn, at, isSeen, chosen, choose }: Props) {
  return (
    <>
      {drawn.flatMap((box) =>
        box.object.inputs.map((input, index) => {
          const from = at.get(ownerOf(input.output));
          // Of many that begin at an object in sight those whose end is.
          if (!from || !(isSeen(box) || (isSeen(from) && at.size <= MANY))) return null;
          const { outputs } = from.object,
            port = Math.max(
              0,
              outputs.findIndex((one) => one.address === input.output),
            );
          return (
            <Edge
              key={input.address}
              input={input}
              box={box}
              d={curve(portAt(from, "out", port), portAt(box, "in", index))}
              isChosen={chosen === input.address}
              choose={() => choose(input.address)}
            />
          );
        }),
      )}
    </>
  );
}
