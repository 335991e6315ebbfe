// The form of an object, or of the scene: every property that the schema knows, with its unit and
// its help. What is filled in is an edit of the text.

import { useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Fault } from "./objects";
import type { Guide, Schema } from "./schema";
import { groupOf, literal, shapeOf, type Group, type Shape } from "./shape";
import { freeName } from "./graph";
import { address, find, member, type Change, type Edits, type Step, type Value } from "./tree";

export interface Desk {
  guide: Guide;
  root: Value;
  text: string;
  faults: Fault[];
  // What inputs may hang on.
  outputs: string[];
  edit: (make: (edits: Edits) => Change[]) => boolean;
}

interface Place {
  desk: Desk;
  path: Step[];
  write: (path: Step[], json: string) => void;
}
interface FieldProps extends Place {
  schema: Schema;
  name: string;
  required: boolean;
  remove: boolean;
}

// What is not worth a place of its own: it stands in the head of the form, or belongs to files.
const ASIDE = ["kind", "$schema", "dam"];
const shown = (name: string): string => name.replaceAll("_", " ");
// A description without what is told beside the field anyway.
const helpOf = (schema: Schema): string => String(schema.description ?? "");
const faultsAt = (desk: Desk, path: Step[]): Fault[] => {
  const own = address(path);
  return desk.faults.filter((fault) => fault.path === own);
};
const faultsIn = (desk: Desk, path: Step[]): Fault[] => {
  const own = address(path);
  return desk.faults.filter(
    (fault) => fault.path === own || fault.path.startsWith(`${own}.`) || fault.path.startsWith(`${own}[`),
  );
};

function Told({ desk, path }: { desk: Desk; path: Step[] }) {
  return (
    <>
      {faultsAt(desk, path).map((fault) => (
        <p class={`field-note ${fault.severity}`} role="alert">
          {fault.message}
          {fault.hints.length ? ` (${fault.hints.join("; ")})` : ""}
        </p>
      ))}
    </>
  );
}

function Row({
  desk,
  path,
  schema,
  name,
  required,
  remove,
  children,
  wide,
  why = "",
  write: _,
}: FieldProps & { children: any; wide?: boolean; why?: string }) {
  const id = `field ${address(path)}`,
    set = find(desk.root, path) !== undefined;
  const help = helpOf(schema),
    wrong = why !== "" || faultsAt(desk, path).some((fault) => fault.severity === "error");
  return (
    <div class={`field${wide ? " field-wide" : ""}${wrong ? " wrong" : ""}`} data-field={address(path)}>
      <label for={id} title={help}>
        {shown(name)}
        {required && !set ? <span class="need"> required</span> : null}
      </label>
      <div class="entry">{children}</div>
      {remove && set && !required ? (
        <button
          type="button"
          class="drop"
          aria-label={`remove ${address(path)}`}
          title={`remove ${shown(name)}`}
          onClick={() => desk.edit((edits) => edits.remove(path))}
        >
          ×
        </button>
      ) : (
        <span />
      )}
      <p class="help">
        {help}
        {schema.default !== undefined && typeof schema.default !== "object"
          ? ` Default ${JSON.stringify(schema.default)}.`
          : ""}
      </p>
      {why ? (
        <p class="field-note error" role="alert">
          {why}
        </p>
      ) : (
        <Told desk={desk} path={path} />
      )}
    </div>
  );
}

