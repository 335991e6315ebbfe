// The studio: text, numbers and answers of one scene, side by side.

import { render } from "preact";
import { useEffect, useReducer, useRef, useState } from "preact/hooks";
import { Board, type Answer } from "./answer";
import { Editor } from "./editor";
import { Host } from "./host";
import { Link, type Message } from "./link";
import { MapView } from "./map";
import { fields as fieldsOf, type Field, type Span } from "./numbers";
import { Sliders } from "./sliders";
import "./style.css";

const link = new Link();

interface Status { saved: boolean; undo: boolean; redo: boolean; disk: string }

// Addresses of the figures of a run: numbers, however deep they stand.
function figuresOf(objects: Record<string, any>): string[] {
  const found: string[] = [];
  const walk = (value: any, address: string) => {
    if (typeof value === "number") found.push(address);
    else if (value && typeof value === "object" && !Array.isArray(value)) for (const [name, inner] of Object.entries(value)) walk(inner, address ? `${address}.${name}` : name);
  };
  walk(objects, "");
  return found;
}

function Studio() {
  const place = useRef<HTMLElement>(null!), answers = useRef<HTMLElement>(null);
  const [tables, charts, moving] = [useRef<HTMLElement>(null!), useRef<HTMLElement>(null!), useRef<HTMLElement>(null!)];
  const editor = useRef<Editor | null>(null), board = useRef<Board | null>(null);
  const self = useRef("0"), spans = useRef(new Map<string, Span>());
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  const drawing = useRef(false);
  const [connected, setConnected] = useState(false);
  const [scenes, setScenes] = useState<string[]>([]);
  const [folder, setFolder] = useState("");
  const [scene, setScene] = useState("");
  const [status, setStatus] = useState<Status>({ saved: true, undo: false, redo: false, disk: "same" });
  const [draft, setDraft] = useState<{ time: number; other_base: boolean } | null>(null);
  const [faults, setFaults] = useState<any[]>([]);
  const [answer, setAnswer] = useState<Answer | null>(null);
  const [stale, setStale] = useState(false);
  const [told, setTold] = useState("");
  const wrong = useRef(false), current = useRef(""), latest = useRef<Answer | null>(null);

  useEffect(() => {
    const own = editor.current = new Editor(place.current!, link, () => self.current);
    const shown = board.current = new Board({ tables: tables.current!, charts: charts.current!, machine: moving.current! }, answers.current!);
    // Once a frame, however often the text changes.
    own.changed = () => {
      if (drawing.current) return;
      drawing.current = true;
      requestAnimationFrame(() => { drawing.current = false; redraw(0); });
    };
    link.state = setConnected;
    link.on("welcome", (message) => {
      self.current = message.window;
      setFolder(message.folder);
      void link.get("/api/scenes").then(({ scenes }) => {
        setScenes(scenes);
        const wanted = current.current || message.scene || scenes[0];
        if (wanted) link.send({ type: "open", scene: wanted });
        else setTold("There is no scene in this folder.");
      });
    });
    link.on("opened", (message) => {
      if (message.scene !== current.current) { spans.current.clear(); shown.clear(); latest.current = null; setAnswer(null); }
      current.current = message.scene;
      setScene(message.scene);
      document.title = `${message.scene} – dam studio`;
      setDraft(message.draft);
      setTold("");
      wrong.current = false;
      own.open(message);
    });
    link.on("status", (message) => {
      setStatus(message as unknown as Status);
      if (!message.draft) { setDraft(null); own.lock(false); }
    });
    link.on("checked", (message: Message) => {
      if (!own.check(message)) return;
      wrong.current = message.faults.some((fault: any) => fault.severity === "error");
      setFaults(message.faults);
      setStale(wrong.current);
    });
    link.on("failed", (message) => { setTold(message.message); setStale(true); });
    link.on("error", (message) => setTold(message.message));
    link.answer = (frame) => {
      const head = shown.show(frame);
      performance.mark("answer", { detail: head.version });
      requestAnimationFrame(() => link.send({ type: "shown" }));
      const before = latest.current;
      latest.current = head;
      setStale(wrong.current);
      // The sentence is drawn anew where it says something else.
      if (!before || JSON.stringify([before.verdict, before.warnings, before.coarse]) !== JSON.stringify([head.verdict, head.warnings, head.coarse])) setAnswer(head);
    };
    const keys = (event: KeyboardEvent) => {
      if (!(event.ctrlKey || event.metaKey) || place.current!.contains(event.target as Node)) return;
      const type = ({ z: event.shiftKey ? "redo" : "undo", y: "redo", s: "save" } as Record<string, string>)[event.key.toLowerCase()];
      if (!type) return;
      event.preventDefault();
      act(type);
    };
    addEventListener("keydown", keys);
    link.connect();
  }, []);

  const act = (type: string, more = {}) => editor.current!.when(() => link.send({ type, ...more }));
  const saveAs = () => {
    const name = prompt("Name of the new file in this folder", scene.replace(/\.json$/, "-2.json"));
    if (name) act("save_as", { scene: name });
  };
  const view = editor.current?.view;
  const fields: Field[] = view ? view.state.field(fieldsOf) : [];
  const errors = faults.filter((fault) => fault.severity === "error");
  const figures = latest.current ? figuresOf(latest.current.figures) : [];
  return (
    <div class="studio">
      <div key="top" class="top" role="toolbar" aria-label="scene">
        <strong>dam studio</strong>
        <label><span class="soft">{folder}/</span> <select aria-label="scene" value={scene} onChange={(event) => act("open", { scene: event.currentTarget.value })}>
          {scenes.concat(scene && !scenes.includes(scene) ? [scene] : []).map((one) => <option value={one}>{one}</option>)}
        </select></label>
        <span class={status.saved ? "soft" : "unsaved"} role="status">{status.saved ? "saved" : "not saved"}</span>
        <button type="button" onClick={() => act("save")} disabled={status.saved} title="Ctrl-S">Save</button>
        <button type="button" onClick={saveAs}>Save as…</button>
        <button type="button" onClick={() => act("undo")} disabled={!status.undo} title="Ctrl-Z">Undo</button>
        <button type="button" onClick={() => act("redo")} disabled={!status.redo} title="Ctrl-Y">Redo</button>
        {!connected && <span class="lost" role="alert">{link.known
          ? "The server is gone. What was not saved is kept as a draft: start dam studio again."
          : "This window was not opened by dam studio: run it, or open the address that --no-open prints."}</span>}
      </div>
      {(draft || status.disk !== "same" || told) && <div key="notices" class="notices">
        {draft && <p role="alert"><b>A draft of {new Date(1000 * draft.time).toLocaleString()} holds changes that were not saved.</b>
          {draft.other_base && " The file has been changed since."}
          <button type="button" onClick={() => act("draft", { restore: true })}>Restore the draft</button>
          <button type="button" onClick={() => act("draft", { restore: false })}>Discard it</button></p>}
        {status.disk === "changed" && <p role="alert"><b>The file was changed by another program.</b>
          <button type="button" onClick={() => act("reload")}>Reload it</button>
          <button type="button" onClick={() => act("keep_mine")}>Keep mine</button>
          <button type="button" onClick={saveAs}>Save as…</button></p>}
        {status.disk === "gone" && <p role="alert"><b>The file is gone.</b> Save writes it anew.</p>}
        {told && <p role="alert">{told} <button type="button" onClick={() => setTold("")}>Close</button></p>}
      </div>}
      <div key="panes" class="panes">
        <div class="left">
          <Host class="text-pane" of={(element) => { place.current = element; }} />
          <div class="faults" aria-label="faults" role="region">
            {faults.map((fault) => <button type="button" class={fault.severity} onClick={() => editor.current!.show(fault.from, fault.to)}>
              <b>{fault.severity}</b> {fault.path && <code>{fault.path}</code>} {fault.message}{fault.hints.length ? ` (${fault.hints.join("; ")})` : ""}</button>)}
          </div>
        </div>
        <div class="middle">{editor.current && <Sliders editor={editor.current} fields={fields} spans={spans.current} />}</div>
        <main class={`answers${stale ? " stale" : ""}`} ref={answers} aria-label="answers">
          {stale && <p key="stale" class="stale-mark" role="status">{errors.length
            ? `Stale: the text has ${errors.length} ${errors.length === 1 ? "fault" : "faults"}; this is the last good answer.` : "Stale: there is no answer to this text."}</p>}
          {answer && <p key="verdict" class={`verdict ${answer.verdict.sort}`}><span class="sort">{answer.coarse ? "First look, the model is still being judged" : "Answer"}</span>
            <b>{answer.verdict.headline}</b> {answer.verdict.text}</p>}
          {answer && answer.warnings.length > 0 && <ul key="warnings" class="warnings">{answer.warnings.map((one) => <li>{one}</li>)}</ul>}
          <div key="beside" class="beside">
            {editor.current && <MapView key="map" editor={editor.current} link={link} fields={fields} figures={figures} spans={spans.current} scene={scene} />}
            <Host key="machine" kind="section" class="machine" label="machine moving" of={(element) => { moving.current = element; }} />
          </div>
          <Host key="figures" kind="section" class="figures" label="figures" of={(element) => { tables.current = element; }} />
          <Host key="charts" kind="section" class="charts" label="charts" of={(element) => { charts.current = element; }} />
        </main>
      </div>
    </div>
  );
}

render(<Studio />, document.getElementById("studio")!);
