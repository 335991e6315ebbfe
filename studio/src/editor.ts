// The text in the window: CodeMirror, in step with the document on the server, which has the
// history. Edits go there one after the other; those of others come as they are made. The view has
// a state of its own, which follows: to read and draw the text anew is what takes long.
//
// A move of a slider changes that state and goes to the server at once. Text, numbers and
// charts are drawn once a frame; the text of a hundred moves a few times. `npm run latency`
// measures from the input event to the presented frame.

import {
  acceptCompletion,
  autocompletion,
  closeBrackets,
  closeBracketsKeymap,
  completionKeymap,
  startCompletion,
} from "@codemirror/autocomplete";
import { collab, getSyncedVersion, receiveUpdates, sendableUpdates } from "@codemirror/collab";
import { defaultKeymap, indentWithTab } from "@codemirror/commands";
import { json } from "@codemirror/lang-json";
import {
  bracketMatching,
  foldGutter,
  foldKeymap,
  HighlightStyle,
  indentOnInput,
  syntaxHighlighting,
} from "@codemirror/language";
import { lintGutter, lintKeymap, setDiagnostics, type Diagnostic } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import {
  Annotation,
  ChangeSet,
  Compartment,
  EditorState,
  Text,
  Transaction,
  type ChangeSpec,
  type TransactionSpec,
} from "@codemirror/state";
import {
  drawSelection,
  EditorView,
  highlightActiveLine,
  highlightActiveLineGutter,
  hoverTooltip,
  keymap,
  lineNumbers,
} from "@codemirror/view";
import { tags } from "@lezer/highlight";
import type { Link } from "./link";
import { difference, merged } from "./merge";
import type { Heard } from "./messages";
import { fields, setFields } from "./numbers";
import { Guide, type Schema } from "./schema";

const dragged = Annotation.define<number>();
// Marks what the view is told, and does not tell.
const outside = Annotation.define<boolean>();
// While a number moves, the text shows it so often (ms).
const REST = 120;
// So many messages with edits go out before the first of them is taken.
const AHEAD = 3;
// Most that a scene may be (bytes), that an edit inserts at once, and that the edits of a message
// are (characters): the server takes no larger message than a scene.
const LARGEST = 1 << 20,
  PIECE = 32_000,
  MESSAGE = 1 << 18;
const nonce = document.querySelector<HTMLMetaElement>("meta[name=nonce]")?.content ?? "";

const colours = HighlightStyle.define([
  { tag: tags.propertyName, color: "var(--link)" },
  { tag: tags.string, color: "var(--good)" },
  { tag: tags.number, color: "var(--accent)" },
  { tag: [tags.bool, tags.null], color: "var(--mechanism)" },
]);

const look = EditorView.theme({
  "&": { height: "100%", fontSize: "13px", backgroundColor: "var(--paper)", color: "var(--ink)" },
  ".cm-scroller": {
    fontFamily: "ui-monospace, 'SF Mono', Menlo, Consolas, 'DejaVu Sans Mono', monospace",
    lineHeight: "1.5",
  },
  ".cm-gutters": { backgroundColor: "var(--panel)", color: "var(--ink-soft)", border: "0" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "color-mix(in srgb, var(--link) 7%, transparent)" },
  "&.cm-focused .cm-cursor": { borderLeftColor: "var(--ink)" },
  ".cm-selectionBackground, &.cm-focused .cm-selectionBackground": {
    backgroundColor: "color-mix(in srgb, var(--link) 25%, transparent) !important",
  },
  ".cm-tooltip": {
    backgroundColor: "var(--panel)",
    color: "var(--ink)",
    border: "1px solid var(--line)",
    maxWidth: "60ch",
  },
  ".cm-tooltip-autocomplete ul li[aria-selected]": { backgroundColor: "var(--link)", color: "var(--paper)" },
  ".cm-panels": { backgroundColor: "var(--panel)", color: "var(--ink)" },
  ".cm-help": { padding: "4px 8px" },
});

const encoder = new TextEncoder();

function isTooLarge(doc: Text): boolean {
  if (3 * doc.length <= LARGEST) return false;
  let bytes = 0;
  for (const part of doc) bytes += encoder.encode(part).length;
  return bytes > LARGEST;
}

