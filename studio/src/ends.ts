// Where motion enters a linkage and leaves it: drives of its pins, and what hangs on its links.

import { hold, own, pathOf, type Board, type Spot } from "./build";
import { freeName } from "./graph";
import { far, placed, type Pair } from "./linkage";
import { driveOf, addBehind } from "./starter";
import { find, member, type Steps, written } from "./tree";

// A drive of its own for a pin, beside those that there are.
export function driveAdded(steps: Steps, board: Board, { joint }: Spot): string | null {
  const wrong = own(steps, board),
    isThere = ({ on }: Pair) => joint && far(placed(board.pose, on.link, on.at), joint.at) < board.grid / 100,
    pins = board.sketch.pairs.filter((one) => one.direction === null && isThere(one)),
    pin = pins.find((one) => one.on.link === null || one.link.link === null) ?? pins[0];
  if (wrong) return wrong;
  if (!pin) return "Click a pin: that is what a drive turns.";
  const linkage = find(steps.root, pathOf(board)),
    driver = member(linkage, "driver")?.value.text,
    inputs = member(linkage, "inputs")?.value.members ?? [];
  if (driver === pin.name || inputs.some((one) => member(one.value, "pair")?.value.text === pin.name))
    return `The pin ${pin.name} is driven already.`;
  if (!driver && !inputs.length) {
    steps.set(pathOf(board, "driver"), JSON.stringify(pin.name));
    if (!member(linkage, "input")) steps.set(pathOf(board, "input"), JSON.stringify(driveOf(steps, board.parts)));
    return null;
  }
  const input = (pair: string, object: string) => {
    const taken = find(steps.root, pathOf(board, "inputs"))?.members.map((one) => one.name) ?? [];
    steps.set(pathOf(board, "inputs", freeName(object, taken)), written({ pair, object }));
  };
  const first = member(linkage, "input")?.value.text,
    second = driveOf(steps, board.parts);
  if (driver) {
    steps.remove(pathOf(board, "driver"));
    if (first !== undefined) steps.remove(pathOf(board, "input"));
    input(driver, first ?? driveOf(steps, board.parts));
  }
  input(pin.name, second);
  return null;
}

// What hangs on a linkage: a lever on the angle of a link, a slide on the travel of a point of it.
export function outputAdded(steps: Steps, board: Board, from: Spot, to: Spot): string | null {
  const wrong = own(steps, board),
    taken = find(steps.root, pathOf(board, "outputs"))?.members.map((one) => one.name) ?? [];
  if (wrong) return wrong;
  const output = (stem: string, value: unknown): string => {
    const name = freeName(stem, taken);
    steps.set(pathOf(board, "outputs", name), written(value));
    return `${board.sketch.id}.${name}`;
  };
  if (!from.joint) {
    if (from.link === null) return "Click a link, or drag from a joint.";
    const name = board.sketch.links[from.link]!.name;
    addBehind(steps, "rocker", board.parts, { output: output(name, { angle: name }), motion: "swing" });
    return null;
  }
  const moves = from.joint.points.some((point) => point.link === null) === false;
  if (!moves) return "The ground holds this joint: nothing moves there. Click a link for its angle.";
  if (far(from.at, to.at) < board.grid / 2)
    return "Drag from the joint in the direction of the travel; click a link for its angle.";
  const degrees = 5 * Math.round((Math.atan2(to.at[1] - from.at[1], to.at[0] - from.at[0]) * 36) / Math.PI),
    { point, letter } = hold(steps, board, from)!,
    direction = degrees ? { direction: `${degrees} deg` } : {};
  addBehind(steps, "slider", board.parts, { output: output(letter, { point, ...direction }), motion: "travel" });
  return null;
}
