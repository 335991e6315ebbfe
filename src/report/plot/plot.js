// Makes the charts of a page answer. Every chart is drawn already; here it is fitted to the
// page's width, zoomed (drag, wheel, buttons; a double click shows everything), told of at the
// pointer, and its series are switched in the legend. Colours and shapes are those of the
// drawing. Cursors over one quantity go together, and with what moves on the page.
// A page has its numbers in it; the studio brings them later, again and again (`live`);
// numbers are written by numbers.js, which stands before.
const page = JSON.parse((document.getElementById("data") || { textContent: '{"columns":[],"plots":[]}' }).textContent);
// The units in which the scene states its quantities, where numbers are read easily in them.
if (page.units) numbers.prefer((unit, magnitude) => {
  const [factor, name] = page.units[unit] ?? [];
  return name && (magnitude === 0 || (magnitude / factor >= (factor >= 1e3 ? 1e-2 : 1e-3) && magnitude / factor < 1e5)) ? { factor, unit: name } : undefined;
});
// Words beside the pointer; none hides them.
const pointed = (() => {
  const tip = Object.assign(document.createElement("div"), { className: "tip", hidden: true });
  document.body.appendChild(tip);
  return (event, lines) => {
    tip.hidden = !lines || !lines.length;
    if (tip.hidden) return;
    tip.replaceChildren(...lines.map((line) => Object.assign(document.createElement("div"), { textContent: line })));
    const room = document.documentElement.clientWidth, box = tip.getBoundingClientRect();
    tip.style.left = `${Math.max(4, Math.min(event.clientX + 14, room - box.width - 8)) + scrollX}px`;
    tip.style.top = `${event.clientY + 16 + scrollY}px`;
  };
})();

