// A row of a form: name, entry, help and faults of a property; a section of several.

import { useState } from "preact/hooks";
import { address, find, type Step } from "../tree";
import { faultsAt, faultsIn, helpOf, shown, type Children, type Desk, type FieldProps } from "./desk";

// The faults at a property.
export function Faults({ desk, path }: { desk: Desk; path: Step[] }) {
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

export function Row({
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
}: FieldProps & { children: Children; wide?: boolean; why?: string }) {
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
        <Faults desk={desk} path={path} />
      )}
    </div>
  );
}

export function Section({ props, empty, children }: { props: FieldProps; empty: string | null; children: Children }) {
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
      <Faults desk={desk} path={path} />
      {children}
    </div>
  );
}

// What is drawn once it is asked for.
export function More({
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
  children: () => Children;
}) {
  const [own, setOwn] = useState(false),
    seen = toggle ? open : own;
  return (
    <details class="more" open={seen} onToggle={(event) => (toggle ?? setOwn)(event.currentTarget.open)}>
      <summary aria-label={`${title} ${help}: ${label}`}>
        {title} <span class="soft">{help}</span>
      </summary>
      {seen && children()}
    </details>
  );
}
