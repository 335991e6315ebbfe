// The mechanism as a graph: objects with their ports, joined by dragging from port to port or
// with the keyboard.

import { useMemo } from "preact/hooks";
import { boxes, ownerOf, type Box } from "../graph";
import { Palette } from "../kinds";
import { ObjectBox, type Fault } from "./box";
import { useDeeds, type Graph } from "./deeds";
import { Edges, PullLine } from "./edges";
import { pressed } from "./keys";
import { usePull } from "./pull";
import { GraphTools, Hint } from "./tools";
import { useView, type Sight } from "./view";

const NONE: Fault[] = [];

function byObject(faults: Fault[]): Map<string, Fault[]> {
  const all = new Map<string, Fault[]>();
  for (const fault of faults) {
    const id = fault.path.split(".")[0]!,
      own = all.get(id) ?? [];
    own.push(fault);
    all.set(id, own);
  }
  return all;
}

const Zoom = ({ zoom, fit }: Sight) => (
  <div class="zoom">
    <button type="button" onClick={() => zoom(1.25)} aria-label="zoom in">
      +
    </button>
    <button type="button" onClick={() => zoom(0.8)} aria-label="zoom out">
      −
    </button>
    <button type="button" onClick={fit}>
      Fit
    </button>
  </div>
);

export function Objects({ faults, ...graph }: Graph & { faults: Fault[] }) {
  const { objects, parts, selected, select } = graph;
  const { drawn, at, faultsBy } = useMemo(() => {
    const drawn = boxes(objects);
    return { drawn, at: new Map(drawn.map((box) => [box.object.id, box])), faultsBy: byObject(faults) };
  }, [objects, faults]);
  const sight = useView(drawn),
    deeds = useDeeds(graph),
    { joining, setEdge, setAdding } = deeds,
    { pull, ...pulling } = usePull(objects, sight, deeds),
    { svg, now } = sight;
  const inSight = sight.inSight(),
    isSeen = ({ object: { id } }: Box) => inSight === null || inSight.has(id) || ownerOf(pull?.output ?? "") === id;
  const choose = (id: string, event: PointerEvent) => {
    setEdge(null);
    if (joining) {
      deeds.connect(joining, at.get(id)!.object, null);
      return;
    }
    const others = selected.filter((one) => one !== id);
    if (!event.shiftKey) select([id]);
    else select(selected.includes(id) ? others : [...selected, id]);
  };
  return (
    <div class="objects" onKeyDown={(event) => pressed(event, graph, deeds)}>
      <GraphTools graph={graph} deeds={deeds} />
      <div class="canvas">
        <svg
          class="objects-graph"
          ref={svg}
          role="group"
          aria-label="objects of the mechanism"
          onPointerDownCapture={() => deeds.setRefused("")}
          onPointerDown={sight.hold}
          onPointerMove={(event) => (pull ? pulling.move(event) : sight.move(event))}
          onPointerUp={(event) => {
            sight.release();
            pulling.drop(event);
          }}
          onPointerCancel={() => {
            sight.release();
            pulling.cancel();
          }}
          onDblClick={sight.fit}
        >
          <g transform={`translate(${now.x.toFixed(2)} ${now.y.toFixed(2)}) scale(${now.k.toFixed(4)})`}>
            <Edges
              {...{ drawn, at, isSeen }}
              chosen={deeds.edge}
              choose={(address) => {
                setEdge(address);
                select([]);
              }}
            />
            {drawn.filter(isSeen).map((box) => {
              const { id } = box.object;
              return (
                <ObjectBox
                  key={id}
                  box={box}
                  faults={faultsBy.get(id) ?? NONE}
                  chosen={selected.includes(id)}
                  target={joining !== null && joining !== id}
                  begin={pulling.begin}
                  choose={(event) => choose(id, event)}
                />
              );
            })}
            {pull && <PullLine pull={pull} />}
          </g>
        </svg>
        <Zoom {...sight} />
        <Hint graph={graph} deeds={deeds} />
        {(deeds.isAdding || objects.length === 0) && (
          <Palette parts={parts} add={deeds.add} close={objects.length ? () => setAdding(false) : null} />
        )}
      </div>
    </div>
  );
}
