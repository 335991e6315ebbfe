// The picture of a linkage with what is done in it.

import type { Board } from "../build";
import { framed, Grid, HEIGHT, JointMark, Links, toPixel, WIDTH, zoomed, type Frame } from "../figure";
import { Measures } from "./measures";
import type { Point, Sketch } from "../linkage";
import type { Tool } from "../tools";
import type { Acts, Grip } from "./acts";
import { useHands, type Hands } from "./hands";
import type { Owner } from "./owner";
import { Marks, PictureBelow } from "./picture";
import type { Under } from "./under";
import { useUnderHands } from "./under-hands";

interface Props {
  sketch: Sketch;
  pose: number[] | null;
  board: Board | null;
  chosen: { tool: Tool };
  view: Frame;
  grid: number;
  isMoved: boolean;
  setView: (view: Frame | null) => void;
  acts: Acts;
  owner: Owner;
  under: Under;
  held: { current: Grip | null };
  drag: () => number;
  isBusy: boolean;
  // Escape, when nothing is chosen.
  leave: () => void;
}

export function Sheet(props: Props) {
  const { sketch, pose, board, chosen, view, grid, owner, under, setView, isBusy } = props,
    { tool } = chosen,
    isSelect = tool === "select",
    hands = useHands({
      ...props,
      pressLink: owner.choose,
      leave: () => (owner.name === null ? props.leave() : owner.choose(null)),
    });
  const adjusting = useUnderHands({ under, view, grid, placeOf: hands.placeOf }),
    pixel = (place: Point): Point => toPixel(view, place);
  return (
    <div class="sheet">
      <svg
        class={adjusting ? "sketch adjusting" : isSelect ? "sketch" : "sketch drawn"}
        ref={hands.svg}
        viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
        tabindex={isSelect && !adjusting ? -1 : 0}
        role="group"
        aria-label={`linkage ${sketch.id}`}
        aria-busy={isBusy}
        {...(adjusting ?? hands).handlers}
        onPointerLeave={() => hands.look(null)}
      >
        <PictureBelow under={under} view={view} />
        {!isSelect && <Grid frame={view} step={grid} />}
        {pose && (
          <Links
            sketch={sketch}
            pose={pose}
            pixel={pixel}
            chosen={owner.name}
            keys={isSelect ? owner.keys : undefined}
          />
        )}
        {board?.joints.map((joint) => (
          <JointMark
            key={joint.names[0]}
            joint={joint}
            pixel={pixel}
            onKeyDown={(event) => hands.jointKeys(joint, event)}
            onFocus={() => hands.look(joint.at)}
            onPointerDown={(event) => hands.take(joint, event)}
          />
        ))}
        {adjusting && <Marks marks={under.marks} aim={adjusting.aim} view={view} />}
        <Spots hands={hands} pixel={pixel} />
        {pose && isSelect && owner.measures && <Measures key={owner.name} {...{ owner, pose, pixel }} />}
        {!pose && (
          <text class="soft" x={WIDTH / 2} y={HEIGHT / 2} text-anchor="middle">
            It cannot be put together at this input.
          </text>
        )}
      </svg>
      <Zoom view={view} set={setView} fit={() => setView(isSelect ? null : framed(sketch))} />
      <p class="mobility" aria-hidden="true">
        {sketch.told.join("; ")}
      </p>
    </div>
  );
}

// Where a tool was pressed, and where it would be now.
function Spots({ hands: { begin, target }, pixel }: { hands: Hands; pixel: (place: Point) => Point }) {
  return (
    <>
      {begin && target && <path class="rubber" d={`M${pixel(begin.at).join(" ")}L${pixel(target.at).join(" ")}`} />}
      {[begin, target].map(
        (spot) =>
          spot && (
            <circle
              class={spot.joint || spot.link !== null ? "spot held" : "spot"}
              cx={pixel(spot.at)[0]}
              cy={pixel(spot.at)[1]}
              r={spot.joint ? 9 : 5}
            />
          ),
      )}
    </>
  );
}

const Zoom = ({ view, set, fit }: { view: Frame; set: (view: Frame) => void; fit: () => void }) => (
  <div class="zoom">
    <button type="button" onClick={() => set(zoomed(view, 1.25))} aria-label="zoom in">
      +
    </button>
    <button type="button" onClick={() => set(zoomed(view, 0.8))} aria-label="zoom out">
      −
    </button>
    <button type="button" onClick={fit}>
      Fit
    </button>
  </div>
);
