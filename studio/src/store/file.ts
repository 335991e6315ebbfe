// The file that is open, what is done with it, and the other files of its folder.

import { computed, signal } from "@preact/signals";
import type { Draft, SaidMessage } from "../messages";
import { link } from "./line";
import { clear, tell } from "./notices";
import { editor, isSettled } from "./text";

export interface Status {
  saved: boolean;
  undo: boolean;
  redo: boolean;
  // Of the file on the disk: "same", "changed" by another program or "gone"; and which text it had.
  disk: string;
  base: string;
}

export const folder = signal(""),
  scenes = signal<string[]>([]);
// The scene that is open; empty: none.
export const scene = signal("");
export const status = signal<Status>({ saved: true, undo: false, redo: false, disk: "same", base: "" });
export const draft = signal<Draft | null>(null);
export const isSaved = computed(() => status.value.saved && isSettled.value);

// Requests in words of the reader.
const DEEDS: Record<string, string> = {
  save: "saving",
  save_as: "saving",
  new: "new scene",
  open: "other scene",
  undo: "undoing",
  redo: "redoing",
  go_to: "other step",
};

// Asks the server for it once it has all edits; false: no server answers.
export function request(message: SaidMessage): boolean {
  clear("deed");
  if (!link.isOpen) {
    tell(`The server does not answer: there is no ${DEEDS[message.type] ?? "answer"} until it is back.`);
    return false;
  }
  editor.peek()!.when(() => link.send(message));
  return true;
}

export function saveAs(): void {
  const name = prompt("Name of the new file in this folder", scene.peek().replace(/\.json$/, "-2.json"));
  if (name) request({ type: "save_as", scene: name });
}

export function createScene(): void {
  const name = prompt("Name of the new scene in this folder", "scene.json");
  if (name) request({ type: "new", scene: name.endsWith(".json") ? name : `${name}.json` });
}

export function restoreDraft(): void {
  request({ type: "draft", restore: true });
}

export function discardDraft(): void {
  editor.peek()!.forgive();
  request({ type: "draft", restore: false });
}
