// The curves of a motion, with handles: boundaries are moved along, levels up and down.

import { counted, levelsOf, open, placed, round, unitOf, isDwell, type Motion, type Segment } from "./motion";
import { curve, gripOf, ticks, xOf, yOf, type Frame } from "./scale";

// What is held: a boundary by its station, or a level by its stations.
export type Grip = { sort: "boundary"; station: number } | { sort: "level"; group: number[] };
interface Props {
  motion: Motion;
  segments: Segment[];
  frame: Frame;
  hold: (grip: Grip, event: PointerEvent) => void;
  press: (grip: Grip, event: KeyboardEvent) => void;
}

export function Curves({ motion, segments, frame, hold, press }: Props) {
  const foot = frame.height - 20;
  return (
    <>
      {ticks(frame, motion.axis).map(({ place, label }) => (
        <g key={label} class="tick">
          <path d={`M${xOf(frame, place)} ${frame.lanes[0]!.top}V${foot}`} />
          <text
            x={xOf(frame, place)}
            y={foot + 14}
            text-anchor={place === frame.range[0] ? "start" : place === frame.range[1] ? "end" : "middle"}
          >
            {label}
          </text>
        </g>
      ))}
      {frame.lanes.map((lane, order) => (
        <g key={lane.name} class="lane" data-curve={lane.name}>
          <path class="zero" d={`M${frame.left} ${yOf(lane, 0)}H${frame.right}`} />
          <path class={`curve c${order}`} d={curve(frame, lane, motion, order)} />
        </g>
      ))}
      {motion.jumps.map((jump) => (
        <Mark key={`${jump.order} ${jump.at}`} jump={jump} motion={motion} frame={frame} />
      ))}
      {open(motion).map((_, station) => (
        <Boundary key={`b${station}`} station={station} {...{ motion, segments, frame, hold, press }} />
      ))}
      {frame.lanes.map((lane, order) => (
        <g key={`words of ${lane.name}`} class="lane-words">
          <text x={frame.left} y={lane.top - 5}>
            {lane.name}, {lane.unit}
          </text>
          <text class="size" x={frame.right} y={lane.top - 5} text-anchor="end">
            {sizes(motion.columns[order + 1]!, lane.factor)}
          </text>
        </g>
      ))}
      {levelsOf(motion, segments).map((group) => (
        <Level key={`l${group[0]}`} group={group} {...{ motion, segments, frame, hold, press }} />
      ))}
    </>
  );
}

const sizes = (values: number[], factor: number): string =>
  [Math.min(...values), Math.max(...values)].map((one) => numbers.significant(one / factor, 4)).join(" … ");

// A jump of velocity or acceleration.
function Mark({
  jump: { at, order, before, after },
  motion,
  frame,
}: {
  jump: Motion["jumps"][number];
  motion: Motion;
  frame: Frame;
}) {
  const lane = frame.lanes[order]!,
    x = xOf(frame, placed(motion, at + motion.phase)),
    [a, b] = [yOf(lane, before), yOf(lane, after)];
  return (
    <g class="jump" data-order={order}>
      <path d={`M${x} ${a}V${b}`} />
      <circle cx={x} cy={a} r={3.5} />
      <circle cx={x} cy={b} r={3.5} />
    </g>
  );
}

// What the boundary at a station lies between.
export function between(segments: Segment[], station: number): string {
  const before = segments.find((one) => one.to === station)?.name ?? "start",
    after = segments.find((one) => one.from === station)?.name ?? "end";
  return `${before} and ${after}`;
}

function Boundary({ station, motion, segments, frame, hold, press }: Props & { station: number }) {
  const place = placed(motion, open(motion)[station]!.at),
    x = xOf(frame, place),
    { factor } = unitOf(motion.axis),
    grip: Grip = { sort: "boundary", station };
  const count = (value: number) => round(value / factor, 7);
  return (
    <g
      class="boundary"
      role="slider"
      tabindex={0}
      aria-label={`boundary between ${between(segments, station)}`}
      aria-orientation="horizontal"
      data-station={station}
      aria-valuemin={count(frame.range[0])}
      aria-valuemax={count(frame.range[1])}
      aria-valuenow={count(place)}
      aria-valuetext={counted(place, motion.axis)}
      onPointerDown={(event) => hold(grip, event)}
      onKeyDown={(event) => press(grip, event)}
    >
      <path class="line" d={`M${x} ${frame.lanes[0]!.top}V${frame.height - 20}`} />
      <rect
        class="hit"
        x={x - 8}
        y={frame.lanes[0]!.top - 4}
        width={16}
        height={frame.height - frame.lanes[0]!.top - 12}
      />
      <path class="knob" d={`M${x} ${frame.height - 30}l6 7v6h-12v-6z`} />
      <title>{`${counted(place, motion.axis)}: drag, or arrow keys; Shift for tenths`}</title>
    </g>
  );
}

export function levelName(segments: Segment[], group: number[]): string {
  const dwell = segments.find((one) => isDwell(one) && group.includes(one.from));
  return dwell ? `level of ${dwell.name}` : `level at the boundary between ${between(segments, group[0]!)}`;
}

function Level({ group, motion, segments, frame, hold, press }: Props & { group: number[] }) {
  const { at, displacement } = open(motion)[group[0]!]!,
    dwell = segments.find((one) => isDwell(one) && group.includes(one.from));
  const lane = frame.lanes[0]!,
    x = xOf(frame, gripOf(motion, dwell?.ends ?? null, at)),
    y = yOf(lane, displacement),
    [unit] = motion.units,
    { factor } = unitOf(unit),
    grip: Grip = { sort: "level", group };
  return (
    <g
      class="level"
      role="slider"
      tabindex={0}
      aria-label={levelName(segments, group)}
      aria-orientation="vertical"
      data-station={group[0]}
      aria-valuemin={round(lane.low / factor, 7)}
      aria-valuemax={round(lane.high / factor, 7)}
      aria-valuenow={round(displacement / factor, 7)}
      aria-valuetext={counted(displacement, unit)}
      onPointerDown={(event) => hold(grip, event)}
      onKeyDown={(event) => press(grip, event)}
    >
      <rect class="hit" x={x - 14} y={y - 10} width={28} height={20} />
      <rect class="knob" x={x - 10} y={y - 4} width={20} height={8} rx={4} />
      <title>{`${counted(displacement, unit)}: drag, or arrow keys; Shift for tenths`}</title>
    </g>
  );
}
