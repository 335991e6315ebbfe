// The notice above the workbench: what was refused, or what is to be known of the file.

import { signal } from "@preact/signals";

// What a notice is about: it goes when that is another. What the user did is about the text and the
// file, a run about its answer.
export type About = "deed" | "run" | "file";

export const notice = signal<{ words: string; about: About } | null>(null);

export const tell = (words: string, about: About = "deed"): void => {
  notice.value = words ? { words, about } : null;
};

// Takes the notice away if it is about one of these.
export function clear(...about: About[]): void {
  const now = notice.peek();
  if (now && about.includes(now.about)) notice.value = null;
}