function Scalar({ shape, ...props }: FieldProps & { shape: Shape & { sort: "scalar" } }) {
  const { desk, path, write, required, schema } = props,
    value = find(desk.root, path),
    id = `field ${address(path)}`;
  const text = value && value.sort !== "wrong" ? value.text : "";
  const [typed, setTyped] = useState(text),
    [why, setWhy] = useState("");
  // (At once, here and below: an effect after the picture is drawn would undo what is typed before.)
  useLayoutEffect(() => {
    setTyped(text);
    setWhy("");
  }, [text]);
  const unit = shape.units[0] ?? "",
    bare = value?.sort === "number" || typed === "";
  const enter = () => {
    setWhy("");
    if (typed === text) return;
    if (typed.trim() === "") {
      if (value && !required) desk.edit((edits) => edits.remove(path));
      else setTyped(text);
      return;
    }
    const made = literal(shape, typed);
    if ("why" in made) {
      setWhy(made.why);
      return;
    }
    write(path, made.json);
    // What was worked out to what stands there already.
    if (find(desk.root, path) === value && made.json === (value && desk.text.slice(value.from, value.to)))
      setTyped(text);
  };
  const preset = schema.default !== undefined && typeof schema.default !== "object" ? String(schema.default) : "";
  return (
    <Row {...props} why={why}>
      <input
        type="text"
        id={id}
        value={typed}
        placeholder={preset}
        spellcheck={false}
        list={shape.words.length ? `${id} words` : undefined}
        aria-invalid={why !== "" || faultsAt(desk, path).some((fault) => fault.severity === "error")}
        onInput={(event) => setTyped(event.currentTarget.value)}
        onBlur={enter}
        onKeyDown={(event) => {
          if (event.key === "Enter") enter();
          if (event.key === "Escape") {
            setTyped(text);
            setWhy("");
          }
        }}
      />
      {unit && bare ? (
        <span class="field-unit" title={`also as text with a unit: ${shape.units.join(", ")}`}>
          {unit}
        </span>
      ) : null}
      {shape.words.length ? (
        <datalist id={`${id} words`}>
          {shape.words.map((word) => (
            <option value={word} />
          ))}
        </datalist>
      ) : null}
    </Row>
  );
}

function Choice({ options, ...props }: FieldProps & { options: string[] }) {
  const { desk, path, write, required, schema } = props,
    value = find(desk.root, path)?.text ?? "";
  const preset = schema.default === undefined ? "" : ` (${schema.default})`;
  const all = value && !options.includes(value) ? [value, ...options] : options;
  return (
    <Row {...props}>
      <select
        id={`field ${address(path)}`}
        value={value}
        onChange={(event) => {
          const chosen = event.currentTarget.value;
          if (chosen === "") desk.edit((edits) => edits.remove(path));
          else write(path, JSON.stringify(chosen));
        }}
      >
        {(value === "" || !required) && (
          <option value="">{value === "" && required ? "choose…" : `not given${preset}`}</option>
        )}
        {all.map((one) => (
          <option value={one}>{one.replaceAll("_", " ")}</option>
        ))}
      </select>
    </Row>
  );
}

// A list of numbers or of points, as it is written.
function Raw(props: FieldProps) {
  const { desk, path, write, required } = props,
    value = find(desk.root, path),
    text = value ? desk.text.slice(value.from, value.to) : "";
  const [typed, setTyped] = useState(text);
  const [wrong, setWrong] = useState("");
  useLayoutEffect(() => {
    setTyped(text);
    setWrong("");
  }, [text]);
  const enter = () => {
    if (typed === text) return;
    if (typed.trim() === "") {
      if (value && !required) desk.edit((edits) => edits.remove(path));
      return;
    }
    const list = typed.trim().startsWith("[") ? typed.trim() : `[${typed.trim()}]`;
    try {
      JSON.parse(list);
    } catch (error) {
      setWrong(`This is no list: ${(error as Error).message}`);
      return;
    }
    write(path, list);
  };
  return (
    <Row {...props} wide why={wrong}>
      <textarea
        id={`field ${address(path)}`}
        rows={Math.min(8, Math.max(1, typed.split("\n").length))}
        value={typed}
        placeholder="[…, …]"
        spellcheck={false}
        onInput={(event) => setTyped(event.currentTarget.value)}
        onBlur={enter}
      />
    </Row>
  );
}

function Section({ props, empty, children }: { props: FieldProps; empty: string | null; children: any }) {
  const { desk, path, schema, name, required, remove } = props,
    set = find(desk.root, path) !== undefined,
    own = address(path);
  const help = helpOf(schema),
    faults = faultsIn(desk, path).length;
  return (
    <div class={faults ? "section wrong" : "section"} role="group" aria-label={own} data-field={own}>
      <div class="legend" title={help}>
        {shown(name)}
        {required && !set ? <span class="need"> required</span> : null}
        {empty !== null && !set ? (
          <button type="button" class="add" aria-label={`add ${own}`} onClick={() => props.write(path, empty)}>
            Add
          </button>
        ) : null}
        {remove && set && !required ? (
          <button
            type="button"
            class="drop"
            aria-label={`remove ${own}`}
            title={`remove ${shown(name)}`}
            onClick={() => desk.edit((edits) => edits.remove(path))}
          >
            ×
          </button>
        ) : null}
      </div>
      <Told desk={desk} path={path} />
      {children}
    </div>
  );
}

