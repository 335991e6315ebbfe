// A picture that is moved and enlarged in its place: wheel, drag, keys and buttons; as a whole it
// fills the room that there is.

const LEAST = 0.5,
  MOST = 12,
  STEP = 1.25;
// A press that goes further than this drags (pixels).
const STILL = 4;

export class Sheet {
  readonly room = document.createElement("div");
  readonly content = document.createElement("div");
  private at = { x: 0, y: 0, k: 1 };
  private from: { x: number; y: number; at: { x: number; y: number; k: number } } | null = null;
  private isDragged = false;

  constructor(label: string) {
    this.room.className = "sheet-room";
    this.room.tabIndex = 0;
    this.room.setAttribute("role", "group");
    this.room.setAttribute("aria-label", `${label}: + and − enlarge, arrow keys move, 0 shows all of it`);
    this.content.className = "sheet-content";
    const tools = document.createElement("div");
    tools.className = "zoom";
    for (const [text, name, act] of [
      ["+", "enlarge", () => this.zoom(STEP)],
      ["−", "make smaller", () => this.zoom(1 / STEP)],
      ["Fit", "show all of it", () => this.fit()],
    ] as const) {
      const button = Object.assign(document.createElement("button"), {
        type: "button",
        textContent: text,
        title: name,
      });
      button.setAttribute("aria-label", text === "Fit" ? `Fit, ${name}` : name);
      button.addEventListener("click", act);
      tools.append(button);
    }
    this.room.append(this.content, tools);
    this.room.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.zoom(Math.exp(-Math.sign(event.deltaY) * 0.18), event);
      },
      { passive: false },
    );
    this.room.addEventListener("pointerdown", (event) => this.press(event));
    this.room.addEventListener("pointermove", (event) => this.drag(event));
    this.room.addEventListener("pointerup", () => {
      this.from = null;
    });
    this.room.addEventListener("pointercancel", () => {
      this.from = null;
    });
    // What was dragged is not clicked as well.
    this.room.addEventListener(
      "click",
      (event) => {
        if (this.isDragged) {
          event.stopPropagation();
          this.isDragged = false;
        }
      },
      true,
    );
    this.room.addEventListener("dblclick", (event) => {
      if (!(event.target as Element).closest("button")) this.fit();
    });
    this.room.addEventListener("keydown", (event) => this.keys(event));
  }

  private place(): void {
    const { x, y, k } = this.at;
    this.content.style.transform = k === 1 && x === 0 && y === 0 ? "" : `translate(${x}px, ${y}px) scale(${k})`;
  }
  fit(): void {
    this.at = { x: 0, y: 0, k: 1 };
    this.place();
  }

  private zoom(factor: number, event?: MouseEvent): void {
    const box = this.room.getBoundingClientRect(),
      { x, y, k } = this.at,
      next = Math.min(MOST, Math.max(LEAST, k * factor));
    const px = event ? event.clientX - box.left : box.width / 2,
      py = event ? event.clientY - box.top : box.height / 2;
    this.at = { k: next, x: px - ((px - x) * next) / k, y: py - ((py - y) * next) / k };
    this.place();
  }
  private press(event: PointerEvent): void {
    if (event.button !== 0 || (event.target as Element).closest("button")) return;
    this.isDragged = false;
    this.from = { x: event.clientX, y: event.clientY, at: { ...this.at } };
  }
  private drag(event: PointerEvent): void {
    if (!this.from) return;
    const dx = event.clientX - this.from.x,
      dy = event.clientY - this.from.y;
    if (!this.isDragged && Math.hypot(dx, dy) < STILL) return;
    if (!this.isDragged) this.room.setPointerCapture(event.pointerId);
    this.isDragged = true;
    this.at = { ...this.from.at, x: this.from.at.x + dx, y: this.from.at.y + dy };
    this.place();
  }
  private keys(event: KeyboardEvent): void {
    if (event.target !== this.room || event.ctrlKey || event.metaKey || event.altKey) return;
    const by = (
      { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] } as Record<
        string,
        [number, number]
      >
    )[event.key];
    if (by) {
      this.at = { ...this.at, x: this.at.x + by[0], y: this.at.y + by[1] };
      this.place();
    } else if (event.key === "+" || event.key === "=") this.zoom(STEP);
    else if (event.key === "-") this.zoom(1 / STEP);
    else if (event.key === "0") this.fit();
    else return;
    event.preventDefault();
  }
}
