// When text and answers are drawn: once a frame, however often they change. The first answer since
// a frame is drawn as it comes, so that the next frame has less to do.

import type { Editor } from "../editor";

// The text on the screen is behind for at most so long (ms).
const LATE = 150;

export class Frames {
  private isDue = false;
  private isChanged = false;
  private waiting: ArrayBuffer | null = null;
  private late: ReturnType<typeof setTimeout> | undefined;
  private isAhead = false;
  private isOwed = false;

  constructor(
    private readonly editor: Editor,
    private readonly draw: { text: () => void; answer: (frame: ArrayBuffer) => void },
    // Says that an answer was taken: the server sends the next.
    private readonly taken: () => void,
  ) {}

  changed(): void {
    this.isChanged = true;
    this.soon();
  }

  answered(frame: ArrayBuffer): void {
    // Of a window that nobody sees the server keeps the newest.
    if (document.hidden) {
      this.waiting = frame;
      this.isOwed = true;
      this.soon();
      return;
    }
    this.taken();
    if (this.isAhead) {
      this.waiting = frame;
      this.soon();
      return;
    }
    this.isAhead = true;
    requestAnimationFrame(() => {
      this.isAhead = false;
    });
    this.draw.answer(frame);
  }

  private soon(): void {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => this.frame());
  }

  private frame(): void {
    this.isDue = false;
    if (this.isChanged) {
      this.editor.flush(false);
      this.draw.text();
    }
    this.isChanged = false;
    if (this.editor.isBehind) {
      clearTimeout(this.late);
      this.late = setTimeout(() => this.editor.flush(), LATE);
    }
    if (this.waiting) {
      const newest = this.waiting;
      this.waiting = null;
      this.draw.answer(newest);
    }
    if (this.isOwed) {
      this.isOwed = false;
      this.taken();
    }
  }
}
