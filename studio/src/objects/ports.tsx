// The ports of an object in the graph, from which connections are dragged.

import { portAt, type Box, type Output } from "../graph";
import type { Begin } from "./pull";

export interface PortOfInput {
  // null: a further one is made.
  address: string | null;
  name: string;
  free: boolean;
}
interface Of {
  box: Box;
  index: number;
  isNamed: boolean;
  begin: Begin;
}

export const cut = (text: string, length: number): string =>
  text.length > length ? `${text.slice(0, length - 1)}…` : text;

export function InPort({ box, port: { address, name, free }, index, isNamed, begin }: Of & { port: PortOfInput }) {
  const place = portAt(box, "in", index);
  return (
    <g
      class={`port in${address === null ? " further" : free ? " free" : ""}`}
      data-input={address ?? ""}
      onPointerDown={(event) => {
        if (address) begin(event, null, address, place);
      }}
    >
      <title>{address ? `input ${name}; drag it to an output, or away to let go` : "a further input"}</title>
      <circle class="hit" cx={place.x} cy={place.y} r={11} />
      <circle cx={place.x} cy={place.y} r={5.5} />
      {isNamed && (
        <text class="port-name" x={place.x + 9} y={place.y + 3.5}>
          {address ? cut(name, 8) : "+"}
        </text>
      )}
    </g>
  );
}

export function OutPort({ box, output, index, isNamed, begin }: Of & { output: Output }) {
  const place = portAt(box, "out", index),
    { address, coordinate } = output,
    name = address.split(".")[1] ?? "";
  return (
    <g class="port out" data-output={address} onPointerDown={(event) => begin(event, address, null, place)}>
      <title>{`output ${address}${coordinate ? `, ${coordinate}` : ""}; drag it to an input`}</title>
      <circle class="hit" cx={place.x} cy={place.y} r={11} />
      {coordinate === "sliding" ? (
        <rect x={place.x - 5} y={place.y - 5} width={10} height={10} />
      ) : (
        <circle cx={place.x} cy={place.y} r={5.5} />
      )}
      {isNamed && name && (
        <text class="port-name" x={place.x + 10} y={place.y + 3.5}>
          {name}
        </text>
      )}
    </g>
  );
}