function MapOf({ inner, ...props }: FieldProps & { inner: Schema }) {
  const { desk, path, name, write } = props,
    value = find(desk.root, path),
    stem = name.replace(/ies$/, "y").replace(/s$/, "");
  const names = value?.members.map((one) => one.name) ?? [],
    simple = shapeOf(desk.guide, inner);
  const fresh = simple.sort === "scalar" ? "0" : simple.sort === "list" ? "[]" : "{}";
  return (
    <Section props={props} empty={null}>
      {names.map((one) => (
        <div class="named" key={one}>
          <Rename desk={desk} path={[...path, one]} />
          <Field desk={desk} path={[...path, one]} write={write} schema={inner} name={one} required={false} remove />
        </div>
      ))}
      <button
        type="button"
        class="add"
        aria-label={`add to ${address(path)}`}
        onClick={() => write([...path, freeName(stem, names)], fresh)}
      >
        Add {shown(stem)}
      </button>
    </Section>
  );
}

// The name of a part of a map.
function Rename({ desk, path }: { desk: Desk; path: Step[] }) {
  const last = String(path.at(-1)),
    [typed, setTyped] = useState(last),
    own = member(find(desk.root, path.slice(0, -1)), last);
  useLayoutEffect(() => setTyped(last), [last]);
  const enter = () => {
    if (typed === last || !own) return;
    if (typed.trim() === "" || member(find(desk.root, path.slice(0, -1)), typed.trim())) {
      setTyped(last);
      return;
    }
    desk.edit(() => [{ from: own.nameAt[0], to: own.nameAt[1], insert: JSON.stringify(typed.trim()) }]);
  };
  return (
    <label class="rename">
      name{" "}
      <input
        type="text"
        aria-label={`name of ${address(path)}`}
        value={typed}
        onInput={(event) => setTyped(event.currentTarget.value)}
        onBlur={enter}
        onKeyDown={(event) => {
          if (event.key === "Enter") enter();
        }}
      />
    </label>
  );
}

function ListOf({ inner, ...props }: FieldProps & { inner: Schema }) {
  const { desk, path, name, write } = props,
    items = find(desk.root, path)?.items ?? [],
    stem = shown(name).replace(/s$/, "");
  return (
    <Section props={props} empty={null}>
      {items.map((_, k) => (
        <Field
          key={k}
          desk={desk}
          path={[...path, k]}
          write={write}
          schema={inner}
          name={`${stem} ${k + 1}`}
          required={false}
          remove
        />
      ))}
      <button
        type="button"
        class="add"
        aria-label={`add to ${address(path)}`}
        onClick={() => write([...path, items.length], "{}")}
      >
        Add {stem}
      </button>
    </Section>
  );
}

// A word, or something larger in its place.
function Either({ shape, ...props }: FieldProps & { shape: Shape & { sort: "either" } }) {
  const { desk, path, write, schema } = props,
    value = find(desk.root, path);
  const now = !value
    ? ""
    : value.sort === "object" || value.sort === "array"
      ? "…"
      : shape.words.includes(value.text)
        ? value.text
        : "…value";
  const [open, setOpen] = useState(now);
  useLayoutEffect(() => setOpen(now), [now]);
  const choose = (chosen: string) => {
    setOpen(chosen);
    if (chosen === "") {
      if (value) desk.edit((edits) => edits.remove(path));
    } else if (!chosen.startsWith("…")) write(path, JSON.stringify(chosen));
  };
  const compound = desk.guide.resolved(shape.compound),
    { description: _, ...rest } = schema;
  if (shape.scalar?.sort === "scalar" && !shape.words.length && open !== "…")
    return <Scalar {...props} shape={shape.scalar} />;
  return (
    <>
      <Row {...props}>
        <select id={`field ${address(path)}`} value={open} onChange={(event) => choose(event.currentTarget.value)}>
          <option value="">not given</option>
          {shape.words.map((word) => (
            <option value={word}>{word.replaceAll("_", " ")}</option>
          ))}
          {shape.scalar && <option value="…value">a number or text</option>}
          <option value="…">in detail</option>
        </select>
      </Row>
      {open === "…value" && shape.scalar?.sort === "scalar" && <Scalar {...props} name="value" shape={shape.scalar} />}
      {open === "…" && <Field {...props} schema={rest.$ref ? compound : { ...compound }} remove={false} />}
    </>
  );
}