const live = (() => {
  const { significant, withUnit, ticks, shown, marksOf } = numbers;
  const SVG = "http://www.w3.org/2000/svg";
  const PITCH_X = 78, PITCH_Y = 32, RIGHT = 20, LANE = 26;
  const moving = () => document.querySelector("figure.moving") !== null;
  let printing = false;
  // The place that all cursors and the machine stand at; null: none is shown.
  let instant = null;

  function add(parent, name, attributes, text) {
    const node = document.createElementNS(SVG, name);
    for (const key in attributes) node.setAttribute(key, attributes[key]);
    if (text !== undefined) node.textContent = text;
    parent.appendChild(node);
    return node;
  }
  // Writes an attribute where it is another one: the browser draws anew whatever is written.
  function put(node, name, value) {
    const text = String(value);
    if (node.getAttribute(name) !== text) node.setAttribute(name, text);
  }
  function word(node, text) { if (node.textContent !== text) node.textContent = text; }
  // Makes the children of a group from the one numbered `first` on those listed: name, attributes,
  // text. What is there is used again.
  function renew(parent, first, list) {
    // White space between what the program wrote.
    if (parent.childNodes.length !== parent.children.length) parent.replaceChildren(...parent.children);
    list.forEach(([name, attributes, text = ""], index) => {
      const there = parent.children[first + index];
      const alike = there && there.nodeName === name && there.getAttributeNames().join() === Object.keys(attributes).join();
      const node = alike ? there : document.createElementNS(SVG, name);
      if (!alike && there) there.replaceWith(node); else if (!alike) parent.appendChild(node);
      for (const key in attributes) put(node, key, attributes[key]);
      word(node, text);
    });
    while (parent.children.length > first + list.length) parent.lastElementChild.remove();
  }
  const fixed = (value) => +value.toFixed(2);
  const widthOf = (text) => 6.8 * text.length;

  // ---- series --------------------------------------------------------------
  const rising = new WeakMap();
  // Whether places follow one another along the axis, so that they can be searched.
  function isRising(xs) {
    if (!rising.has(xs)) rising.set(xs, xs.every((x, i) => x !== null && (i === 0 || x >= xs[i - 1])));
    return rising.get(xs);
  }

  // First index with values[index] >= v.
  function lowerBound(values, v) {
    let low = 0, high = values.length;
    while (low < high) { const middle = (low + high) >> 1; if (values[middle] < v) low = middle + 1; else high = middle; }
    return low;
  }

  // Visible points over places: indices from one before to one after the range.
  function span(xs, ends) {
    if (!isRising(xs)) return [0, xs.length - 1];
    return [Math.max(0, lowerBound(xs, ends[0]) - 1), Math.min(xs.length - 1, lowerBound(xs, ends[1]))];
  }

  function nearest(xs, x) {
    if (!isRising(xs)) {
      let best = 0;
      xs.forEach((at, i) => { if (at !== null && (xs[best] === null || Math.abs(at - x) < Math.abs(xs[best] - x))) best = i; });
      return best;
    }
    const i = lowerBound(xs, x);
    if (i <= 0) return 0;
    if (i >= xs.length) return xs.length - 1;
    return x - xs[i - 1] <= xs[i] - x ? i - 1 : i;
  }

  // ---- charts --------------------------------------------------------------
  class Chart {
    constructor(group, source) {
      this.group = group;
      this.svg = group.ownerSVGElement;
      this.columns = source.columns;
      this.data = source.plots[+group.dataset.plot];
      const [left, top, width, height] = group.dataset.frame.split(" ").map(Number);
      // The frame as it was drawn, and as it is.
      this.drawn = { left, top, width, height };
      this.frame = { left, top, width, height };
      this.whole = { x: this.data.x.ends, y: this.data.y.ends };
      this.range = { x: this.whole.x, y: this.whole.y };
      this.fluid = this.svg.dataset.fluid !== undefined;
      // Where it steers, a click or drag tells a place instead of zooming.
      this.steers = this.svg.dataset.steers !== undefined;
      const box = this.svg.viewBox.baseVal;
      this.size = [box.width, box.height];
      this.below = this.size[1] - top - height;
      this.hidden = new Set();
      this.axis = `${this.data.x.name} ${this.data.x.unit}`;
      this.collect();
      this.over = add(group, "g", { class: "over", "pointer-events": "none" });
      this.cursor = add(this.over, "line", { class: "pointer", visibility: "hidden" });
      this.dots = this.data.series.map((series, index) => {
        const style = this.curves[index] ? [...this.curves[index].classList].find((name) => /^s\d+$/.test(name)) : "s0";
        return add(this.over, "circle", { r: 3.2, class: `dot f${style.slice(1)}`, visibility: "hidden" });
      });
      this.reading = add(this.over, "text", { class: "reading", "text-anchor": "end", y: 18 });
      this.cell = add(this.over, "rect", { class: "pointed", visibility: "hidden" });
      this.kept = add(this.over, "rect", { class: "pointed kept", visibility: "hidden" });
      this.selection = add(this.over, "rect", { class: "selection", visibility: "hidden" });
      this.entries = [...group.querySelectorAll(".legend .entry")];
      this.entries.filter((entry) => entry.dataset.series !== undefined).forEach((entry) => this.switches(entry));
      this.listen();
    }

    // What there is in the drawing.
    collect() {
      const { group } = this, one = (selector) => group.querySelector(selector);
      this.grid = one(".grid");
      this.curves = [...group.querySelectorAll(".inside > [data-series]")];
      this.sets = [...group.querySelectorAll(".points > [data-series]")];
      this.pad = one(".pad");
      this.clip = one("clipPath rect");
      this.border = group.querySelector(":scope > .axis");
      // What is moved as it was drawn: cells, contour lines, borders, what stands upon them.
      this.paths = [...group.querySelectorAll(".field path, .inside > .below, .inside > [data-band], .inside > .rule")]
        .filter((node) => !node.closest("pattern"))
        .map((node) => ({ node, d: node.getAttribute("d") }));
      this.phases = [...group.querySelectorAll(".inside > .phase")];
      this.spots = [...group.querySelectorAll(".labels > *")].map((node) => {
        const [x, y] = node.getAttribute("transform").match(/-?[\d.]+/g).map(Number);
        return { node, x, y };
      });
    }

    // The same chart with other numbers, as many series, bands and rules; what is zoomed stays so.
    take(source) {
      const zoomed = ["x", "y"].filter((axis) => this.range[axis].some((end, i) => end !== this.whole[axis][i]));
      this.columns = source.columns;
      this.data = source.plots[+this.group.dataset.plot];
      const [left, top, width, height] = this.data.frame.split(" ").map(Number);
      this.drawn = { left, top, width, height };
      this.frame = { left, top, width, height };
      this.whole = { x: this.data.x.ends, y: this.data.y.ends };
      for (const axis of ["x", "y"]) this.range[axis] = zoomed.includes(axis) && (axis === "x" || this.data.both) ? within(this.range[axis], this.whole[axis]) : this.whole[axis];
      this.axis = `${this.data.x.name} ${this.data.x.unit}`;
    }
    column(index) { return this.columns[index]; }

    // A cross at a place that is not among the numbers: where the scene stands on a map.
    mark(x, y) {
      this.here = [x, y];
      this.crosses = this.crosses || ["here-back", "here"].map((name) => add(this.over, "path", { class: name }));
      const [px, py] = x === null || y === null ? [] : [this.px(x), this.py(y)];
      for (const cross of this.crosses) cross.setAttribute("d", this.inside(px, py) ? `M${fixed(px - 9)} ${fixed(py)}h18M${fixed(px)} ${fixed(py - 9)}v18` : "");
    }

    // -- places
    space(axis, value) { return value === null ? undefined : this.data[axis].log ? (value > 0 ? Math.log10(value) : undefined) : value; }
    back(axis, place) { return this.data[axis].log ? 10 ** place : place; }
    px(value) { return this.at("x", this.space("x", value)); }
    py(value) { return this.at("y", this.space("y", value)); }
    at(axis, place) {
      const { left, top, width, height } = this.frame, [from, to] = this.range[axis], share = (place - from) / (to - from);
      return axis === "x" ? left + share * width : top + (1 - share) * height;
    }
    // A drawn place, zoomed.
    moved(axis, pixel) {
      const { left, top, width, height } = this.drawn, [from, to] = this.whole[axis];
      const share = axis === "x" ? (pixel - left) / width : 1 - (pixel - top) / height;
      return fixed(this.at(axis, from + share * (to - from)));
    }

    // -- drawing
    // Width that there is; asked of the page only where it has not told of it.
    room() { return this.width ?? this.svg.parentNode.clientWidth; }
    // Width on paper (pixels): of two beside each other that of a half, so that letters keep their size.
    beside(kinds) { return this.svg.closest(kinds.map((kind) => `${kind}:not(.single)`).join()) !== null; }
    paper() { return Math.min(this.beside([".plots", ".panels"]) ? 338 : 700, this.size[0]); }
    // A title that is longer than its chart is wide has smaller letters.
    entitled(room) {
      const title = this.group.querySelector(".title"), wide = 8.4 * (title?.textContent.length ?? 0);
      if (title) title.style.fontSize = wide > room ? `${fixed(13.5 * room / wide)}px` : "";
    }
    fit(room) {
      if (this.fluid) {
        const total = Math.max(280, printing ? this.paper() : room);
        let x = this.drawn.left, row = 0;
        for (const entry of this.entries) {
          const room = +entry.dataset.room;
          if (x > this.drawn.left && x + room - 12 > total - RIGHT) { x = this.drawn.left; row++; }
          put(entry, "transform", `translate(${x} ${36 + 18 * row})`);
          x += room;
        }
        const lane = this.group.querySelector(".lane") ? LANE : 0;
        this.frame.top = 28 + (this.entries.length ? 18 * (row + 1) : 0) + lane;
        this.frame.width = Math.max(60, total - this.drawn.left - RIGHT);
        this.frame.height = this.drawn.height * (printing && this.size[1] > 250 && this.beside([".plots"]) ? 0.72 : 1);
        this.entitled(total - this.drawn.left);
        const height = this.frame.top + this.frame.height + this.below;
        put(this.svg, "viewBox", `0 0 ${fixed(total)} ${fixed(height)}`);
        if (this.data.plane) {
          const whole = !this.zoomed();
          if (whole) this.range = { x: this.data.x.ends, y: this.data.y.ends };
          this.evened();
          if (whole) this.whole = { ...this.range };
        }
      }
      const { left, top, width, height } = this.frame;
      if (this.border) put(this.border, "d", `M${left} ${top}h${width}v${height}h${-width}z`);
      for (const node of [this.pad, this.clip]) {
        put(node, "x", this.frame.left); put(node, "y", this.frame.top);
        put(node, "width", this.frame.width);
        put(node, "height", this.frame.height + (node === this.pad && this.data.field && this.data.field.strip ? 20 : 0));
      }
    }

    // One scale on both axes of a plane, about the middle of what is shown.
    evened() {
      const { width, height } = this.frame, [a, b] = ["x", "y"].map((axis) => this.range[axis][1] - this.range[axis][0]);
      const unit = Math.max(a / width, b / height);
      for (const [axis, pixels] of [["x", width], ["y", height]]) {
        const middle = (this.range[axis][0] + this.range[axis][1]) / 2;
        this.range[axis] = [middle - unit * pixels / 2, middle + unit * pixels / 2];
      }
    }

    // Where values follow from places the vertical axis goes with what is visible.
    level() {
      if (this.data.both || !this.zoomed() && !this.hidden.size) { if (!this.data.both) this.range.y = this.whole.y; return; }
      let low = Infinity, high = -Infinity;
      this.data.series.forEach((series, index) => {
        if (this.hidden.has(index)) return;
        const [from, to] = span(this.column(series.x), this.range.x), ys = this.column(series.y);
        for (let i = from; i <= to; i++) { const v = ys[i]; if (v === null) continue; if (v < low) low = v; if (v > high) high = v; }
      });
      for (const [at, upright] of this.data.rules) if (!upright && !this.zoomed()) { low = Math.min(low, at); high = Math.max(high, at); }
      if (low > high) { this.range.y = this.whole.y; return; }
      const size = Math.max(Math.abs(low), Math.abs(high));
      // What moves by less than rounding is drawn as the constant that it is.
      const pad = high - low <= 1e-9 * size || size === 0 ? (size > 0 ? size * 0.1 : 1) : 0.07 * (high - low);
      const strips = this.group.querySelectorAll("[data-band]:not(.open)").length;
      const room = strips ? (high - low + 2 * pad) * (6 * strips + 2) / this.frame.height : 0;
      this.range.y = [low - pad - room, high + pad];
    }

    zoomed() { return ["x", "y"].some((axis) => (axis === "x" || this.data.both) && this.range[axis].some((end, i) => end !== this.whole[axis][i])); }

    draw(room = this.fluid ? this.room() : 0) {
      this.stale = false;
      this.fit(room);
      this.level();
      this.drawGrid();
      for (const { node, d } of this.paths) {
        if (node.dataset.band !== undefined || node.matches(".below, .rule")) continue;
        let from = "x";
        node.setAttribute("d", d.replace(/([MLHV])(-?[\d.]+)(?: (-?[\d.]+))?/g, (_, command, a, b) => {
          from = command === "V" ? "y" : "x";
          return b === undefined ? `${command}${this.moved(from, +a)}` : `${command}${this.moved("x", +a)} ${this.moved("y", +b)}`;
        }));
        if (this.data.field && this.data.field.strip) node.setAttribute("d", d.replace(/([MH])(-?[\d.]+)/g, (_, command, a) => `${command}${Math.min(Math.max(this.moved("x", +a), this.frame.left), this.frame.left + this.frame.width)}`));
      }
      const named = [];
      for (const { node, x, y } of this.spots) {
        const [px, py] = [this.moved("x", x), this.moved("y", y)];
        const half = 0.42 * widthOf(node.textContent);
        const meets = named.some((one) => Math.abs(one.px - px) < one.half + half && Math.abs(one.py - py) < 14);
        const seen = this.inside(px, py) && !(half > 0 && meets);
        if (seen && half > 0) named.push({ px, py, half });
        node.setAttribute("transform", `translate(${px} ${py})`);
        node.setAttribute("visibility", seen ? "inherit" : "hidden");
      }
      this.drawGround();
      this.data.series.forEach((series, index) => this.drawSeries(series, index));
      if (this.chosen) this.placeCell(this.kept, this.chosen);
      if (this.here) this.mark(...this.here);
      put(this.cell, "visibility", "hidden");
      if (instant !== null && instant.axis === this.axis) this.pointAt(instant.value); else this.quiet();
    }

    inside(x, y) {
      const { left, top, width, height } = this.frame;
      return x >= left - 0.6 && x <= left + width + 0.6 && y >= top - 0.6 && y <= top + height + 0.6;
    }

    drawGrid() {
      if (this.data.plane) { this.drawPolar(); return; }
      const { left, top, width, height } = this.frame, grid = this.grid, { x: xs, y: ys, field } = this.data;
      const solid = field && !field.strip, strip = field && field.strip ? 20 : 0, lane = this.group.querySelector(".lane");
      const name = grid.querySelector(".lane + text");
      const list = [];
      if (lane) {
        put(lane, "x", left); put(lane, "y", top - LANE); put(lane, "width", width);
        put(name, "y", top - LANE / 2 + 4);
        if (grid.firstElementChild !== lane) grid.prepend(lane, name);
      }
      for (const [place, label, kind] of marksOf(ys, this.range.y, height, PITCH_Y)) {
        const y = fixed(this.at("y", place));
        if (!this.inside(left, y)) continue;
        if (!solid) list.push(["path", { class: kind, d: `M${left} ${y}h${width}` }]);
        if (label) list.push(["text", { x: left - 7, y, dy: 4, "text-anchor": "end" }, label]);
      }
      let end = -Infinity;
      for (const [place, label, kind] of marksOf(xs, this.range.x, width, PITCH_X).map((mark) => [this.at("x", mark[0]), mark[1], mark[2]]).sort((a, b) => a[0] - b[0])) {
        const x = fixed(place);
        if (!this.inside(x, top)) continue;
        list.push(["path", solid ? { class: "axis", d: `M${x} ${top + height}v4` } : { class: kind, d: `M${x} ${top}v${height}` }]);
        const half = widthOf(label) / 2;
        if (!label || x - half < end + 8) continue;
        end = x + half;
        list.push(["text", { x: Math.min(x, left + width + 18 - half), y: top + height + strip + 17, "text-anchor": "middle" }, label]);
      }
      if (!solid) list.push(["path", { class: "axis", d: `M${left} ${top}v${height}h${width}` }]);
      const titled = (axis) => [axis.name, shown(axis, this.range[axis === xs ? "x" : "y"]).unit].filter(Boolean).join(", ");
      list.push(["text", { class: "x-name", x: left + width / 2, y: top + height + strip + 35, "text-anchor": "middle" }, titled(xs)]);
      if (ys.name) {
        const at = Math.max(Math.min(14, left - 40), left - 62);
        list.push(["text", { transform: `translate(${at} ${top + height / 2}) rotate(-90)`, "text-anchor": "middle" }, titled(ys)]);
      } else {
        const unit = this.group.querySelector(".title .unit"), { unit: text } = shown(ys, this.range.y);
        if (unit) word(unit, text ? `, ${text}` : "");
      }
      renew(grid, lane ? 2 : 0, list);
    }

    // Rings and directions about the origin.
    drawPolar() {
      const { left, top, width, height } = this.frame, grid = this.grid, cx = this.at("x", 0), cy = this.at("y", 0);
      const pixels = width / (this.range.x[1] - this.range.x[0]), { factor, unit } = shown(this.data.x, this.range.x);
      const far = Math.max(...[left, left + width].flatMap((x) => [top, top + height].map((y) => Math.hypot(x - cx, y - cy)))) / pixels;
      const whole = !this.zoomed(), reach = whole ? 0.5 * Math.min(width, height) / pixels - 20 / pixels : far;
      const angle = this.data.plane * Math.PI / 180, visible = (x, y) => this.inside(x, y);
      const clip = this.clip.parentNode.id;
      const list = [];
      const step = whole ? reach : Math.min(width, height) / pixels / 2;
      const first = ticks(0, step / factor, 4), gap = first.length > 1 ? first[1][0] - first[0][0] : step / factor;
      const least = this.inside(cx, cy) ? 0 : Math.max(0, Math.hypot(Math.max(left - cx, 0, cx - left - width), Math.max(top - cy, 0, cy - top - height)) / pixels / factor);
      const decimals = first.length > 1 ? (first[1][1].split(".")[1] || "").length : 0;
      for (let ring = Math.max(1, Math.floor(least / gap)), count = 0; ring * gap * factor <= reach * (1 + 1e-6) && count < 40; ring++, count++) {
        const r = ring * gap * factor * pixels;
        list.push(["circle", { class: "gridline", cx, cy, r, fill: "none", "clip-path": `url(#${clip})` }]);
        const x = cx + r * Math.cos(angle), y = cy - r * Math.sin(angle);
        if (visible(x, y)) list.push(["text", { x, y, dy: 4, "text-anchor": "middle" }, (ring * gap).toFixed(decimals)]);
      }
      for (let spoke = 0; spoke < 12; spoke++) {
        const [cos, sin] = [Math.cos(spoke * Math.PI / 6), Math.sin(spoke * Math.PI / 6)], r = reach * pixels;
        list.push(["path", { class: spoke % 3 ? "gridline" : "zero", d: `M${cx} ${cy}L${cx + r * cos} ${cy - r * sin}`, "clip-path": `url(#${clip})` }]);
        if (whole && spoke % 3 === 0) list.push(["text", { x: cx + (r + 13) * cos, y: cy - (r + 11) * sin, dy: 4, "text-anchor": "middle" }, `${30 * spoke}°`]);
      }
      const title = this.group.querySelector(".title .unit");
      if (title) word(title, unit ? `, ${unit}` : "");
      renew(grid, 0, list);
    }

    // Shaded parts and lines across the frame.
    drawGround() {
      const { left, top, width, height } = this.frame, clamp = (x) => Math.min(Math.max(x, left), left + width);
      const bands = this.paths.filter(({ node }) => node.dataset.band !== undefined), strips = bands.filter(({ node }) => !node.classList.contains("open")).length;
      let strip = 0;
      bands.forEach(({ node }, index) => {
        const full = node.classList.contains("open");
        if (!full) strip++;
        const y = full ? top : top + height - 6 * (strips + 1 - strip), high = full ? height : 5;
        let d = "", from = null, to = null;
        const flush = () => { if (from !== null) d += `M${fixed(from)} ${y}h${fixed(Math.max(0.6, to - from))}v${high}H${fixed(from)}z`; };
        for (const [a, b] of this.data.bands[index]) {
          if (this.px(b) < left || this.px(a) > left + width) continue;
          const l = clamp(this.px(a)), r = clamp(this.px(b));
          if (from !== null && l - to < 0.4) { to = Math.max(to, r); continue; }
          flush(); from = l; to = r;
        }
        flush();
        put(node, "d", d);
      });
      this.phases.forEach((node, index) => {
        const [from, to] = this.data.phases[index].map((at) => clamp(this.px(at))), [box, name] = node.children;
        put(box, "x", fixed(from)); put(box, "width", fixed(to - from)); put(box, "y", top); put(box, "height", height);
        put(name, "x", fixed((from + to) / 2)); put(name, "y", top + 11);
        put(name, "visibility", to - from > widthOf(name.textContent) + 4 ? "inherit" : "hidden");
      });
      const rules = this.paths.filter(({ node }) => node.matches(".rule"));
      rules.forEach(({ node }, index) => {
        const [at, upright] = this.data.rules[index];
        put(node, "d", upright ? `M${fixed(this.px(at))} ${top}v${height}` : `M${left} ${fixed(this.py(at))}h${width}`);
      });
      const below = this.paths.find(({ node }) => node.matches(".below"));
      if (below) {
        const y = Math.min(Math.max(this.py(this.data.below), top), top + height);
        put(below.node, "d", `M${left} ${y}h${width}V${top + height}h${-width}z`);
      }
    }

    // Where samples are denser than pixels, each pixel column keeps its first, least, greatest
    // and last value, so that no peak is lost.
    drawSeries(series, index) {
      const off = this.hidden.has(index), curve = this.curves[index], set = this.sets[index];
      const xs = this.column(series.x), ys = this.column(series.y), { top, left, width } = this.frame;
      const lane = this.data.lane !== undefined && this.group.querySelector(".lane") !== null;
      const spot = (i) => {
        const x = this.px(xs[i]), y = this.py(ys[i]);
        if (lane && series.marks && !(y >= top)) return [x, top - LANE / 2, true];
        return [x, y, false];
      };
      if (curve) {
        const parts = [];
        let pen = false;
        const point = (i) => {
          const [x, y, beside] = spot(i);
          if (!isFinite(x) || !isFinite(y) || beside || (series.marks && series.marks[i] === 2)) { pen = false; return; }
          parts.push(pen && series.steps ? `H${fixed(x)}V${fixed(y)}` : `${pen ? "L" : "M"}${fixed(x)} ${fixed(y)}`);
          pen = true;
        };
        const [from, to] = span(xs, this.data.x.log ? this.range.x.map((end) => 10 ** end) : this.range.x);
        if (!off && !series.bare) {
          if (to - from < 3 * width) for (let i = from; i <= to; i++) point(i);
          else for (let i = from; i <= to;) {
            const place = Math.floor(this.px(xs[i]));
            let end = i, low = i, high = i;
            while (end + 1 <= to && Math.floor(this.px(xs[end + 1])) === place) {
              end++;
              if (ys[end] < ys[low]) low = end;
              if (ys[end] > ys[high]) high = end;
            }
            [...new Set([i, Math.min(low, high), Math.max(low, high), end])].forEach(point);
            i = end + 1;
          }
        }
        put(curve, "d", parts.join(""));
      }
      if (!set) return;
      const marks = [...set.children];
      const places = series.marks ? series.marks.map((mark, i) => mark ? i : -1).filter((i) => i >= 0) : [];
      if (this.data.start && marks.length > places.length) places.push(0);
      marks.forEach((mark, k) => {
        const [x, y, beside] = spot(places[k]);
        const visible = !off && isFinite(x) && isFinite(y) && (beside ? x >= left - 0.6 && x <= left + width + 0.6 : this.inside(x, y));
        put(mark, "visibility", visible ? "inherit" : "hidden");
        if (visible) put(mark, "transform", `translate(${fixed(x)} ${fixed(y)})`);
      });
    }

    // -- the legend switches series
    switches(entry) {
      const index = +entry.dataset.series;
      entry.classList.add("switch");
      entry.setAttribute("role", "button");
      entry.setAttribute("tabindex", "0");
      entry.setAttribute("aria-pressed", "true");
      const flip = () => {
        if (this.hidden.has(index)) this.hidden.delete(index); else this.hidden.add(index);
        entry.classList.toggle("off", this.hidden.has(index));
        entry.setAttribute("aria-pressed", String(!this.hidden.has(index)));
        this.draw();
      };
      entry.addEventListener("click", flip);
      entry.addEventListener("keydown", (event) => { if (event.key === "Enter" || event.key === " ") { event.preventDefault(); flip(); } });
    }

    // -- reading
    // The cursor at a place of the axis: values of all series there.
    pointAt(value) {
      const { left, top, width, height } = this.frame, x = this.px(value);
      this.quiet();
      if (this.data.plane || this.data.field || !(x >= left - 1 && x <= left + width + 1)) return null;
      const values = [];
      let at = null;
      this.data.series.forEach((series, index) => {
        if (this.hidden.has(index) || !this.column(series.x).length || (this.data.both && !isRising(this.column(series.x)))) return;
        const i = nearest(this.column(series.x), value), v = this.column(series.y)[i], place = this.column(series.x)[i];
        if (v === null || place === null) return;
        if (at === null) at = place;
        const [px, py] = [this.px(place), this.py(v)];
        if (this.inside(px, py)) { this.dots[index].setAttribute("cx", px); this.dots[index].setAttribute("cy", py); this.dots[index].setAttribute("visibility", "visible"); }
        values.push([index, series.label, withUnit(v, this.data.y.unit, 6)]);
      });
      if (at === null) return null;
      const line = { x1: Math.min(Math.max(this.px(at), left), left + width), y1: top, y2: top + height, visibility: "visible" };
      line.x2 = line.x1;
      for (const key in line) this.cursor.setAttribute(key, line[key]);
      const place = `${this.data.x.name} = ${withUnit(at, this.data.x.unit, 6)}`;
      // What there is room for beside the title; everything is told at the pointer.
      const heading = this.group.querySelector(".title");
      const room = left + width - (heading ? left + widthOf(heading.textContent) * 1.12 : left);
      const texts = [place, ...values.map((one) => one[2])];
      while (texts.length && widthOf(texts.join("   ")) > room) texts.shift();
      this.reading.setAttribute("x", left + width);
      this.reading.textContent = values.length <= 3 ? texts.join("   ") : widthOf(place) < room ? place : "";
      return [place, ...values.map(([, label, text]) => label ? `${label}: ${text}` : text)];
    }

    quiet() {
      put(this.cursor, "visibility", "hidden");
      this.dots.forEach((dot) => put(dot, "visibility", "hidden"));
      word(this.reading, "");
    }

    // The point nearest to the pointer, of charts whose values belong to points.
    pointNear(x, y) {
      let best = null, least = 40;
      this.data.series.forEach((series, index) => {
        if (this.hidden.has(index)) return;
        const xs = this.column(series.x), ys = this.column(series.y), { top } = this.frame;
        const lane = this.group.querySelector(".lane") !== null && series.marks;
        for (let i = 0; i < xs.length; i++) {
          const px = this.px(xs[i]);
          let py = this.py(ys[i]);
          if (lane && !(py >= top)) py = top - LANE / 2;
          const off = Math.hypot(px - x, py - y);
          if (off < least) { least = off; best = { series, index, i, px, py }; }
        }
      });
      this.quiet();
      if (!best) return null;
      const { series, index, i, px, py } = best, [a, b] = [this.column(series.x)[i], this.column(series.y)[i]];
      this.dots[index].setAttribute("cx", px); this.dots[index].setAttribute("cy", py);
      this.dots[index].setAttribute("visibility", "visible");
      const named = (axis, value, other) => value === null ? "" : `${axis.name || other} = ${withUnit(value, axis.unit, 6)}`;
      const lines = [series.label];
      if (this.data.plane) {
        lines.push(`size ${withUnit(Math.hypot(a, b), this.data.x.unit, 6)}, direction ${significant(Math.atan2(b, a) * 180 / Math.PI, 5)}°`);
        lines.push(`x = ${withUnit(a, this.data.x.unit, 6)}, y = ${withUnit(b, this.data.y.unit, 6)}`);
      } else lines.push(named(this.data.x, a, "x"), named(this.data.y, b, this.data.title.split(":")[0]));
      if (series.notes) lines.push(series.notes[i]);
      return lines.filter(Boolean);
    }

    // The cell at a place of the picture.
    cellAt(x, y) {
      const field = this.data.field;
      if (!field) return null;
      const found = (axis, edges, place) => {
        for (let i = 0; i + 1 < edges.length; i++) {
          const [a, b] = [edges[i], edges[i + 1]].map((edge) => this.space(axis, edge));
          if ((place - a) * (place - b) <= 0) return i;
        }
        return -1;
      };
      const place = this.placeAt(x, y), column = found("x", field.x, place.x), row = field.strip ? 0 : found("y", field.y, place.y);
      if (column < 0 || row < 0) return null;
      return { column, row, index: row * (field.x.length - 1) + column };
    }

    placeCell(rect, { column, row }) {
      const { field } = this.data, { left, top, width, height } = this.frame;
      const xs = [field.x[column], field.x[column + 1]].map((edge) => Math.min(Math.max(this.px(edge), left), left + width)).sort((a, b) => a - b);
      const ys = field.strip ? [top, top + height + 17] : [field.y[row], field.y[row + 1]].map((edge) => Math.min(Math.max(this.py(edge), top), top + height)).sort((a, b) => a - b);
      for (const [name, value] of [["x", xs[0]], ["y", ys[0]], ["width", xs[1] - xs[0]], ["height", ys[1] - ys[0]]]) rect.setAttribute(name, value);
      rect.setAttribute("visibility", xs[1] - xs[0] > 0 && ys[1] - ys[0] > 0 ? "visible" : "hidden");
    }

    // -- pointer
    pixel(event, matrix = this.svg.getScreenCTM()) {
      const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
      return [point.x, point.y];
    }

    // Places on both axes (logarithms of log axes) of a place of the picture.
    placeAt(x, y) {
      const { left, top, width, height } = this.frame, share = (value) => Math.min(1, Math.max(0, value));
      const [a, b] = [share((x - left) / width), share(1 - (y - top) / height)];
      const along = (axis, part) => this.range[axis][0] + part * (this.range[axis][1] - this.range[axis][0]);
      return { x: along("x", a), y: along("y", b) };
    }

    hover(event) {
      const [x, y] = this.pixel(event);
      const cell = this.cellAt(x, y);
      if (this.data.field) {
        if (!cell) return;
        this.placeCell(this.cell, cell);
        this.say("cell", cell);
        const note = this.data.field.notes[cell.index];
        pointed(event, note ? [note] : null);
        return;
      }
      if (this.data.both) { pointed(event, this.pointNear(x, y)); return; }
      const value = this.back("x", this.placeAt(x, y).x);
      tell(this.axis, value);
      pointed(event, this.pointAt(value));
    }

    say(kind, detail) { document.dispatchEvent(new CustomEvent(kind, { detail: { ...detail, plot: this.data.id } })); }

    listen() {
      const node = this.pad;
      let start = null;
      // Answers come while the button is down, and may move the chart under the pointer: only how far
      // the pointer goes counts.
      const steer = (event, done) => { const place = this.placeAt(...this.pixel(event, start.matrix)); this.say("steered", { x: this.back("x", place.x), y: this.back("y", place.y), done }); };
      node.addEventListener("pointerdown", (event) => {
        if (event.button !== 0) return;
        if (this.steers) {
          start = { matrix: this.svg.getScreenCTM() };
          try { node.setPointerCapture(event.pointerId); } catch { /* a pointer made by a script */ }
          steer(event, false);
          return;
        }
        if (event.pointerType === "touch") return;
        this.dragged = false;
        start = { pixel: this.pixel(event), place: this.placeAt(...this.pixel(event)), x: event.clientX, y: event.clientY };
        try { node.setPointerCapture(event.pointerId); } catch { /* a pointer made by a script */ }
      });
      node.addEventListener("pointermove", (event) => {
        if (!start) { this.hover(event); return; }
        if (this.steers) { steer(event, false); return; }
        const [x, y] = this.pixel(event), { left, top, width, height } = this.frame, clamp = (v, a, b) => Math.min(Math.max(v, a), b);
        const xs = [start.pixel[0], clamp(x, left, left + width)].sort((a, b) => a - b);
        const ys = this.data.both ? [start.pixel[1], clamp(y, top, top + height)].sort((a, b) => a - b) : [top, top + height];
        for (const [name, value] of [["x", xs[0]], ["width", xs[1] - xs[0]], ["y", ys[0]], ["height", ys[1] - ys[0]]]) this.selection.setAttribute(name, value);
        this.selection.setAttribute("visibility", "visible");
      });
      node.addEventListener("pointerup", (event) => {
        if (!start) return;
        if (this.steers) { steer(event, true); start = null; return; }
        const end = this.placeAt(...this.pixel(event)), { place, x, y } = start;
        start = null;
        this.selection.setAttribute("visibility", "hidden");
        this.active = true;
        if (Math.abs(event.clientX - x) < 5 && (!this.data.both || Math.abs(event.clientY - y) < 5)) return;
        this.dragged = true;
        const box = (axis) => [Math.min(place[axis], end[axis]), Math.max(place[axis], end[axis])];
        const turned = (axis, [a, b]) => this.whole[axis][0] > this.whole[axis][1] ? [b, a] : [a, b];
        zoom(this, { x: turned("x", box("x")), y: this.data.both && this.free("y") ? turned("y", box("y")) : null });
      });
      node.addEventListener("click", (event) => {
        if (this.steers) return;
        // The click that ends a drag chooses nothing.
        if (this.dragged) { this.dragged = false; return; }
        const cell = this.cellAt(...this.pixel(event));
        if (!cell) return;
        for (const other of charts) { other.chosen = null; other.kept.setAttribute("visibility", "hidden"); }
        this.chosen = cell;
        this.placeCell(this.kept, cell);
        this.say("chosen", cell);
      });
      node.addEventListener("pointercancel", () => { start = null; this.selection.setAttribute("visibility", "hidden"); });
      node.addEventListener("pointerleave", () => {
        if (start) return;
        pointed(null, null);
        this.cell.setAttribute("visibility", "hidden");
        if (this.data.field) this.say("left", {});
        else if (this.data.both) this.quiet();
        else if (!moving()) tell(this.axis, null);
      });
      node.addEventListener("dblclick", (event) => { event.preventDefault(); zoom(this, null); });
      // A wheel over a page full of charts means scrolling until a chart has been clicked.
      node.addEventListener("wheel", (event) => {
        if (!(this.active || event.ctrlKey || event.metaKey)) return;
        event.preventDefault();
        magnify(this, this.placeAt(...this.pixel(event)), Math.exp(Math.sign(event.deltaY) * 0.25));
      }, { passive: false });
    }

    // Whether an axis is zoomed at all: rows are not.
    free(axis) { return !this.data[axis].rows.length && !(axis === "y" && this.data.field && this.data.field.strip); }
  }

  const charts = [];
  const linked = (chart) => chart.data.link ? charts.filter((other) => other.data.link === chart.data.link) : [chart];
  const barsOf = (link) => [...document.querySelectorAll(".bar[data-zoom]")].filter((bar) => bar.dataset.zoom === link);

  // ---- zooming -------------------------------------------------------------
  // The part of an axis that lies within the whole, and is not shorter than rounding bears.
  function within([from, to], [first, last]) {
    const turned = first > last, [low, high] = turned ? [last, first] : [first, last];
    let [a, b] = from < to ? [from, to] : [to, from];
    const least = Math.max((high - low) * 1e-9, 1e-12 * Math.max(Math.abs(low), Math.abs(high)));
    if (b - a < least) { const middle = (a + b) / 2; a = middle - least / 2; b = middle + least / 2; }
    if (b - a >= high - low) [a, b] = [low, high];
    if (a < low) { b += low - a; a = low; }
    if (b > high) { a -= b - high; b = high; }
    return turned ? [b, a] : [a, b];
  }

  // Zooms a chart and those that go with it; null: everything.
  function zoom(chart, ranges) {
    for (const other of linked(chart)) {
      for (const axis of ["x", "y"]) {
        if (axis === "y" && !other.data.both) continue;
        const wanted = ranges && ranges[axis];
        if (!ranges) other.range[axis] = other.whole[axis];
        else if (wanted) other.range[axis] = within(wanted, other.whole[axis]);
      }
      if (other.data.plane && ranges) other.evened();
      other.draw();
    }
    for (const bar of barsOf(chart.data.link)) bar.querySelectorAll(".reset").forEach((reset) => { reset.disabled = !chart.zoomed(); });
  }

  function magnify(chart, centre, factor) {
    const part = (axis) => chart.range[axis].map((end) => centre[axis] + (end - centre[axis]) * factor);
    zoom(chart, { x: part("x"), y: chart.data.both && chart.free("y") ? part("y") : null });
  }

  // ---- cursors -------------------------------------------------------------
  // All cursors over one quantity go together, and what moves with them.
  function tell(axis, value) {
    document.dispatchEvent(new CustomEvent("instant", { detail: { axis, value, by: "plots" } }));
  }
  document.addEventListener("instant", (event) => {
    const { axis, value } = event.detail;
    instant = value === null ? null : { axis, value };
    for (const chart of charts) {
      if (chart.axis !== axis || chart.data.both) continue;
      if (value === null) chart.quiet(); else chart.pointAt(value);
    }
  });

  // ---- setting up ----------------------------------------------------------
  // The charts within an element, drawn already, with their numbers.
  const rooms = new ResizeObserver((entries) => {
    for (const { target } of entries) {
      const width = target.clientWidth;
      for (const chart of charts) {
        if (chart.svg.parentNode !== target || chart.width === width) continue;
        const first = chart.width === undefined;
        chart.width = width;
        if (!first && chart.fluid && width > 0) chart.draw();
      }
    }
  });
  // `width`: the room that there is for them, where it is known: the page is not asked for it then.
  function make(root, source, width) {
    const made = [...root.querySelectorAll("svg.dam-plot g.plot")].map((group) => new Chart(group, source));
    for (const chart of made) chart.width = width;
    charts.push(...made);
    root.querySelectorAll(".bar[data-zoom]").forEach(buttons);
    made.forEach((chart) => { chart.draw(); rooms.observe(chart.svg.parentNode); });
    return made;
  }

  // Other numbers for charts that are the same otherwise; those that are not seen are drawn later.
  function update(made, source, visible = () => true) {
    const drawn = made.filter(visible), widths = drawn.map((chart) => chart.fluid ? chart.room() : 0);
    // Nothing is asked of the page once something was changed: it would be laid out anew each time.
    for (const chart of made) { chart.take(source); chart.stale = true; }
    drawn.forEach((chart, index) => chart.draw(widths[index]));
  }

  // Whether charts would have the same axes and frames over other numbers, and no series to switch.
  function alike(made, source) {
    const told = ({ frame, x, y, series }) => JSON.stringify([frame, x, y, series]);
    return made.every((chart) => { const other = source.plots[+chart.group.dataset.plot]; return other && !other.series.length && told(other) === told(chart.data); });
  }

  // Charts of which more is drawn anew than their numbers.
  function renewed(made, source) {
    for (const chart of made) {
      for (const mark of [chart.cell, chart.kept]) put(mark, "visibility", "hidden");
      chart.take(source);
      chart.collect();
      chart.draw();
    }
  }

  // Forgets charts that are about to go.
  function drop(made) {
    const gone = new Set(made);
    for (const chart of made) rooms.unobserve(chart.svg.parentNode);
    charts.splice(0, charts.length, ...charts.filter((chart) => !gone.has(chart)));
  }

  function buttons(bar) {
    const chart = charts.find((one) => one.data.link === bar.dataset.zoom);
    if (!chart) { bar.remove(); return; }
    const button = (text, label, act) => {
      const node = Object.assign(document.createElement("button"), { type: "button", textContent: text, title: label });
      node.setAttribute("aria-label", label);
      node.addEventListener("click", act);
      bar.appendChild(node);
      return node;
    };
    const middle = () => ({ x: (chart.range.x[0] + chart.range.x[1]) / 2, y: (chart.range.y[0] + chart.range.y[1]) / 2 });
    const shift = (part) => { const d = (chart.range.x[1] - chart.range.x[0]) * part; zoom(chart, { x: chart.range.x.map((end) => end + d), y: null }); };
    button("+", "zoom in", () => magnify(chart, middle(), 0.5));
    button("−", "zoom out", () => magnify(chart, middle(), 2));
    button("‹", "to the left", () => shift(-0.5));
    button("›", "to the right", () => shift(0.5));
    const reset = button("everything", "show everything", () => zoom(chart, null));
    reset.className = "reset";
    reset.disabled = true;
    const hint = document.createElement("span");
    hint.className = "hint";
    hint.textContent = "Drag to zoom, double click for everything; wheel with Ctrl, or after a click.";
    bar.appendChild(hint);
  }
  const drawAll = () => charts.forEach((chart) => chart.draw());
  make(document, page);
  window.addEventListener("beforeprint", () => { printing = true; drawAll(); });
  window.addEventListener("afterprint", () => { printing = false; drawAll(); });
  return { make, update, alike, renew: renewed, drop, draw: drawAll };
})();
