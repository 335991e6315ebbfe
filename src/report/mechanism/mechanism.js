// Moves a mechanism: play, pause, a slider for the position, arrows and paths on and off.
((id) => {
  "use strict";
  const figure = document.getElementById(id), data = JSON.parse(document.getElementById(`${id}-data`).textContent);
  const svg = figure.querySelector("svg"), controls = figure.querySelector(".controls");
  const links = [...svg.querySelectorAll("[data-link]")], pins = [...svg.querySelectorAll("[data-on]")];
  const sets = data.sets.map((_, index) => svg.querySelector(`[data-set="${index}"]`));
  const { values, times, closed } = data.axis, count = values.length;
  if (!count) return;
  let frame = 0, playing = false, last = null, clock = 0;

  const place = (node, x, y) => node.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
  function show(index) {
    frame = index;
    const flat = data.frames[index];
    for (const node of links) {
      const [x, y, c, s] = flat.slice(4 * node.dataset.link, 4 * node.dataset.link + 4);
      if (x === null) continue;
      node.setAttribute("transform", `matrix(${c} ${-s} ${s} ${c} ${x} ${y})`);
    }
    for (const node of pins) {
      const on = +node.dataset.on;
      if (on < 0) continue;
      const [px, py] = node.dataset.at.split(" ").map(Number), [x, y, c, s] = flat.slice(4 * on, 4 * on + 4);
      if (x !== null) place(node, x + c * px + s * py, y - s * px + c * py);
    }
    data.sets.forEach((set, index_of_set) => {
      const lines = sets[index_of_set].querySelectorAll("line");
      set.arrows.forEach((arrow, i) => {
        const [x, y, dx, dy] = arrow.slice(4 * index, 4 * index + 4), line = lines[i];
        const visible = x !== null && dx !== null && Math.hypot(dx, dy) >= 1;
        line.setAttribute("visibility", visible ? "inherit" : "hidden");
        if (!visible) return;
        line.setAttribute("x1", x); line.setAttribute("y1", y);
        line.setAttribute("x2", x + dx); line.setAttribute("y2", y + dy);
      });
    });
    slider.value = index;
    reading.textContent = `${data.axis.name} ${+values[index].toPrecision(6)} ${data.axis.unit}`.replace("-", "−");
  }

  // Where the times say nothing, positions follow each other evenly.
  const timed = times.length === count && times.every((t, i) => t !== null && (i === 0 || t >= times[i - 1])) && times[count - 1] > times[0];
  const at = (i) => timed ? (times[i] - times[0]) / (times[count - 1] - times[0]) : i / Math.max(1, count - 1);
  function step(now) {
    if (!playing) return;
    if (last !== null) clock += (now - last) / (1000 * 4 / +pace.value);
    last = now;
    if (clock > 1) { if (closed) clock %= 1; else { clock = 1; } }
    let low = 0, high = count - 1;
    while (low < high) { const middle = (low + high + 1) >> 1; if (at(middle) <= clock) low = middle; else high = middle - 1; }
    show(low);
    if (clock >= 1 && !closed) { toggle(); clock = 0; return; }
    requestAnimationFrame(step);
  }
  function toggle() {
    playing = !playing;
    button.textContent = playing ? "pause" : "play";
    if (playing) { clock = frame === count - 1 ? 0 : at(frame); last = null; requestAnimationFrame(step); }
  }

  const make = (name, properties) => { const node = Object.assign(document.createElement(name), properties); controls.appendChild(node); return node; };
  const button = make("button", { type: "button", textContent: "play" });
  button.addEventListener("click", toggle);
  const slider = make("input", { type: "range", min: 0, max: count - 1, step: 1, value: 0 });
  slider.setAttribute("aria-label", data.axis.name);
  slider.addEventListener("input", () => { if (playing) toggle(); show(+slider.value); });
  const reading = make("output", {});
  const pace = make("select", { title: "speed of playing" });
  pace.setAttribute("aria-label", "speed of playing");
  for (const [value, text] of [[0.25, "slow"], [1, "normal"], [4, "fast"]]) pace.add(new Option(text, value, value === 1, value === 1));
  const check = (text, shown, change) => {
    const label = make("label", {}), box = Object.assign(document.createElement("input"), { type: "checkbox", checked: shown });
    label.append(box, text);
    box.addEventListener("change", () => change(box.checked));
  };
  data.sets.forEach((set, index) => check(set.caption, set.shown, (on) => sets[index].setAttribute("visibility", on ? "visible" : "hidden")));
  if (data.paths.length) check("paths", true, (on) => svg.querySelectorAll("[data-path]").forEach((node) => node.setAttribute("visibility", on ? "visible" : "hidden")));
  show(0);
})