export function Field(props: FieldProps): any {
  const { desk, path, schema, name } = props,
    shape = shapeOf(desk.guide, schema);
  const told = { ...props, schema: desk.guide.resolved(schema) };
  if (
    (name === "input" || name === "object") &&
    shape.sort === "scalar" &&
    /drives this one/.test(helpOf(told.schema))
  ) {
    const own = path[0] === "objects" ? String(path[1]) : "";
    return <Choice {...told} options={desk.outputs.filter((one) => one.split(".")[0] !== own)} />;
  }
  switch (shape.sort) {
    case "choice":
      return <Choice {...told} options={shape.options} />;
    case "flag":
      return <Choice {...told} write={(at, json) => props.write(at, JSON.parse(json))} options={["true", "false"]} />;
    case "scalar":
      return <Scalar {...told} shape={shape} />;
    case "map":
      return <MapOf {...told} inner={shape.inner} />;
    case "list":
      return shape.compound ? <ListOf {...told} inner={shape.inner} /> : <Raw {...told} />;
    case "either":
      return <Either {...told} shape={shape} />;
    case "group": {
      const inner = () => <Properties {...props} group={shape} />;
      if (!props.required && find(desk.root, path) === undefined && !faultsIn(desk, path).length)
        return (
          <More label={`add ${address(path)}`} title={shown(name)} help={helpOf(told.schema)}>
            {inner}
          </More>
        );
      return (
        <Section props={told} empty={null}>
          {inner()}
        </Section>
      );
    }
  }
}

// The properties of a group: those that are there or must be, the others on demand.
export function Properties({ desk, path, write, group, aside = [] }: Place & { group: Group; aside?: string[] }) {
  const value = find(desk.root, path),
    has = (name: string) => member(value, name) !== undefined;
  const present = group.variants.find(has),
    [chosen, setChosen] = useState(present ?? group.variants[0] ?? "");
  useLayoutEffect(() => {
    if (present) setChosen(present);
  }, [present]);
  const own = address(path);
  // What is filled in stands in place of what it excludes.
  const instead = (at: Step[], json: string) => {
    const old =
      present && present !== chosen && at.length > path.length && at[path.length] === chosen
        ? member(value, present)
        : undefined;
    if (!old) {
      write(at, json);
      return;
    }
    const inner = at
      .slice(path.length + 1)
      .reduceRight(
        (made, step) => (typeof step === "number" ? `[${made}]` : `{ ${JSON.stringify(step)}: ${made} }`),
        json,
      );
    desk.edit(() => [{ from: old.from, to: old.to, insert: `${JSON.stringify(chosen)}: ${inner}` }]);
  };
  const field = (name: string, required: boolean) => (
    <Field
      key={name}
      desk={desk}
      path={[...path, name]}
      write={name === chosen ? instead : write}
      schema={group.properties[name]!}
      name={name}
      required={required}
      remove
    />
  );
  const names = Object.keys(group.properties).filter(
    (name) => ![...ASIDE, ...aside].includes(name) && !group.variants.includes(name),
  );
  const order = (name: string) => value?.members.findIndex((one) => one.name === name) ?? -1;
  // While the others are shown nothing changes its place: what is filled in stays where it is.
  const [open, setOpen] = useState(() => !group.variants.length && !group.required.length && !names.some(has)),
    early = useRef<string[]>([]);
  const faulty = (name: string) => faultsIn(desk, [...path, name]).length > 0;
  if (!open) early.current = names.filter((name) => has(name) || faulty(name));
  const there = names
    .filter((name) => early.current.includes(name) || group.required.includes(name))
    .sort((a, b) => (has(a) ? order(a) : 1e3) - (has(b) ? order(b) : 1e3));
  const others = names.filter((name) => !there.includes(name));
  return (
    <>
      {group.variants.length > 1 && (
        <div class="field variant">
          <label for={`variant ${own}`}>by</label>
          <div class="entry">
            <select
              id={`variant ${own}`}
              aria-label={`${own}, by`}
              value={chosen}
              onChange={(event) => setChosen(event.currentTarget.value)}
            >
              {group.variants.map((name) => (
                <option value={name}>{shown(name)}</option>
              ))}
            </select>
          </div>
        </div>
      )}
      {group.variants.length > 0 && chosen && field(chosen, true)}
      {there.map((name) => field(name, group.required.includes(name)))}
      {others.length > 0 && (
        <More
          label={`more properties${own ? ` of ${own}` : ""}`}
          title="more properties"
          help={String(others.length)}
          open={open}
          toggle={setOpen}
        >
          {() => others.map((name) => field(name, false))}
        </More>
      )}
    </>
  );
}

