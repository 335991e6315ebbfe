// Completion and hover help, out of the schema that the program's own reading writes.

import type { Completion, CompletionContext, CompletionResult } from "@codemirror/autocomplete";
import { syntaxTree } from "@codemirror/language";
import type { EditorState } from "@codemirror/state";
import type { SyntaxNode } from "@lezer/common";

export interface Schema {
  $ref?: string;
  $defs?: Record<string, Schema>;
  type?: string;
  enum?: string[];
  const?: unknown;
  default?: unknown;
  description?: string;
  examples?: unknown[];
  anyOf?: Schema[];
  oneOf?: Schema[];
  allOf?: Schema[];
  then?: Schema;
  else?: Schema;
  properties?: Record<string, Schema>;
  patternProperties?: Record<string, Schema>;
  additionalProperties?: Schema | boolean;
  propertyNames?: { pattern?: string };
  items?: Schema;
  prefixItems?: Schema[];
  required?: string[];
}

const text = (state: EditorState, node: SyntaxNode): string => state.doc.sliceString(node.from, node.to);
function unquoted(state: EditorState, node: SyntaxNode): string {
  try {
    return String(JSON.parse(text(state, node)));
  } catch {
    return text(state, node).replace(/^"|"$/g, "");
  }
}
const nameOf = (state: EditorState, property: SyntaxNode): string => {
  const name = property.getChild("PropertyName");
  return name ? unquoted(state, name) : "";
};
const valueIn = (property: SyntaxNode): SyntaxNode | null => {
  const last = property.lastChild;
  return last && last.name !== "PropertyName" && !last.type.isError ? last : null;
};

// Steps from the top to a node: names and places in lists, with the nodes that they lead to.
function way(state: EditorState, node: SyntaxNode): { step: string | number; owner: SyntaxNode }[] {
  const steps: { step: string | number; owner: SyntaxNode }[] = [];
  for (let at: SyntaxNode | null = node; at?.parent; at = at.parent) {
    const owner: SyntaxNode = at.parent;
    if (at.name === "Property") steps.unshift({ step: nameOf(state, at), owner });
    else if (owner.name === "Array") {
      let index = 0;
      for (let before = at.prevSibling; before; before = before.prevSibling) if (/^[A-Z]/.test(before.name)) index++;
      steps.unshift({ step: index, owner });
    }
  }
  return steps;
}

export class Guide {
  constructor(readonly root: Schema) {}

  // What stands under a name.
  private named(reference: string): Schema | undefined {
    const inner = (at: unknown, part: string): unknown => (at as Record<string, unknown> | undefined)?.[part];
    return reference.replace("#/", "").split("/").reduce(inner, this.root) as Schema | undefined;
  }

  // A schema itself, where it stands elsewhere under a name; what is said of it here goes before.
  resolved(schema: Schema | undefined): Schema {
    if (!schema || typeof schema !== "object") return {};
    if (typeof schema.$ref !== "string") return schema;
    const target = this.named(schema.$ref);
    const { $ref: _, ...own } = schema;
    return { ...this.resolved(target), ...own };
  }

  // What a schema may be, alternatives apart.
  private forms(schema: Schema | undefined, depth = 0): Schema[] {
    if (!schema || typeof schema !== "object" || depth > 12) return [];
    const found: Schema[] = [];
    if (typeof schema.$ref === "string") {
      const target = this.named(schema.$ref);
      const described = schema.description ? { ...target, description: schema.description } : target;
      found.push(...this.forms(described, depth + 1));
    }
    for (const list of [schema.anyOf, schema.oneOf]) {
      for (const one of list ?? []) {
        for (const form of this.forms(one, depth + 1))
          found.push(schema.description && !form.description ? { ...form, description: schema.description } : form);
      }
    }
    for (const one of schema.allOf ?? []) found.push(...this.forms(one, depth + 1));
    for (const one of [schema.then, schema.else]) found.push(...this.forms(one, depth + 1));
    found.push(schema);
    return found;
  }

  // Forms of an object that what stands in it does not contradict.
  private fitting(state: EditorState, schema: Schema[], owner: SyntaxNode): Schema[] {
    const own = new Map(owner.getChildren("Property").map((one) => [nameOf(state, one), valueIn(one)]));
    return schema.filter((form) =>
      Object.entries(form.properties ?? {}).every(([name, inner]) => {
        const value = own.get(name);
        if (value?.name !== "String") return true;
        const given = unquoted(state, value);
        if (inner?.const !== undefined) return inner.const === given;
        return name !== "kind" || !Array.isArray(inner?.enum) || inner.enum.includes(given);
      }),
    );
  }

