// An object of the graph with its ports.

import { BOX, type Box } from "../graph";
import { Picture } from "../kinds";
import { cut, InPort, OutPort, type PortOfInput } from "./ports";
import type { Begin } from "./pull";

export interface Fault {
  path: string;
  severity: string;
  message: string;
  hints: string[];
}
interface Props {
  box: Box;
  faults: Fault[];
  chosen: boolean;
  target: boolean;
  choose: (event: PointerEvent) => void;
  begin: Begin;
}

function portsOf({ object: { inputs, open } }: Box): PortOfInput[] {
  const ports: PortOfInput[] = inputs.map(({ address, name, output }) => ({ address, name, free: output === "" }));
  return open ? [...ports, { address: null, name: "new", free: true }] : ports;
}

// All that is shown of it, in words.
function wordsOf({ object }: Box, kind: string, faults: Fault[]): string {
  const told = faults.map((one) => one.message).join("\n"),
    count = `${faults.length} ${faults.length === 1 ? "fault" : "faults"}`;
  return `${object.id}: ${kind}${object.detail ? `, ${object.detail}` : ""}${faults.length ? `; ${count}: ${told}` : ""}`;
}

const Badge = ({ x, y, count, isError }: { x: number; y: number; count: number; isError: boolean }) => (
  <g class={isError ? "badge error" : "badge warning"}>
    <circle cx={x} cy={y + 4} r={10} />
    <text x={x} y={y + 8} text-anchor="middle">
      {count}
    </text>
  </g>
);

function Names({ box, kind, isAlone }: { box: Box; kind: string; isAlone: boolean }) {
  // Names of ports take the place of the picture.
  const x = box.x + (isAlone ? 44 : 56),
    y = box.y + box.height / 2,
    { id, detail } = box.object;
  return (
    <>
      <text class="id" x={x} y={y - 8}>
        {cut(id, isAlone ? 13 : 11)}
      </text>
      <text class="object-kind" x={x} y={y + 7}>
        {cut(kind, 16)}
      </text>
      <text class="object-kind" x={x} y={y + 21}>
        {cut(detail.replaceAll("_", " "), 18)}
      </text>
    </>
  );
}

export function ObjectBox({ box, faults, chosen, target, choose, begin }: Props) {
  const { object, x, y, height } = box,
    ports = portsOf(box),
    isAlone = ports.length < 2,
    isError = faults.some((one) => one.severity === "error"),
    kind = object.kind ? object.kind.replace("_", " ") : "unknown kind",
    words = wordsOf(box, kind, faults);
  return (
    <g
      class={`object-box${ports.length ? "" : " drive"}${chosen ? " chosen" : ""}${target ? " target" : ""}${isError ? " wrong" : ""}`}
      data-id={object.id}
      tabindex={0}
      role="button"
      aria-pressed={chosen}
      aria-label={words}
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        event.stopPropagation();
        (event.currentTarget as SVGElement).focus();
        choose(event);
      }}
    >
      <title>{words}</title>
      <rect class="frame" x={x} y={y} width={BOX.width} height={height} rx={ports.length ? 6 : 22} />
      {isAlone && <Picture kind={object.kind} x={x + 12} y={y + height / 2 - 12} size={24} />}
      <Names box={box} kind={kind} isAlone={isAlone} />
      {faults.length > 0 && <Badge x={x + BOX.width - 4} y={y} count={faults.length} isError={isError} />}
      {ports.map((port, index) => (
        <InPort key={port.address ?? "new"} {...{ box, port, index, begin }} isNamed={!isAlone} />
      ))}
      {object.outputs.map((output, index) => (
        <OutPort key={output.address} {...{ box, output, index, begin }} isNamed={object.outputs.length > 1} />
      ))}
    </g>
  );
}
