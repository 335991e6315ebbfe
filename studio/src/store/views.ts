// What is looked at: first page or workbench, which views and tabs, which objects.

import { effect, signal } from "@preact/signals";
import { Kept, shownScene } from "../link";
import type { Show } from "../tour";
import { scene } from "./file";
import { type Found, objects } from "./findings";
import { tell } from "./notices";
import { board, chosenCharts } from "./run";
import { edit, editor, redraw } from "./text";

export const VIEWS = [
  ["objects", "Objects"],
  ["drawing", "Drawing"],
  ["text", "Text"],
  ["model", "Dynamic model"],
  ["equations", "Equations"],
] as const;
export type View = (typeof VIEWS)[number][0];

// The workbench, and what the run found in tables: the tabs that are no questions.
export const BENCH = "Workbench",
  RESULTS = "Results";

export const isHome = signal(false),
  isTouring = signal(false);
// Whether the tour was taken or ended.
export const seen = new Kept("tour");
export const view = signal<View>("objects");
export const side = signal<"numbers" | "properties">("numbers");
// A question, the workbench or the results.
export const tab = signal<string>(BENCH);
effect(() => board.value?.results(tab.value === RESULTS));
// Objects that are selected in the graph.
export const selection = signal<string[]>([]);

export function goHome(): void {
  isHome.value = true;
  shownScene.set("");
  document.title = "dam studio";
}

export function enterScene(): void {
  isHome.value = false;
  shownScene.set(scene.peek());
  document.title = `${scene.peek()} – dam studio`;
}

export function lookAt(next: View): void {
  view.value = next;
  if (next === "text") {
    editor.peek()!.flush();
    requestAnimationFrame(() => editor.peek()!.view.requestMeasure());
  }
}

// Brings a part of the page into sight, for the tour.
export const bring: Show = (part) => {
  if (part === "home") {
    goHome();
    return;
  }
  enterScene();
  tab.value = part === "results" ? RESULTS : BENCH;
  if (part === "numbers") side.value = "numbers";
  else if (part === "objects" || part === "equations" || part === "text") lookAt(part);
};

export function select(ids: string[]): void {
  selection.value = ids;
  if (ids.length === 1) chosenCharts.value = ids[0]!;
  side.value = "properties";
}

// The object that was clicked in the machine or in a table: its charts, and the graph shows it.
export function lookAtObject(id: string): void {
  tab.value = BENCH;
  chosenCharts.value = id;
  if (objects.peek().some((one) => one.id === id)) selection.value = [id];
}

export function lookAtFault(fault: Found): void {
  const mark = () => editor.peek()!.show(fault.from, fault.to);
  if (view.peek() === "text") {
    mark();
    return;
  }
  const id = fault.path.split(/[.[]/)[0]!;
  if (view.peek() === "objects") select(objects.peek().some((one) => one.id === id) ? [id] : []);
  else {
    lookAt("text");
    requestAnimationFrame(mark);
  }
}

// Gives an object another name, wherever it is named.
export function rename(id: string, other: string): void {
  const why = !/^[A-Za-z_][A-Za-z0-9_-]*$/.test(other)
    ? `“${other}” is no name: letters, digits, _ and - are, and a letter comes first.`
    : objects.peek().some((one) => one.id === other)
      ? `There is an object ${other} already.`
      : null;
  if (why !== null) {
    tell(why);
    redraw();
  } else if (edit((edits) => edits.rename(id, other)))
    selection.value = selection.peek().map((one) => (one === id ? other : one));
}
