// What the graph does to the text: objects are joined, let go, taken out.

import { freeName, ownerOf, type Outline } from "../graph";
import { Steps, written, type Change, type Edits } from "../tree";

// Where an input is written, and with what, when it is connected to an output; without an address to
// the only input, or one that is free. Text: why it cannot be.
export function connection(edits: Edits, object: Outline, address: string | null, output: string): Change[] | string {
  const { id, inputs, open, kind } = object,
    free = inputs.find((one) => one.output === "") ?? (open || inputs.length > 1 ? undefined : inputs[0]);
  const known = address === null ? free : inputs.find((one) => one.address === address);
  if (known) return edits.set(["objects", ...known.address.split(".")], JSON.stringify(output));
  if (inputs.length && !open) return `All inputs of ${id} are connected: drop on the one that is to change.`;
  if (!open)
    return kind
      ? `${id} has no input: nothing drives an object of kind ${kind.replaceAll("_", " ")}.`
      : `The kind of ${id} is not known, and so are its inputs.`;
  const name = freeName(
    "input",
    inputs.map((one) => one.name),
  );
  return edits.set(["objects", object.id, "inputs", name], written({ object: output, ratio: 1 }));
}

// What an object loses when it hangs on nothing.
export function released(edits: Edits, address: string): Change[] {
  const [id, ...rest] = address.split(".");
  return edits.remove(rest[0] === "inputs" ? ["objects", id!, "inputs", rest[1]!] : ["objects", id!, "input"]);
}

// Objects taken out, and all connections to them.
export function removed(edits: Edits, ids: string[], objects: Outline[]): Change[] {
  const gone = new Set(ids),
    loose = objects
      .filter((one) => !gone.has(one.id))
      .flatMap((one) => one.inputs.filter((input) => gone.has(ownerOf(input.output))).map((input) => input.address));
  const steps = new Steps(edits);
  for (const address of loose) steps.do((now) => released(now, address));
  for (const id of ids) steps.remove(["objects", id]);
  return steps.changes;
}