// What is drawn once it is asked for.
function More({
  label,
  title,
  help,
  open = false,
  toggle,
  children,
}: {
  label: string;
  title: string;
  help: string;
  open?: boolean;
  toggle?: (open: boolean) => void;
  children: () => any;
}) {
  const [own, setOwn] = useState(false),
    seen = toggle ? open : own;
  return (
    <details class="more" open={seen} onToggle={(event) => (toggle ?? setOwn)(event.currentTarget.open)}>
      <summary aria-label={label}>
        {title} <span class="soft">{help}</span>
      </summary>
      {seen && children()}
    </details>
  );
}

// The form of an object.
export function ObjectForm({
  desk,
  id,
  kind,
  rename,
}: {
  desk: Desk;
  id: string;
  kind: string;
  rename: (other: string) => void;
}) {
  const path = ["objects", id],
    value = find(desk.root, path),
    schema = desk.guide.root.$defs?.[kind];
  const [typed, setTyped] = useState(id);
  useLayoutEffect(() => setTyped(id), [id]);
  const write = (at: Step[], json: string) => {
    desk.edit((edits) => edits.set(at, json));
  };
  const kinds: string[] = Object.keys(desk.guide.root.$defs ?? {}).filter(
    (name) => desk.guide.root.$defs[name].properties?.kind?.enum?.[0] === name,
  );
  if (!value) return null;
  const own = member(value, "kind");
  const group = schema ? groupOf(desk.guide, schema) : null;
  return (
    <form class="form" aria-label={`properties of ${id}`} onSubmit={(event) => event.preventDefault()}>
      <div class="field">
        <label for="object-name">name</label>
        <div class="entry">
          <input
            type="text"
            id="object-name"
            value={typed}
            spellcheck={false}
            onInput={(event) => setTyped(event.currentTarget.value)}
            onBlur={() => {
              if (typed !== id) rename(typed.trim());
            }}
            onKeyDown={(event) => {
              if (event.key === "Enter") event.currentTarget.blur();
            }}
          />
        </div>
      </div>
      <div class="field">
        <label for="object-kind">kind</label>
        <div class="entry">
          <select
            id="object-kind"
            value={kind}
            disabled={!own}
            onChange={(event) => write([...path, "kind"], JSON.stringify(event.currentTarget.value))}
          >
            {!kinds.includes(kind) && <option value={kind}>{own?.value.text || "choose…"}</option>}
            {kinds.map((one) => (
              <option value={one}>{one.replace("_", " ")}</option>
            ))}
          </select>
        </div>
        <p class="help always">
          {schema?.description ?? ""}
          {member(value, "from")
            ? ` Copied from ${member(value, "from")!.value.text}; what is given here replaces what stands there.`
            : ""}
        </p>
        <Told desk={desk} path={[...path, "kind"]} />
      </div>
      <Told desk={desk} path={path} />
      {group && (
        <Properties
          key={`${id} ${kind}`}
          desk={desk}
          path={path}
          write={write}
          group={member(value, "from") ? { ...group, required: [] } : group}
        />
      )}
    </form>
  );
}

// The form of what is no object: name, run, steady motion.
export function SceneForm({ desk }: { desk: Desk }) {
  const group = groupOf(desk.guide, desk.guide.root);
  const write = (at: Step[], json: string) => {
    desk.edit((edits) => edits.set(at, json));
  };
  return (
    <form class="form" aria-label="properties of the scene" onSubmit={(event) => event.preventDefault()}>
      <Properties desk={desk} path={[]} write={write} group={group} aside={["objects"]} />
    </form>
  );
}
