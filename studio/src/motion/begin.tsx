// Where an object has no motion yet: a button that gives it one, to be drawn on.

import type { Desk } from "../form/desk";
import { find, type Change, type Edits, type Value } from "../tree";

interface Props {
  id: string;
  kind: string;
  desk: Desk;
  edit: (make: (edits: Edits) => Change[], drag?: number) => boolean;
  drag: () => number;
  // Whether outputs turn or slide, by their addresses.
  coordinates: Map<string, string | null>;
}

// Rise, dwell, return, rest: a quarter of the cycle each.
const CAM = (lift: string): string =>
  `{ "cam": { "lift": ${lift}, "rise": "90 deg", "dwell": "90 deg", "return": "90 deg", "law": "cycloidal" } }`;
const QUARTERS = ["cycloidal", "dwell", "cycloidal", "dwell"];
function plan(level: string, [size, unit]: [number, string]): string {
  const stations = QUARTERS.map(
    (law, k) =>
      `{ "at": ${k ? `"${k * size} ${unit}"` : 0}, "displacement": ${k === 1 || k === 2 ? level : 0}, "motion": "${law}" }`,
  );
  return `{ "plan": { "stations": [${stations.join(", ")}], "period": "${4 * size} ${unit}" } }`;
}

// Nothing in it, or nothing in its one function.
function isEmpty(value: Value | undefined): boolean {
  if (value?.sort !== "object") return !value || value.sort === "null" || value.sort === "wrong";
  const [own] = value.members;
  return (
    !own ||
    (value.members.length === 1 &&
      ["cam", "plan"].includes(own.name) &&
      own.value.sort === "object" &&
      own.value.members.every((one) => one.name === "stations" && !one.value.items.length))
  );
}

// Whether it turns or slides, as far as the text says.
function slides({ id, kind, desk, coordinates }: Props): boolean {
  const known = coordinates.get(id),
    word = (name: string) => find(desk.root, ["objects", id, name])?.text;
  return (
    known === "sliding" ||
    (!known && (kind === "slider" || word("motion") === "sliding" || word("coordinate") === "sliding"))
  );
}

export function Begin(props: Props) {
  const { id, kind, desk, edit, drag, coordinates } = props,
    isDrive = kind === "drive",
    name = isDrive ? "motion" : "position";
  const own = find(desk.root, ["objects", id]),
    value = find(own, [name]);
  const fits = isDrive
    ? find(own, ["motor"]) === undefined
    : desk.guide.root.$defs?.[kind]?.properties?.position !== undefined;
  // A copy from the catalogue may have one that does not stand here: the program says if it lacks it.
  const lacks = desk.faults.some(
    (fault) => fault.path === `${id}.${name}` || (fault.path === id && fault.message.includes(`\`${name}\``)),
  );
  if (!fits || (find(own, ["from"]) && !lacks) || !isEmpty(value)) return null;
  const begin = () => {
    const level = slides(props) ? '"10 mm"' : '"10 deg"',
      driver = find(own, ["input"])?.text ?? "";
    const json = isDrive
      ? plan(level, [0.25, "s"])
      : coordinates.get(driver) === "sliding"
        ? plan(level, [25, "mm"])
        : CAM(level);
    edit((edits) => edits.set(["objects", id, name], json), drag());
  };
  return (
    <section class="motion" aria-label={`motion of ${id}`}>
      <p class="soft">{id} has no motion yet.</p>
      <button type="button" onClick={begin}>
        Draw the motion
      </button>
    </section>
  );
}