  private inner(form: Schema, step: string | number): Schema | undefined {
    if (typeof step === "number") return form.prefixItems?.[step] ?? form.items;
    const own = form.properties?.[step];
    if (own) return own;
    for (const [pattern, inner] of Object.entries(form.patternProperties ?? {}))
      if (new RegExp(pattern).test(step)) return inner as Schema;
    return typeof form.additionalProperties === "object" ? form.additionalProperties : undefined;
  }

  // Forms of the value at a node; of the object it is a property of, with `owner`.
  at(state: EditorState, node: SyntaxNode, owner = false): Schema[] {
    let forms = this.forms(this.root);
    const steps = way(state, node);
    for (const [index, { step, owner: object }] of steps.entries()) {
      if (typeof step === "string") forms = this.fitting(state, forms, object);
      if (owner && index === steps.length - 1) return forms;
      forms = forms.flatMap((form) => this.forms(this.inner(form, step)));
    }
    return forms;
  }

  hover(state: EditorState, position: number): { from: number; to: number; lines: string[] } | null {
    let node: SyntaxNode | null = syntaxTree(state).resolveInner(position, 0);
    while (node && node.name !== "Property" && node.name !== "JsonText") node = node.parent;
    if (node?.name !== "Property") return null;
    const lines = new Set<string>();
    for (const form of this.at(state, node)) {
      if (typeof form.description === "string") lines.add(form.description);
      if (form.default !== undefined) lines.add(`default ${JSON.stringify(form.default)}`);
    }
    const name = node.getChild("PropertyName");
    if (!lines.size || !name) return null;
    return { from: name.from, to: name.to, lines: [...lines].slice(0, 5) };
  }

  complete(context: CompletionContext): CompletionResult | null {
    const { state, pos } = context,
      node = syntaxTree(state).resolveInner(pos, -1);
    const property =
      node.name === "PropertyName" || node.name === "Property"
        ? node.name === "Property"
          ? node
          : node.parent!
        : null;
    const inValue =
      node.parent?.name === "Property" && node.name !== "PropertyName" && valueIn(node.parent)?.from === node.from;
    const after = /:\s*"?[^"{}[\],]*$/.test(state.sliceDoc(Math.max(0, pos - 60), pos));
    if (inValue || (property && after && node.name !== "PropertyName")) {
      const owner = inValue ? node.parent! : property!;
      const options = new Map<string, Completion>();
      for (const form of this.at(state, owner)) {
        const all = [
          ...(form.enum ?? []),
          ...(form.examples ?? []),
          ...(form.const === undefined ? [] : [form.const]),
          ...(form.type === "boolean" ? [true, false] : []),
        ];
        for (const one of all) options.set(JSON.stringify(one), { label: JSON.stringify(one), type: "enum" });
      }
      const value = valueIn(owner),
        from = value && value.from <= pos ? value.from : (context.matchBefore(/[^\s:]*/)?.from ?? pos);
      return options.size
        ? { from, to: value && value.from <= pos ? Math.max(pos, value.to) : pos, options: [...options.values()] }
        : null;
    }
    let object: SyntaxNode | null = node;
    while (object && object.name !== "Object") object = object.parent;
    if (!object || (!context.explicit && node.name !== "PropertyName")) return null;
    const there = new Set(object.getChildren("Property").map((one) => nameOf(state, one)));
    const inside = node.name === "PropertyName" ? node.parent! : object;
    const forms =
      node.name === "PropertyName"
        ? this.at(state, inside, true)
        : this.fitting(
            state,
            object.parent
              ? this.at(state, object.parent.name === "Property" ? object.parent : object)
              : this.forms(this.root),
            object,
          );
    const options = new Map<string, Completion>();
    for (const form of forms) {
      for (const [name, inner] of Object.entries(form.properties ?? {})) {
        if (there.has(name) && name !== (node.name === "PropertyName" ? unquoted(state, node) : "")) continue;
        const described = this.forms(inner).find((one) => one.description)?.description;
        const completion: Completion = {
          label: `"${name}"`,
          apply: node.name === "PropertyName" ? `"${name}"` : `"${name}": `,
          type: "property",
        };
        if (described) completion.info = described;
        options.set(name, completion);
      }
    }
    const from = node.name === "PropertyName" ? node.from : pos;
    return options.size ? { from, options: [...options.values()] } : null;
  }
}
