// The lengths of the link that is chosen in the drawing, each beside its line; a press on one, or a digit
// at the link, opens fields there for length and direction.

import { useLayoutEffect, useRef } from "preact/hooks";
import { WIDTH } from "../figure";
import { Entry } from "./entry";
import { typedMeasure, type Measure } from "./lengths";
import { ANGLES, LENGTHS, placed, type Point } from "../linkage";
import type { Owner } from "./owner";
import { unitOf } from "../units";

type Sort = "length" | "angle";

const unitFor = (sort: Sort): string => (sort === "length" ? unitOf("m") || "mm" : unitOf("rad") || "deg");
export const written = (value: number, sort: Sort): string => {
  const unit = unitFor(sort),
    one = (sort === "length" ? LENGTHS : ANGLES)[unit]!;
  return `${Number((value / one).toPrecision(7))} ${unit}`;
};
interface Props {
  owner: Owner;
  pose: number[];
  pixel: (at: Point) => Point;
}

// The drawing is not moved by what is pressed here.
const keep = (event: Event): void => event.stopPropagation();

export function Measures({ owner, pose, pixel }: Props) {
  const measures = owner.measures ?? [];
  const ends = ({ link, from, to }: Measure): [Point, Point] => [
    pixel(placed(pose, link, from)),
    pixel(placed(pose, link, to)),
  ];
  const typed = measures.find(({ point }) => point === owner.typed);
  return (
    <g class="measures">
      {measures.map((measure) => {
        const [a, b] = ends(measure),
          [x, y] = [(a[0] + b[0]) / 2 + 8, (a[1] + b[1]) / 2 - 8],
          words = written(measure.length, "length"),
          begin = () => owner.type(measure.point);
        return (
          <g key={measure.point}>
            <path d={`M${a.join(" ")}L${b.join(" ")}`} />
            <text
              x={x}
              y={y}
              tabindex={0}
              role="button"
              aria-label={`${words}, length ${measure.name} of ${owner.name}`}
              data-measure={measure.point}
              onPointerDown={keep}
              onClick={begin}
              onKeyDown={(event) => {
                if (event.key !== "Enter" && event.key !== " ") return;
                event.preventDefault();
                event.stopPropagation();
                begin();
              }}
            >
              {words}
            </text>
          </g>
        );
      })}
      {typed && <Fields key={typed.point} owner={owner} measure={typed} at={ends(typed)} />}
    </g>
  );
}

// Of the fields, in the drawing.
const ROOM = { width: 230, height: 32 };

function Fields({ owner, measure, at: [a, b] }: { owner: Owner; measure: Measure; at: [Point, Point] }) {
  const { ahead } = owner,
    leave = () => owner.type(null);
  const place = useRef<HTMLDivElement>(null);
  // What was typed before they are there.
  useLayoutEffect(() => {
    const [first] = place.current!.querySelectorAll("input");
    first!.focus();
    if (!ahead.current) return;
    first!.value = ahead.current;
    ahead.current = "";
    first!.dispatchEvent(new Event("input", { bubbles: true }));
  }, []);
  return (
    <foreignObject
      x={Math.max(0, Math.min(WIDTH - ROOM.width, (a[0] + b[0]) / 2 + 2))}
      y={Math.max(0, (a[1] + b[1]) / 2 - 30)}
      {...ROOM}
    >
      <div
        class="measure-fields"
        ref={place}
        onPointerDown={keep}
        onKeyDown={(event) => {
          event.stopPropagation();
          if (event.key !== "Escape") return;
          place.current!.closest("svg")?.querySelector<SVGElement>(".body.chosen")?.focus();
          leave();
        }}
        onFocusOut={(event) => {
          if (!place.current?.contains(event.relatedTarget as Node | null)) leave();
        }}
      >
        {(["length", "angle"] as const).map((sort) => (
          <Entry
            key={sort}
            id={`measure ${sort}`}
            label={`${sort} ${measure.name} of ${owner.name}`}
            words={written(measure[sort], sort)}
            take={(typed) => {
              const value = typedMeasure(typed, sort, unitFor(sort));
              if (typeof value === "string") return value;
              owner.resize(measure.point, { [sort]: value });
              return null;
            }}
          />
        ))}
      </div>
    </foreignObject>
  );
}
