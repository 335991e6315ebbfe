"use strict";
// A map that answers: pointing at a cell tells its value, verdict and cause, a click
// keeps it and gives the command that runs it. The charts say which cell it is.
(() => {
  const data = JSON.parse(document.getElementById("map-data").textContent);
  const told = document.getElementById("cell"), command = document.getElementById("cell-command");
  const hint = told.textContent;
  let chosen = null;
  const quoted = (word) => /^[\w.=+:\/-]+$/.test(word) ? word : `'${word.replace(/'/g, "'\\''")}'`;
  const panelOf = (detail) => data.panels[+detail.plot.split(" ")[1]];

  function tell(at) {
    const panel = panelOf(at), index = at.index;
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

  document.addEventListener("cell", (event) => tell(event.detail));
  document.addEventListener("left", () => { if (chosen) tell(chosen); else told.textContent = hint; });
  document.addEventListener("chosen", (event) => {
    chosen = event.detail;
    tell(chosen);
    const settings = [...panelOf(chosen).settings, `${data.x.path}=${data.x.values[chosen.column]}`];
    if (data.y) settings.push(`${data.y.path}=${data.y.values[chosen.row]}`);
    command.textContent = [...data.command, ...settings.flatMap((setting) => ["--set", setting])].map(quoted).join(" ");
    command.hidden = false;
    const range = document.createRange();
    range.selectNodeContents(command);
    const selection = getSelection();
    selection.removeAllRanges();
    selection.addRange(range);
  });
})();
