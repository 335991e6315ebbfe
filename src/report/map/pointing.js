"use strict";
// A map that answers: pointing at a cell tells its value, verdict and cause, a click
// keeps it and gives the command that runs it.
(() => {
  const data = JSON.parse(document.getElementById("map-data").textContent);
  const picture = document.querySelector(".map svg"), told = document.getElementById("cell"), command = document.getElementById("cell-command");
  const hint = told.textContent;
  const SVG = "http://www.w3.org/2000/svg";
  const mark = document.createElementNS(SVG, "rect"), kept = document.createElementNS(SVG, "rect");
  mark.setAttribute("class", "pointed");
  kept.setAttribute("class", "pointed kept");
  picture.append(mark, kept);
  let chosen = null;
  const columns = data.x.values.length, rows = data.y ? data.y.values.length : 1;
  const quoted = (word) => /^[\w.=+:\/-]+$/.test(word) ? word : `'${word.replace(/'/g, "'\\''")}'`;

  function found(event) {
    const frame = event.target.closest("[data-panel]");
    if (!frame) return null;
    const box = frame.getBoundingClientRect(), number = (name) => +frame.getAttribute(name);
    const share = (value, cells) => Math.min(cells - 1, Math.max(0, Math.floor(value * cells)));
    const column = share((event.clientX - box.left) / box.width, columns), row = share(1 - (event.clientY - box.top) / box.height, rows);
    const [w, h] = [number("width") / columns, number("height") / rows];
    return { panel: +frame.dataset.panel, column, row, x: number("x") + column * w, y: number("y") + (rows - 1 - row) * h, w, h };
  }

  function place(rect, at) {
    for (const [name, value] of [["x", at.x], ["y", at.y], ["width", at.w], ["height", at.h]]) rect.setAttribute(name, value);
    rect.setAttribute("visibility", "visible");
  }

  function tell(at) {
    const panel = data.panels[at.panel], index = at.row * columns + at.column;
    const where = [panel.label, `${data.x.path} = ${data.x.values[at.column]}`];
    if (data.y) where.push(`${data.y.path} = ${data.y.values[at.row]}`);
    const verdict = panel.verdicts[index];
    const line = (name, text) => {
      const row = document.createElement("div"), head = document.createElement("b");
      head.textContent = name;
      row.append(head, ` ${text}`);
      return row;
    };
    if (verdict === null) { told.replaceChildren(line("not worked out", where.filter(Boolean).join(", "))); return; }
    const value = panel.values[index];
    told.replaceChildren(
      line(`${data.figure} = ${value === null ? "–" : value}`, panel.undetermined.includes(index) ? `(not determined to ${data.digits} digits)` : ""),
      line(data.verdicts[verdict], data.causes[panel.causes[index]]),
      line("at", where.filter(Boolean).join(", ")),
    );
  }

  picture.addEventListener("pointermove", (event) => {
    const at = found(event);
    if (!at) return;
    place(mark, at);
    tell(at);
  });
  picture.addEventListener("pointerleave", () => {
    mark.setAttribute("visibility", "hidden");
    if (chosen) tell(chosen); else told.textContent = hint;
  });
  picture.addEventListener("click", (event) => {
    const at = found(event);
    if (!at) return;
    chosen = at;
    place(kept, at);
    tell(at);
    const settings = [...data.panels[at.panel].settings, `${data.x.path}=${data.x.values[at.column]}`];
    if (data.y) settings.push(`${data.y.path}=${data.y.values[at.row]}`);
    command.textContent = [...data.command, ...settings.flatMap((setting) => ["--set", setting])].map(quoted).join(" ");
    command.hidden = false;
    const range = document.createRange();
    range.selectNodeContents(command);
    const selection = getSelection();
    selection.removeAllRanges();
    selection.addRange(range);
  });
})();
