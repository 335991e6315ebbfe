"use strict";
// Plots of the report: one group of plots an object, sharing one time axis.
// Drag: zoom to a range; wheel: zoom about the pointer; double click: everything.
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const SVG = "http://www.w3.org/2000/svg";
  const LEFT = 64, RIGHT = 14, TOP = 28, BOTTOM = 24;
  const DASHES = ["", "7 3", "2 2.5", "9 3 2 3", "4 2", "12 4", "1.5 3.5", "6 2 1 2 1 2"];
  const PREFIXES = { "-12": "p", "-9": "n", "-6": "µ", "-3": "m", 0: "", 3: "k", 6: "M", 9: "G" };
  const TAKE_ALL = ["N", "J", "W", "Pa", "Hz", "Nm"], TAKE_SMALL = ["s", "m", "rad"];
  const machine = document.querySelector("figure.moving") !== null;
  let printing = false;
  // The instant that all cursors and the machine stand at; null: none is shown.
  let instant = null;

  // ---- numbers -------------------------------------------------------------
  const superscript = (n) => String(n).replace(/./g, (c) => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[+c]);
  const minus = (text) => text.replace(/-/g, "−");

  // As `scale` of quantity.rs: small prefixes of a kilogram stand before the gram.
  function scaleFor(magnitude, unit) {
    if (!(magnitude > 0) || !isFinite(magnitude) || !unit || unit.startsWith("1")) return { factor: 1, unit };
    let exponent = Math.floor((Math.log10(magnitude) + 1e-9) / 3) * 3;
    const first = unit.split(/[ /]/)[0], gram = first === "kg", all = TAKE_ALL.includes(first);
    const some = all || gram || TAKE_SMALL.includes(first);
    if ((!all && exponent === 3) || (!some && exponent === -3)) exponent = 0;
    const factor = 10 ** exponent;
    if (exponent === 0) return { factor, unit };
    const prefix = all || (some && exponent < 0) ? PREFIXES[gram ? exponent + 3 : exponent] : undefined;
    if (prefix === undefined) return { factor, unit: `10${superscript(exponent)} ${unit}` };
    return { factor, unit: prefix + (gram ? unit.slice(1) : unit) };
  }

  function significant(value, digits) {
    if (value === 0) return "0";
    const exponent = Math.floor(Math.log10(Math.abs(value)));
    if (exponent >= -4 && exponent < 7) return minus(String(+value.toPrecision(digits)));
    const [mantissa, power] = value.toExponential(digits - 1).split("e");
    return `${minus(String(+mantissa))}·10${superscript(+power)}`;
  }

  function withUnit(value, unit, digits) {
    const scale = scaleFor(Math.abs(value), unit);
    return `${significant(value / scale.factor, digits)}${scale.unit.startsWith("10") ? "·" : " "}${scale.unit}`;
  }

  function ticks(low, high, count) {
    const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
    const step = ([1, 2, 5].find((f) => raw <= f * power * (1 + 1e-9)) || 10) * power;
    const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9);
    const decimals = Math.min(17, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
    const list = [];
    for (let i = first; i <= last && list.length < 40; i++) {
      const text = (i * step).toFixed(decimals);
      list.push([i * step, minus(/[1-9]/.test(text) ? text : text.replace("-", ""))]);
    }
    return list;
  }

  // First index with times[index] >= t.
  function lowerBound(times, t) {
    let low = 0, high = times.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (times[middle] < t) low = middle + 1; else high = middle;
    }
    return low;
  }

  function nearest(times, t) {
    const i = lowerBound(times, t);
    if (i <= 0) return 0;
    if (i >= times.length) return times.length - 1;
    return t - times[i - 1] <= times[i] - t ? i - 1 : i;
  }

  // ---- drawing -------------------------------------------------------------
  function add(parent, name, attributes, text) {
    const node = document.createElementNS(SVG, name);
    for (const key in attributes) node.setAttribute(key, attributes[key]);
    if (text !== undefined) node.textContent = text;
    parent.appendChild(node);
    return node;
  }

  // Visible samples of a series: indices from one before to one after the range.
  function span(times, range) {
    return [Math.max(0, lowerBound(times, range[0]) - 1), Math.min(times.length - 1, lowerBound(times, range[1]))];
  }

  function valueRange(panel, range) {
    let low = Infinity, high = -Infinity;
    for (const series of panel.series) {
      const [from, to] = span(data.times[series.run], range);
      for (let i = from; i <= to; i++) {
        const v = series.values[i];
        if (v === null) continue;
        if (v < low) low = v;
        if (v > high) high = v;
      }
    }
    if (low > high) return [-1, 1];
    const size = Math.max(Math.abs(low), Math.abs(high));
    // What moves by less than rounding is drawn as the constant that it is.
    if (high - low <= 1e-9 * size || size === 0) { const pad = size > 0 ? size * 0.1 : 1; return [low - pad, high + pad]; }
    const pad = 0.07 * (high - low);
    return [low - pad, high + pad];
  }

  // Path of a series; where samples are denser than pixels, each pixel column
  // keeps its first, least, greatest and last value, so that no peak is lost.
  function path(series, range, x, y, width) {
    const times = data.times[series.run], values = series.values;
    const [from, to] = span(times, range);
    const parts = [];
    let pen = false;
    const point = (i) => {
      if (values[i] === null) { pen = false; return; }
      parts.push(`${pen ? "L" : "M"}${x(times[i]).toFixed(2)} ${y(values[i]).toFixed(2)}`);
      pen = true;
    };
    if (to - from < 3 * width) {
      for (let i = from; i <= to; i++) point(i);
      return parts.join("");
    }
    for (let i = from; i <= to;) {
      const column = Math.floor(x(times[i]));
      let end = i, low = i, high = i;
      while (end + 1 <= to && Math.floor(x(times[end + 1])) === column) {
        end++;
        if (values[end] < values[low]) low = end;
        if (values[end] > values[high]) high = end;
      }
      [...new Set([i, Math.min(low, high), Math.max(low, high), end])].forEach(point);
      i = end + 1;
    }
    return parts.join("");
  }

  // Intervals in which a pair is open: the whole height for one run, a strip
  // at the foot for each of several.
  function drawShades(svg, group, range, x, width, height, clip) {
    const many = data.runs.length > 1;
    for (const shade of group.shades) {
      let from = null, to = null, d = "";
      const strip = many ? 5 : height;
      const top = many ? TOP + height - 6 * (data.runs.length - shade.run) : TOP;
      const flush = () => { if (from !== null) d += `M${from.toFixed(2)} ${top}h${Math.max(0.6, to - from).toFixed(2)}v${strip}H${from.toFixed(2)}z`; };
      for (const [a, b] of shade.intervals) {
        if (b < range[0] || a > range[1]) continue;
        const left = Math.max(x(a), LEFT), right = Math.min(x(b), LEFT + width);
        if (from !== null && left - to < 0.4) { to = Math.max(to, right); continue; }
        flush();
        from = left; to = right;
      }
      flush();
      const style = many ? `fill:var(--series-${shade.run % 8});opacity:.55` : "";
      if (d) add(svg, "path", { d, class: "open", style, "clip-path": clip });
    }
  }

  let identities = 0;

  function drawPlot(group, panel) {
    const holder = panel.holder;
    const total = Math.max(260, printing ? 700 : holder.clientWidth);
    const tall = data.runs.length > 1 || group.panels.length === 1 ? 260 : 186;
    const height = (printing ? Math.min(tall, 215) : tall) - TOP - BOTTOM;
    const width = total - LEFT - RIGHT;
    const range = group.range;
    let [low, high] = valueRange(panel, range);
    // Room under the curves for the strips of several runs.
    const strips = data.runs.length > 1 && group.shades.some((shade) => shade.intervals.length);
    if (strips) low -= (high - low) * (6 * data.runs.length + 2) / height;
    const scale = scaleFor(Math.max(Math.abs(low), Math.abs(high)) * 0.93, panel.unit);
    const timeScale = scaleFor(Math.max(Math.abs(range[0]), Math.abs(range[1])), "s");
    const x = (t) => LEFT + (t - range[0]) / (range[1] - range[0]) * width;
    const y = (v) => TOP + (high - v) / (high - low) * height;
    const svg = document.createElementNS(SVG, "svg");
    svg.setAttribute("viewBox", `0 0 ${total} ${TOP + height + BOTTOM}`);
    svg.setAttribute("role", "img");
    svg.setAttribute("aria-label", `${group.id}: ${panel.name} over time`);
    const clipId = `clip-${identities++}`;
    add(add(add(svg, "defs", {}), "clipPath", { id: clipId }), "rect", { x: LEFT, y: TOP, width, height });
    const clip = `url(#${clipId})`;
    drawShades(svg, group, range, x, width, height, clip);

    for (const [value, label] of ticks(low / scale.factor, high / scale.factor, Math.max(2, height / 26))) {
      const at = y(value * scale.factor);
      add(svg, "line", { x1: LEFT, x2: LEFT + width, y1: at, y2: at, class: value === 0 ? "zero" : "gridline" });
      add(svg, "text", { x: LEFT - 7, y: at + 4, "text-anchor": "end" }, label);
    }
    for (const [value, label] of ticks(range[0] / timeScale.factor, range[1] / timeScale.factor, Math.max(2, width / 90))) {
      const at = x(value * timeScale.factor);
      add(svg, "line", { x1: at, x2: at, y1: TOP, y2: TOP + height, class: "gridline" });
      const half = label.length * 3.6;
      add(svg, "text", { x: Math.min(at, total - half), y: TOP + height + 16, "text-anchor": "middle" }, label);
    }
    add(svg, "text", { x: 2, y: TOP + height + 16 }, `t, ${timeScale.unit}`);
    add(svg, "path", { class: "axis frame", d: `M${LEFT} ${TOP}V${TOP + height}H${LEFT + width}` });
    const title = add(svg, "text", { x: LEFT, y: 17, class: "title" }, panel.name);
    add(title, "tspan", { class: "unit" }, `, ${scale.unit}`);
    for (const series of panel.series) {
      add(svg, "path", {
        class: "curve", d: path(series, range, x, y, width), "clip-path": clip,
        style: `stroke:var(--series-${series.run % 8})`,
        "stroke-dasharray": data.runs.length > 1 ? DASHES[series.run % 8] : "",
      });
    }
    panel.pointer = add(svg, "line", { class: "pointer", y1: TOP, y2: TOP + height, visibility: "hidden" });
    panel.dots = panel.series.map((series) => add(svg, "circle", { r: 3.2, style: `fill:var(--series-${series.run % 8})`, visibility: "hidden" }));
    panel.reading = add(svg, "text", { class: "reading", x: LEFT + width, y: 17, "text-anchor": "end" });
    panel.selection = add(svg, "rect", { class: "selection", y: TOP, height, visibility: "hidden" });
    panel.geometry = { x, y, low, high, width, total, factor: scale.factor, titleEnd: LEFT + (panel.name.length + scale.unit.length + 2) * 7.4 };
    listen(svg, group, panel);
    holder.replaceChildren(svg);
  }

  function draw(group) {
    group.panels.forEach((panel) => drawPlot(group, panel));
    const whole = group.range[0] === group.whole[0] && group.range[1] === group.whole[1];
    if (group.reset) group.reset.disabled = whole;
    if (instant !== null) showPointer(group, instant);
  }

  // ---- reading and zooming -------------------------------------------------
  function showPointer(group, time) {
    for (const panel of group.panels) {
      const { x, y, low, high, width, factor, titleEnd } = panel.geometry;
      const readings = [];
      let at = null;
      panel.series.forEach((series, place) => {
        const times = data.times[series.run];
        const i = nearest(times, time), v = series.values[i];
        const visible = v !== null && times[i] >= group.range[0] && times[i] <= group.range[1] && v >= low && v <= high;
        panel.dots[place].setAttribute("visibility", visible ? "visible" : "hidden");
        if (v === null) return;
        panel.dots[place].setAttribute("cx", x(times[i]));
        panel.dots[place].setAttribute("cy", y(v));
        if (at === null) at = times[i];
        readings.push([series.run, withUnit(v, panel.unit, 6)]);
      });
      if (at === null) continue;
      if (x(time) < LEFT - 1 || x(time) > LEFT + width + 1) { panel.pointer.setAttribute("visibility", "hidden"); panel.reading.replaceChildren(); continue; }
      const place = Math.min(Math.max(x(at), LEFT), LEFT + width);
      panel.pointer.setAttribute("x1", place);
      panel.pointer.setAttribute("x2", place);
      panel.pointer.setAttribute("visibility", "visible");
      panel.reading.replaceChildren();
      const time_text = `t = ${withUnit(at, "s", 6)}`;
      const all = [time_text, ...readings.map((r) => r[1])].join("   ");
      if (titleEnd + all.length * 6.6 < LEFT + width) add(panel.reading, "tspan", {}, time_text);
      let room = width + LEFT - titleEnd;
      for (const [run, text] of readings) {
        room -= (text.length + 3) * 6.6;
        if (room < 0 && run > 0) break;
        add(panel.reading, "tspan", { dx: 12, style: data.runs.length > 1 ? `fill:var(--series-${run % 8})` : "" }, text);
      }
    }
  }

  function hidePointer(group) {
    for (const panel of group.panels) {
      panel.pointer.setAttribute("visibility", "hidden");
      panel.dots.forEach((dot) => dot.setAttribute("visibility", "hidden"));
      panel.reading.replaceChildren();
    }
  }

  // All cursors go together, and the machine with them.
  function tell(time) {
    if (machine && time !== null) document.dispatchEvent(new CustomEvent("instant", { detail: { time, by: "plots" } }));
    else standAt(time);
  }

  function standAt(time) {
    instant = time;
    data.groups.forEach((group) => { if (time === null) hidePointer(group); else showPointer(group, time); });
  }
  document.addEventListener("instant", (event) => standAt(event.detail.time));

  function zoom(group, from, to) {
    const [low, high] = group.whole;
    const least = (high - low) * 1e-7;
    if (to - from < least) { const middle = (from + to) / 2; from = middle - least / 2; to = middle + least / 2; }
    if (to - from >= high - low) { from = low; to = high; }
    if (from < low) { to += low - from; from = low; }
    if (to > high) { from -= to - high; to = high; }
    group.range = [Math.max(low, from), Math.min(high, to)];
    draw(group);
  }

  function magnify(group, centre, factor) {
    zoom(group, centre - (centre - group.range[0]) * factor, centre + (group.range[1] - centre) * factor);
  }

  function listen(svg, group, panel) {
    const timeAt = (event) => {
      const box = svg.getBoundingClientRect();
      const { width, total } = panel.geometry;
      const fraction = ((event.clientX - box.left) * total / box.width - LEFT) / width;
      return group.range[0] + Math.min(1, Math.max(0, fraction)) * (group.range[1] - group.range[0]);
    };
    let start = null, startX = 0;
    svg.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || event.pointerType === "touch") return;
      start = timeAt(event); startX = event.clientX;
      svg.setPointerCapture(event.pointerId);
    });
    svg.addEventListener("pointermove", (event) => {
      const time = timeAt(event);
      tell(time);
      if (start === null) return;
      const a = panel.geometry.x(Math.min(start, time)), b = panel.geometry.x(Math.max(start, time));
      for (const other of group.panels) {
        other.selection.setAttribute("x", a);
        other.selection.setAttribute("width", b - a);
        other.selection.setAttribute("visibility", "visible");
      }
    });
    svg.addEventListener("pointerup", (event) => {
      if (start === null) return;
      const end = timeAt(event), from = start;
      start = null;
      group.panels.forEach((other) => other.selection.setAttribute("visibility", "hidden"));
      if (Math.abs(event.clientX - startX) < 4) { group.active = true; return; }
      group.active = true;
      zoom(group, Math.min(from, end), Math.max(from, end));
    });
    svg.addEventListener("pointercancel", () => { start = null; });
    svg.addEventListener("pointerleave", () => { if (start === null && !machine) tell(null); });
    svg.addEventListener("dblclick", (event) => { event.preventDefault(); zoom(group, ...group.whole); });
    // A wheel over a page full of plots means scrolling until a plot has been clicked.
    svg.addEventListener("wheel", (event) => {
      if (!(group.active || event.ctrlKey || event.metaKey)) return;
      event.preventDefault();
      magnify(group, timeAt(event), Math.exp(Math.sign(event.deltaY) * 0.25));
    }, { passive: false });
  }

  // ---- setting up ----------------------------------------------------------
  function toolbar(group, bar) {
    const button = (text, label, act) => {
      const node = document.createElement("button");
      node.type = "button"; node.textContent = text; node.title = label;
      node.setAttribute("aria-label", label);
      node.addEventListener("click", act);
      bar.appendChild(node);
      return node;
    };
    const shift = (part) => { const d = (group.range[1] - group.range[0]) * part; zoom(group, group.range[0] + d, group.range[1] + d); };
    const middle = () => (group.range[0] + group.range[1]) / 2;
    button("+", "zoom in", () => magnify(group, middle(), 0.5));
    button("−", "zoom out", () => magnify(group, middle(), 2));
    button("‹", "earlier", () => shift(-0.5));
    button("›", "later", () => shift(0.5));
    group.reset = button("whole run", "show the whole run", () => zoom(group, ...group.whole));
    const hint = document.createElement("span");
    hint.className = "hint";
    hint.textContent = "Drag to zoom, double click for the whole run; wheel with Ctrl, or after a click.";
    bar.appendChild(hint);
  }

  for (const group of data.groups) {
    const section = document.querySelector(`[data-group="${group.index}"]`);
    let low = Infinity, high = -Infinity;
    for (const times of data.times) if (times.length) { low = Math.min(low, times[0]); high = Math.max(high, times[times.length - 1]); }
    if (!(high > low)) high = low + 1;
    group.whole = [low, high];
    group.range = [low, high];
    const plots = section.querySelector(".plots");
    group.panels.forEach((panel) => {
      panel.holder = document.createElement("div");
      panel.holder.className = "plot";
      plots.appendChild(panel.holder);
    });
    toolbar(group, section.querySelector(".bar"));
  }
  const drawAll = () => data.groups.forEach(draw);
  drawAll();
  let pending = 0;
  window.addEventListener("resize", () => { clearTimeout(pending); pending = setTimeout(drawAll, 120); });
  window.addEventListener("beforeprint", () => { printing = true; drawAll(); });
  window.addEventListener("afterprint", () => { printing = false; drawAll(); });
})();