// Large insertions as several small ones, from the end on, so that places before stay right.
function pieces(changes: ChangeSet): ChangeSet[] {
  const all: { from: number; to: number; insert: Text }[] = [],
    made: ChangeSet[] = [];
  changes.iterChanges((from, to, _, __, insert) => {
    all.push({ from, to, insert });
  });
  if (all.every(({ insert }) => insert.length <= PIECE)) return [changes];
  let length = changes.length;
  const add = (from: number, to: number, insert: Text) => {
    const one = ChangeSet.of({ from, to, insert }, length);
    length = one.newLength;
    made.push(one);
  };
  for (const { from, to, insert } of all.reverse()) {
    let at = 0;
    do {
      let end = Math.min(at + PIECE, insert.length);
      // Both halves of a character go together.
      if (end < insert.length && /[\ud800-\udbff]/.test(insert.sliceString(end - 1, end))) end++;
      add(from + at, at ? from + at : to, insert.slice(at, end));
      at = end;
    } while (at < insert.length);
  }
  return made;
}

export class Editor {
  readonly view: EditorView;
  // The text as it is; the view comes after.
  state: EditorState;
  private behind: ChangeSet | null = null;
  private flushed = 0;
  // Messages with edits on the way, and how many edits are in them.
  private flying = 0;
  private sent = 0;
  private later: (() => void)[] = [];
  // The text as the server was last heard to have it, and which document that is.
  private heard = Text.empty;
  private epoch = "";
  // What is to be the text once it can be changed.
  private owed: string | null = null;
  private readonly writable = new Compartment();
  private schema: { at: number; guide: Promise<Guide> } | null = null;
  private scene = "";
  private drags = 0;
  private told = false;
  private locked = false;
  changed: () => void = () => {};
  // The text was changed, by whomever; what could not be.
  edited: () => void = () => {};
  refused: (words: string) => void = () => {};

  constructor(
    private readonly parent: Element,
    private readonly link: Link,
    private readonly by: () => string,
  ) {
    this.state = this.own("", 0);
    this.view = new EditorView({ parent, state: this.fresh(""), dispatchTransactions: (made) => this.typed(made) });
    // Whatever is done in the view is done to the text as it is.
    for (const kind of ["keydown", "beforeinput", "compositionstart", "mousedown", "paste", "cut", "drop", "focusin"])
      parent.addEventListener(kind, () => this.flush(), true);
    link.on("updates", (message) => this.receive(message));
    // Others came before: what is on the way is not taken, and goes out anew.
    link.on("late", () => {
      this.landed();
      this.sent = 0;
      this.push();
    });
  }

  // Says whether the view shows an older text.
  private say(): void {
    this.parent.setAttribute("aria-busy", String(this.behind !== null));
  }

  // Changes the text; the view comes after.
  private dispatch(spec: TransactionSpec): void {
    const made = this.state.update(spec);
    this.state = made.state;
    if (made.docChanged) {
      this.edited();
      this.behind = this.behind ? this.behind.compose(made.changes) : made.changes;
      this.say();
      this.push();
    }
    this.changed();
  }

  // Shows the text as it is; with `often` false not before what is shown is old.
  flush(often = true): void {
    if (!this.behind || (!often && performance.now() - this.flushed < REST)) return;
    const changes = this.behind;
    this.behind = null;
    this.say();
    this.flushed = performance.now();
    this.view.dispatch({ changes, annotations: [outside.of(true), Transaction.remote.of(true)] });
  }

  // Whether the view shows an older text.
  get isBehind(): boolean {
    return this.behind !== null;
  }

  // Changes made in the view, and what came from elsewhere since it was drawn.
  private typed(made: readonly Transaction[]): void {
    this.view.update(made);
    for (const one of made) {
      if (!one.docChanged || one.annotation(outside)) continue;
      const changes = this.behind ? one.changes.map(this.behind) : one.changes;
      this.behind = this.behind?.map(one.changes, true) ?? null;
      this.edited();
      const all = pieces(changes),
        drag = all.length > 1 ? [dragged.of(this.drag())] : [];
      for (const piece of all) this.state = this.state.update({ changes: piece, annotations: drag }).state;
      this.changed();
      this.push();
    }
  }

  // The text, its edits and its numbers.
  private own(text: string, version: number): EditorState {
    return EditorState.create({
      doc: text,
      extensions: [collab({ startVersion: version, clientID: this.by() }), fields],
    });
  }

