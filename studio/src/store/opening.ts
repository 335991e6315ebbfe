// What the server says of connection, scene and file: a scene is opened, comes back after the
// connection was lost, or is changed by others.

import { batch } from "@preact/signals";
import type { Editor } from "../editor";
import { shownScene } from "../link";
import type { Heard } from "../messages";
import type { Parts } from "../kinds";
import { offered as unitsOffered } from "../units";
import { draft, folder, scene, scenes, status } from "./file";
import type { Hearing } from "../asking";
import { check, faults, guide, isFaulty, newest, NO_PARTS, objects, parts } from "./findings";
import { offered as layoutOffered } from "./layout";
import { isConnected, link, program, self } from "./line";
import { clear, tell } from "./notices";
import { board, forget, isStale, openings } from "./run";
import { editor, redraw, spans } from "./text";
import { enterScene, isHome, seen, selection } from "./views";

// The scene is opened again, since the connection was lost: the page stays where it is.
let isAgain = false;
// The text that the file had before the server was started again; null: it was not, or all is well.
let baseBefore: string | null = null;
// Those that hear of a version that was checked, at little cost.
export const hearing: Hearing = { checked: () => {}, ask: () => {} };

function welcome(message: Heard["welcome"]): void {
  self.value = message.window;
  folder.value = message.folder;
  program.value = message.program;
  seen.offer(message.settings);
  layoutOffered(message.settings);
  if (unitsOffered(message.settings)) unitsChanged();
  const open = () => {
    isAgain = scene.peek() !== "";
    const wanted = scene.peek() || (shownScene.get() ?? message.scene),
      { since } = editor.peek()!;
    if (wanted) link.send({ type: "open", scene: wanted, ...(isAgain && since ? { since } : {}) });
    else isHome.value = true;
  };
  const listed = link.get<{ scenes: string[] }>("/api/scenes").then(
    (found) => {
      scenes.value = found.scenes;
    },
    // Those that are known stay.
    () => {},
  );
  void listed.then(open);
}

// Everything is shown in other units.
export function unitsChanged(): void {
  board.peek()?.again();
  redraw();
}

function resumed(message: Heard["resumed"]): void {
  isAgain = false;
  editor.peek()!.resume(message);
  askParts();
  openings.value = openings.peek() + 1;
}

// What objects can be made of, unless it is known: a server that went away may have owed it.
function askParts(): void {
  const name = scene.peek();
  if (parts.peek() !== NO_PARTS) return;
  void link.get<Parts>(`/api/parts?scene=${encodeURIComponent(name)}`).then(
    (found) => {
      if (name === scene.peek()) parts.value = found;
    },
    () => {},
  );
}

// Nothing of the scene before stays.
function begin(name: string): void {
  objects.value = [];
  selection.value = [];
  faults.value = [];
  parts.value = NO_PARTS;
  if (!scenes.peek().includes(name)) scenes.value = [...scenes.peek(), name].sort();
  spans.clear();
  forget();
}

// What a server that was started again does not have is owed to it.
function owe(own: Editor, message: Heard["opened"], left: { text: string; heard: string } | null): void {
  // The draft is an older text of this window, unless the file has been changed since.
  const isOlder = left !== null && message.draft !== null && !message.draft.other_base;
  draft.value = isOlder ? null : message.draft;
  if (isOlder) link.send({ type: "draft", restore: true });
  baseBefore = left ? status.peek().base : null;
  if (left && !own.owe(left))
    tell("Another window changed the same lines while the server was away. Undo shows them.", "file");
}

function opened(message: Heard["opened"]): void {
  const own = editor.peek()!,
    isOther = message.scene !== scene.peek(),
    left = isAgain && !isOther ? own.left(status.peek().saved) : null;
  if (isOther) begin(message.scene);
  scene.value = message.scene;
  askParts();
  if (!isAgain) enterScene();
  isAgain = false;
  tell("");
  isFaulty.value = false;
  own.open(message);
  redraw();
  owe(own, message, left);
  openings.value = openings.peek() + 1;
  void own.guide().then(
    (found) => {
      guide.value = found;
    },
    () => {},
  );
}

function statusChanged(message: Heard["status"]): void {
  const now = message;
  if (JSON.stringify(now) !== JSON.stringify(status.peek())) clear("deed");
  if (now.saved) clear("file");
  status.value = now;
  if (baseBefore !== null && baseBefore !== now.base)
    tell(
      "The file was changed while the server was away. Undo shows the file as it is now, Save writes over it.",
      "file",
    );
  baseBefore = null;
  if (!now.draft) {
    draft.value = null;
    editor.peek()!.lock(false);
  }
}

function refused(message: Heard["error"]): void {
  tell(message.message);
  isAgain = false;
  if (!scene.peek()) isHome.value = true;
}

function checked(message: Heard["checked"]): void {
  if (!check(message)) return;
  isStale.value = isFaulty.peek();
  hearing.checked(newest.peek());
}

function failed(message: Heard["failed"]): void {
  tell(message.message, "run");
  isStale.value = true;
}

// Hears the server from now on.
export function listen(): void {
  link.state = (isOpen) => {
    isConnected.value = isOpen;
    if (isOpen) clear("deed");
    else editor.peek()!.lost();
  };
  const hear = <K extends keyof Heard>(type: K, act: (message: Heard[K]) => void) =>
    link.on(type, (message) => batch(() => act(message)));
  hear("welcome", welcome);
  hear("resumed", resumed);
  hear("opened", opened);
  hear("status", statusChanged);
  hear("checked", checked);
  hear("failed", failed);
  hear("error", refused);
}