  // What the view has of it.
  private fresh(text: string): EditorState {
    const step = (type: "undo" | "redo" | "save") => () => {
      this.when(() => this.link.send({ type }));
      return true;
    };
    return EditorState.create({
      doc: text,
      extensions: [
        EditorView.cspNonce.of(nonce),
        look,
        syntaxHighlighting(colours),
        lineNumbers(),
        foldGutter(),
        lintGutter(),
        highlightActiveLine(),
        highlightActiveLineGutter(),
        drawSelection(),
        bracketMatching(),
        closeBrackets(),
        indentOnInput(),
        highlightSelectionMatches(),
        json(),
        autocompletion({ override: [async (context) => (await this.guide()).complete(context)] }),
        hoverTooltip(async (view, position) => {
          const help = (await this.guide()).hover(view.state, position);
          if (!help) return null;
          return {
            pos: help.from,
            end: help.to,
            above: true,
            create: () => {
              const dom = document.createElement("div");
              dom.className = "cm-help";
              for (const line of help.lines) dom.appendChild(document.createElement("div")).textContent = line;
              return { dom };
            },
          };
        }),
        this.writable.of([]),
        EditorState.transactionFilter.of((made) => {
          const grows =
            made.docChanged &&
            made.newDoc.length > made.startState.doc.length &&
            made.annotation(outside) === undefined;
          if (!grows || !isTooLarge(made.newDoc)) return made;
          queueMicrotask(() => this.refuse());
          return [];
        }),
        keymap.of([
          { key: "Mod-z", run: step("undo"), preventDefault: true },
          { key: "Mod-y", mac: "Mod-Shift-z", run: step("redo"), preventDefault: true },
          { key: "Mod-Shift-z", run: step("redo"), preventDefault: true },
          { key: "Mod-s", run: step("save"), preventDefault: true },
          { key: "Tab", run: acceptCompletion },
          { key: "Mod-Space", run: startCompletion },
          ...closeBracketsKeymap,
          ...completionKeymap,
          ...searchKeymap,
          ...lintKeymap,
          ...foldKeymap,
          ...defaultKeymap,
          // Escape, then Tab leaves the text; Tab alone indents.
          indentWithTab,
        ]),
        EditorView.contentAttributes.of({ "aria-label": "text of the scene" }),
      ],
    });
  }

  // Another document, or the same anew.
  open(message: Heard["opened"]): void {
    this.flying = this.sent = 0;
    this.later = [];
    this.owed = null;
    this.epoch = message.epoch;
    this.scene = message.scene;
    this.schema = null;
    this.told = false;
    this.behind = null;
    this.say();
    this.state = this.own(message.text, message.version);
    this.heard = this.state.doc;
    this.view.setState(this.fresh(message.text));
    this.lock(message.draft !== null);
    this.changed();
  }

  private refuse(): void {
    this.refused("A scene has at most 1 MB: with this it would have more, so nothing was changed.");
  }

  // ---- the connection is lost and comes back

  // The document and the version that the window knows; null: none.
  get since(): { epoch: string; version: number } | null {
    return this.epoch ? { epoch: this.epoch, version: getSyncedVersion(this.state) } : null;
  }

  // What was on the way is not: it goes out anew, unless it turns out to have come.
  lost(): void {
    this.flying = this.sent = 0;
  }

  // The same document: what was edited elsewhere meanwhile.
  resume(message: Heard["updates"]): void {
    this.lost();
    this.receive(message);
  }

  // What a server that was started again does not have; null: it has all, as far as is known here.
  left(isSaved: boolean): { text: string; heard: string } | null {
    const text = this.state.doc.toString(),
      heard = this.heard.toString();
    return isSaved && text === heard ? null : { text, heard };
  }

  // Makes it the text of the document that was opened in its place, as soon as that can be changed:
  // where others have been there before, what both sides made of it. False: they changed the same.
  owe({ text, heard }: { text: string; heard: string }): boolean {
    const now = this.state.doc.toString(),
      isFirst = getSyncedVersion(this.state) === 0;
    const both = isFirst ? text : merged(heard, text, now);
    this.owed = both ?? text;
    this.pay();
    return both !== null;
  }

  // It is not wanted any more.
  forgive(): void {
    this.owed = null;
  }

  private pay(): void {
    const owed = this.owed;
    if (owed === null || this.locked) return;
    this.owed = null;
    const changes = difference(this.state.doc.toString(), owed);
    if (changes.insert || changes.to > changes.from) this.change(changes, this.drag());
  }

  // Whether nothing can be changed.
  lock(on: boolean): void {
    this.locked = on;
    this.view.dispatch({ effects: this.writable.reconfigure(on ? EditorState.readOnly.of(true) : []) });
    this.pay();
  }

  // A new step of undo, that the next edits with its number belong to.
  drag(): number {
    return ++this.drags;
  }

  // Changes the text from outside of it; false: it cannot be.
  change(changes: ChangeSpec, drag: number): boolean {
    if (this.locked) return false;
    const all = this.state.changes(changes);
    if (all.newLength > all.length && isTooLarge(all.apply(this.state.doc))) {
      this.refuse();
      return false;
    }
    for (const piece of pieces(all)) this.dispatch({ changes: piece, annotations: dragged.of(drag) });
    return true;
  }

  // Does something once the server has all edits.
  when(act: () => void): void {
    if (this.settled()) act();
    else this.later.push(act);
  }

  // Whether the server has all edits.
  get isSettled(): boolean {
    return this.settled();
  }

  private settled(): boolean {
    return sendableUpdates(this.state).length === 0;
  }

  // Whether as many edits are on the way as may be.
  get isBusy(): boolean {
    return this.flying >= AHEAD;
  }

  private landed(): void {
    this.flying = Math.max(0, this.flying - 1);
  }

  // Whether the text is that of a version.
  isAt(version: number): boolean {
    return this.settled() && getSyncedVersion(this.state) === version;
  }

  private push(): void {
    const updates = sendableUpdates(this.state),
      heard = getSyncedVersion(this.state),
      fresh = updates.slice(this.sent);
    if (!updates.length) {
      for (const act of this.later.splice(0)) act();
      return;
    }
    if (this.isBusy || !fresh.length) return;
    const next: { changes: unknown; drag: number | undefined }[] = [];
    let size = 0;
    for (const { changes, origin } of fresh) {
      const json = changes.toJSON();
      size += JSON.stringify(json).length;
      if (next.length && size > MESSAGE) break;
      next.push({ changes: json, drag: origin.annotation(dragged) });
    }
    if (!this.link.send({ type: "push", version: heard + this.sent, heard, updates: next })) return;
    this.flying++;
    this.sent += next.length;
    if (this.sent < updates.length) this.push();
  }

  private receive({ version, updates }: Heard["updates"]): void {
    const known = getSyncedVersion(this.state);
    const fresh = updates.slice(Math.max(0, known - version));
    for (const one of fresh) this.heard = ChangeSet.fromJSON(one.changes).apply(this.heard);
    const own = fresh.filter((one) => one.by === this.by()).length;
    if (own) {
      this.landed();
      this.sent = Math.max(0, this.sent - own);
    }
    if (fresh.length)
      this.dispatch(
        receiveUpdates(
          this.state,
          fresh.map((one) => ({ changes: ChangeSet.fromJSON(one.changes), clientID: one.by })),
        ),
      );
    this.push();
  }

  // What the server found in a version: it counts while that is the text.
  check({ version, numbers, faults }: Heard["checked"]): boolean {
    if (!this.isAt(version)) return false;
    const length = this.state.doc.length;
    const diagnostics: Diagnostic[] = faults.map((fault) => ({
      from: Math.min(fault.from, length),
      to: Math.min(Math.max(fault.to, fault.from), length),
      severity: fault.severity,
      message: [fault.elsewhere ? `${fault.elsewhere}: ${fault.message}` : fault.message, ...fault.hints].join("\n"),
    }));
    if (diagnostics.length || this.told) {
      this.flush();
      this.view.dispatch(setDiagnostics(this.view.state, diagnostics));
    }
    this.told = diagnostics.length > 0;
    if (numbers) this.dispatch({ effects: setFields.of(numbers) });
    return true;
  }

  // The schema of the scene, with its ids, as it was not long ago.
  guide(): Promise<Guide> {
    if (!this.schema || Date.now() - this.schema.at > 5000) {
      const guide = this.link
        .get<Schema>(`/api/schema?scene=${encodeURIComponent(this.scene)}`)
        .then((schema) => new Guide(schema));
      this.schema = { at: Date.now(), guide };
      guide.catch(() => {
        this.schema = null;
      });
    }
    return this.schema.guide;
  }

  show(from: number, to: number): void {
    this.flush();
    this.view.dispatch({
      selection: { anchor: from, head: to },
      effects: EditorView.scrollIntoView(from, { y: "center" }),
    });
    this.view.focus();
  }
}
