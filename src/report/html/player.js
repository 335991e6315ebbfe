// Moves the machine of a page: one player for linkages, cams and whole scenes. Every
// moving part is a group that is placed anew; where it goes is a table over the rows, a
// table over a coordinate, a turn or a slide by a coordinate. The player follows the
// cursor of the charts, and the charts' cursors follow the player.
const machine = (() => {
  const { minus, significant } = numbers;
  // Most instants of a picture that runs by itself, frames of a film a second, and most of them.
  const MOST = 400, RATE = 25, LONGEST = 250;

  // A coordinate over the rows, and its deviation from the law.
  function column(given, columns) {
    if (given.own) return { values: given.own, deviation: null };
    return { values: columns[given.values], deviation: given.deviation === null ? null : columns[given.deviation] };
  }

  const number = (value) => significant(value, 5), short = (value) => significant(value, 4);

  // Between two rows, or at the nearer one where the other has no value.
  function between(values, place) {
    if (!values) return 0;
    const below = Math.min(Math.floor(place), values.length - 1), above = Math.min(below + 1, values.length - 1);
    const share = place - below, a = values[below], b = values[above];
    if (a === null || b === null) return share < 0.5 ? a : b;
    return a + (b - a) * share;
  }

  // A row of a flat table x, y, cos, sin; the direction keeps its length.
  function pose(table, place) {
    const count = table.length / 4, below = Math.min(Math.max(Math.floor(place), 0), count - 1), above = Math.min(below + 1, count - 1);
    const share = Math.min(Math.max(place - below, 0), 1), at = (row, k) => table[4 * row + k];
    if (at(below, 0) === null || at(above, 0) === null) {
      const row = at(below, 0) === null ? above : below;
      return at(row, 0) === null ? null : [0, 1, 2, 3].map((k) => at(row, k));
    }
    const mixed = [0, 1, 2, 3].map((k) => at(below, k) + (at(above, k) - at(below, k)) * share);
    const size = Math.hypot(mixed[2], mixed[3]) || 1;
    return [mixed[0], mixed[1], mixed[2] / size, mixed[3] / size];
  }

  // A row of such a table as it is.
  const exactly = (table, row) => (table[4 * row] === null ? null : [0, 1, 2, 3].map((k) => table[4 * row + k]));

  // Plays a figure: what moves in it, over the columns and charts of its page. It can be
  // given another motion, and other pictures of it, later.
  function player(figure, given, source) {
    let data, stock, axis, key, values, times, closed, timed, count, columns, cells, poses = [];
    let factor = given.magnify ? given.magnify.factor : 1, gain = 1;
    let place = 0, playing = false, last = null, clock = 0;
    const controls = figure.querySelector(".controls"), grid = given.sliders || null;

    function take(next, { columns: all, plots }) {
      data = next;
      stock = all;
      const clockwork = data.times === null ? null : all[data.times];
      axis = data.axis || { name: "t", unit: "s", values: clockwork, times: clockwork, closed: false };
      // The charts whose horizontal axis this one is.
      const over = plots.map((plot) => plot.x).find((x) => x.unit === axis.unit);
      key = over && !grid ? `${over.name} ${over.unit}` : null;
      ({ values, times, closed } = axis);
      count = values.length;
      // Where the times say nothing, rows follow each other evenly.
      timed = times.length === count && times.every((t, i) => t !== null && (i === 0 || t >= times[i - 1])) && times[count - 1] > times[0];
      columns = data.columns.map((one) => column(one, all));
    }

    // What moves in pictures as they are, those of the page or copies.
    function parts(root) {
      // Parts are numbered from the `data-first` on that they are in.
      const first = (node) => +(node.closest("[data-first]")?.dataset.first ?? 0);
      return {
        links: [...root.querySelectorAll("svg.mechanism [data-link]")].map((node) => ({ node, body: first(node) + +node.dataset.link })),
        pins: [...root.querySelectorAll("svg.mechanism [data-on]")].filter((node) => +node.dataset.on >= 0)
          .map((node) => ({ node, body: first(node) + +node.dataset.on, at: node.dataset.at.split(" ").map(Number) })),
        sets: data.sets.map((_, index) => root.querySelector(`[data-set="${index}"]`)),
        words: [...root.querySelectorAll("[data-column]")],
      };
    }

    take(given, source);
    if (!count) return null;
    let shown = parts(figure);
    cells = data.readings.map((reading) => {
      const list = figure.querySelector(".readings"), name = document.createElement("dt"), value = document.createElement("dd");
      name.textContent = reading.name;
      list.append(name, value);
      return value;
    });

    // The coordinate of a part: as it is, on its law, or with its deviation magnified.
    function coordinate(body, at) {
      const { values: own, deviation } = columns[body.column];
      const share = body.shown === "law" ? -1 : body.shown === "magnified" ? factor - 1 : 0;
      return between(own, at) + share * between(deviation, at);
    }

    function placed(body, at) {
      if (body.kind === "rows") return grid ? exactly(body.table, at) : pose(body.table, at);
      const q = coordinate(body, at);
      if (q === null || !isFinite(q)) return null;
      if (body.kind === "turn") {
        const angle = body.offset + body.sense * q;
        return [body.at[0], body.at[1], Math.cos(angle), Math.sin(angle), angle];
      }
      if (body.kind === "slide") return [body.at[0] + body.by[0] * q, body.at[1] + body.by[1] * q, 1, 0];
      let share = (q - body.from) / (body.to - body.from);
      share = body.repeats ? share - Math.floor(share) : Math.min(Math.max(share, 0), 1);
      return pose(body.table, share * (body.table.length / 4 - 1));
    }

    // Where a point of a part is.
    const pointOf = (pose, [px, py]) => [pose[0] + pose[2] * px + pose[3] * py, pose[1] - pose[3] * px + pose[2] * py];
    // Length of the longest arrow of a set in a row, and in all rows (pixels).
    const longest = (set, row) => set.arrows.reduce((most, arrow) => Math.max(most, Math.hypot(arrow[4 * row + 2] ?? 0, arrow[4 * row + 3] ?? 0)), 0);
    const longestOfAll = (set) => set.most ??= values.reduce((most, _, row) => Math.max(most, longest(set, row)), 0);
    // What the arrows of a set are multiplied by: the same in every row, or in each so that the longest is.
    const gainOf = (set, row) => gain ? gain : longest(set, row) > 0 ? longestOfAll(set) / longest(set, row) : 1;
    // The arrows of a set at a place: their ends; null where one is too short to be seen.
    function arrowsAt(set, poses, place) {
      const row = Math.round(place), by = gainOf(set, row), long = (x, y, dx, dy) => x !== null && dx !== null && Math.hypot(by * dx, by * dy) >= 1 ? { x1: x, y1: y, x2: x + by * dx, y2: y + by * dy } : null;
      const on = (set.on ?? []).map(({ body, origin, at, by, fixed, column }) => {
        const pose = poses[body], force = between(stock[column], place);
        if (!pose || force === null) return null;
        const [x, y] = pointOf(pose, at), free = fixed ? [0, 0, 1, 0] : pose, [dx, dy] = pointOf([0, 0, free[2], free[3]], [force * by[0], force * by[1]]);
        return long(origin[0] + x, origin[1] + y, dx, dy);
      });
      return [...set.arrows.map((arrow) => long(...arrow.slice(4 * row, 4 * row + 4))), ...on];
    }

    // Places all parts of pictures, and tells the numbers in them.
    function paint({ links, pins, sets, words }, poses, at) {
      for (const { node, body } of links) {
        const pose = poses[body];
        node.setAttribute("visibility", pose ? "inherit" : "hidden");
        if (pose) node.setAttribute("transform", `matrix(${pose[2]} ${-pose[3]} ${pose[3]} ${pose[2]} ${pose[0]} ${pose[1]})`);
      }
      for (const { node, body, at: point } of pins) {
        const pose = poses[body];
        node.setAttribute("visibility", pose ? "inherit" : "hidden");
        if (pose) node.setAttribute("transform", `translate(${pointOf(pose, point).map((one) => one.toFixed(2)).join(" ")})`);
      }
      data.sets.forEach((set, index) => {
        const nodes = sets[index].querySelectorAll("line");
        arrowsAt(set, poses, at).forEach((ends, i) => {
          nodes[i].setAttribute("visibility", ends ? "inherit" : "hidden");
          for (const [name, value] of Object.entries(ends ?? {})) nodes[i].setAttribute(name, value);
        });
      });
      for (const node of words) {
        const { values: own, deviation } = columns[node.dataset.column];
        const { scale, unit, deltaScale, deltaUnit } = node.dataset;
        node.textContent = `φ ${short(between(own, at) * scale)} ${unit}` + (deviation ? `, δ ${short(between(deviation, at) * deltaScale)} ${deltaUnit}` : "");
      }
    }

    function show(at) {
      place = at;
      poses = data.bodies.map((body) => placed(body, at));
      const row = Math.round(at);
      paint(shown, poses, at);
      if (!gain) switches.forEach(({ name }, index) => { name.data = caption(data.sets[index], row); });
      data.readings.forEach((reading, index) => {
        const value = reading.values[row];
        cells[index].textContent = value === null ? "straight" : `${number(value)} ${reading.unit}`;
      });
      const value = between(values, at);
      if (grid) { readings(); return value; }
      slider.value = data.axis ? at : clockAt(at);
      reading.textContent = minus(`${axis.name} ${data.axis ? +value.toPrecision(6) : number(value)} ${axis.unit}`);
      return value;
    }

    // Row of a value of the axis.
    function rowOf(value) {
      const rising = values[count - 1] >= values[0];
      let low = 0, high = count - 1;
      while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (rising ? values[middle] <= value : values[middle] >= value) low = middle; else high = middle;
      }
      const span = values[high] - values[low];
      return span === 0 ? low : low + Math.min(1, Math.max(0, (value - values[low]) / span));
    }
    const goTo = (value) => show(rowOf(value));
    const tell = (value) => { if (key) document.dispatchEvent(new CustomEvent("instant", { detail: { axis: key, value, by: "player" } })); };

    const clockAt = (row) => timed ? (between(times, row) - times[0]) / (times[count - 1] - times[0]) : row / Math.max(1, count - 1);
    function rowAt(share) {
      if (!timed) return share * (count - 1);
      const time = times[0] + share * (times[count - 1] - times[0]);
      let low = 0, high = count - 1;
      while (high - low > 1) { const middle = (low + high) >> 1; if (times[middle] <= time) low = middle; else high = middle; }
      const span = times[high] - times[low];
      return span > 0 ? low + Math.min(1, (time - times[low]) / span) : high;
    }
    function step(now) {
      if (!playing) return;
      if (last !== null) clock += (now - last) / (1000 * data.seconds / +pace.value);
      last = now;
      if (clock > 1) clock = closed ? clock % 1 : 1;
      tell(show(rowAt(clock)));
      if (clock >= 1 && !closed) { toggle(); return; }
      requestAnimationFrame(step);
    }
    function toggle() {
      playing = !playing;
      button.textContent = playing ? "pause" : "play";
      if (playing) { clock = place >= count - 1 ? 0 : clockAt(place); last = null; requestAnimationFrame(step); }
    }

    // What a picture that runs by itself goes through: rows, the shares of the time at which it is
    // there, and how long it takes (s). All rows; of a run with turns one of the drive, from the
    // instant that is shown on or the last; of a grid the first input there and back.
    function course() {
      if (grid) {
        const first = grid[0].values.length, base = Math.floor(place / first) * first, there = Array.from({ length: first }, (_, k) => base + k);
        const rows = [...there, ...there.toReversed().slice(1)];
        return { rows, at: rows.map((_, k) => k / (rows.length - 1)), seconds: data.seconds };
      }
      let [from, to] = [0, count - 1];
      if (data.turn && timed && data.turn < times[to] - times[0]) {
        const begin = Math.min(between(times, place), times[to] - data.turn);
        [from, to] = [rowOf(begin), rowOf(begin + data.turn)];
      }
      const begin = clockAt(from), span = clockAt(to) - begin, step = Math.max(1, Math.ceil((to - from) / MOST)), rows = [from];
      for (let row = Math.floor(from) + 1; row < to - 1e-9; row += step) rows.push(row);
      rows.push(to);
      return { rows, at: rows.map((row) => (clockAt(row) - begin) / span), seconds: data.seconds * span / +pace.value };
    }
    const posesAt = (row) => data.bodies.map((body) => placed(body, row));
    // Copies of the drawings, without the arrows that are not shown.
    function copied() {
      const { all, size } = picture.sheet([...figure.querySelectorAll("svg.mechanism")]), own = parts(all);
      return { all, size, own };
    }
    function running() {
      const { all, own } = copied(), { rows, at, seconds } = course(), steps = rows.map(posesAt);
      paint(own, steps[0], rows[0]);
      // Numbers do not run.
      own.words.forEach((node) => node.remove());
      const angled = (pose) => pose && [pose[0], pose[1], pose[4] ?? Math.atan2(pose[3], pose[2]), pose[4] !== undefined];
      for (const { node, body } of own.links) picture.moves(node, at, seconds, steps.map((poses) => angled(poses[body])));
      for (const { node, body, at: point } of own.pins) picture.moves(node, at, seconds, steps.map((poses) => poses[body] && [...pointOf(poses[body], point), 0]));
      data.sets.forEach((set, index) => {
        if (own.sets[index].getAttribute("visibility") === "hidden") { own.sets[index].remove(); return; }
        const nodes = own.sets[index].querySelectorAll("line"), all = rows.map((row, k) => arrowsAt(set, steps[k], row));
        nodes.forEach((_, i) => {
          const ends = all.map((arrows) => arrows[i]);
          picture.shows(nodes[i], at, seconds, ends.map((one) => one !== null));
          let last = ends.find((one) => one !== null);
          if (last) for (const name of ["x1", "y1", "x2", "y2"]) picture.runs(nodes[i], at, seconds, { name, values: ends.map((one) => +(last = one ?? last)[name].toFixed(2)) });
        });
      });
      return picture.written(all);
    }
    function filmed(tell) {
      const { all, size, own } = copied(), { rows, at, seconds } = course(), frames = Math.max(2, Math.min(LONGEST, Math.round(RATE * seconds)));
      const frame = (k) => {
        const share = k / frames, above = Math.max(1, at.findIndex((one) => one > share)), span = at[above] - at[above - 1];
        const row = rows[above - 1] + (rows[above] - rows[above - 1]) * (span > 0 ? (share - at[above - 1]) / span : 0), whole = grid ? Math.round(row) : row;
        paint(own, posesAt(whole), whole);
        return all;
      };
      return picture.gif({ size, frames, seconds, frame, tell });
    }

    // Groups of controls stay together where the row is too short for all.
    let group = controls;
    const grouped = (name) => { group = controls.appendChild(Object.assign(document.createElement("span"), { className: `group ${name}` })); };
    const make = (name, properties) => { const node = Object.assign(document.createElement(name), properties); group.appendChild(node); return node; };
    const labelled = (name, text, properties) => {
      const label = make("label", {}), node = Object.assign(document.createElement(name), properties);
      label.append(text, node);
      return node;
    };
    let button, slider, reading, pace, readings;
    // A slider for each input of a grid; else one for the axis, and what plays it.
    if (grid) {
      let rest = data.start || 0;
      const inputs = grid.map((input) => {
        const last = input.values.length - 1, own = labelled("input", `${input.name} `, { type: "range", min: 0, max: last, step: 1, value: rest % (last + 1) });
        rest = Math.floor(rest / (last + 1));
        own.addEventListener("input", () => show(rowOfAll()));
        return { own, input, told: make("output", {}) };
      });
      const rowOfAll = () => inputs.reduceRight((row, { own, input }) => row * input.values.length + +own.value, 0);
      const state = make("output", {});
      readings = () => {
        for (const { own, input, told } of inputs) told.textContent = minus(`${number(input.values[+own.value])} ${input.unit}`);
        state.textContent = poses.every((pose) => pose === null) ? "cannot be assembled" : "";
      };
    } else {
      grouped("course");
      button = make("button", { type: "button", textContent: "play" });
      button.addEventListener("click", toggle);
      slider = make("input", { type: "range", min: 0, max: data.axis ? count - 1 : 1, step: "any", value: 0 });
      slider.setAttribute("aria-label", axis.name);
      slider.addEventListener("input", () => { if (playing) toggle(); tell(show(data.axis ? +slider.value : rowAt(+slider.value))); });
      reading = make("output", {});
      pace = make("select", { title: "speed of playing" });
      pace.setAttribute("aria-label", "speed of playing");
      for (const [value, text] of [[0.1, "slowest"], [0.25, "slow"], [1, "normal"], [4, "fast"], [16, "fastest"]]) pace.add(new Option(text, value, value === 1, value === 1));
    }
    group = controls;
    if (data.magnify) {
      const choice = labelled("select", "deflection δ ", { title: "factor by which the deflection is magnified" });
      for (const value of data.magnify.choices) choice.add(new Option(value === 1 ? "true to scale" : `× ${value}`, value, value === factor, value === factor));
      choice.addEventListener("change", () => { factor = +choice.value; show(place); });
    }
    const check = (text, shown, change) => {
      const label = make("label", {}), box = Object.assign(document.createElement("input"), { type: "checkbox", checked: shown }), name = document.createTextNode(text);
      label.append(box, name);
      box.addEventListener("change", () => change(box.checked));
      return { box, name };
    };
    const turn = (index, on) => shown.sets[index].setAttribute("visibility", on ? "visible" : "hidden");
    const switches = data.sets.map((set, index) => check(set.caption, set.shown, (on) => turn(index, on)));
    // What the arrows of a set show; where each position has a scale of its own, how much its longest is.
    const caption = (set, row) => {
      if (gain || !set.greatest) return set.caption;
      const share = longestOfAll(set) > 0 ? longest(set, row) / longestOfAll(set) : 0;
      return `${set.name}, longest here ${numbers.withUnit(set.greatest[0] * share, set.greatest[1], 4)}`;
    };
    if (data.sets.some((set) => set.greatest)) {
      const choice = labelled("select", "arrows ", { title: "length of the arrows: one scale for all positions, or one for each" });
      for (const [value, text] of [[1, "one scale"], [2, "× 2"], [5, "× 5"], [10, "× 10"], [100, "× 100"], [0, "scale of each position"]]) choice.add(new Option(text, value, value === 1, value === 1));
      choice.addEventListener("change", () => {
        gain = +choice.value;
        switches.forEach(({ name }, index) => { name.data = caption(data.sets[index], Math.round(place)); });
        show(place);
      });
    }
    if (figure.querySelector("[data-path]")) check("paths", true, (on) => figure.querySelectorAll("[data-path]").forEach((node) => node.setAttribute("visibility", on ? "visible" : "hidden")));
    const offer = (text, title, make) => {
      const button = Object.assign(document.createElement("button"), { type: "button", textContent: text, title });
      button.addEventListener("click", async () => {
        button.disabled = true;
        try {
          picture.save(`${figure.id || "machine"}.${text.toLowerCase()}`, await make((share) => { button.textContent = `${text} ${Math.round(100 * share)} %`; }));
          button.textContent = text;
        } catch (error) { button.textContent = `${text}: ${error.message}`; }
        button.disabled = false;
      });
      group.append(button);
    };
    grouped("saves");
    offer("SVG", "saves the moving drawing as an SVG that runs by itself, for slides and sites", running);
    offer("GIF", "saves the moving drawing as an animated GIF", filmed);
    const follow = (event) => {
      const { axis: told, value, by } = event.detail;
      if (by !== "player" && told === key && value !== null && !playing) goTo(value);
    };
    document.addEventListener("instant", follow);
    // What the pointer rests on: the part with its place and angle, or its displacement.
    figure.addEventListener("pointermove", (event) => {
      const svg = event.target.closest("svg.mechanism");
      if (!svg) { pointed(event, null); return; }
      const node = event.target.closest("[data-link]");
      const link = node && shown.links.find((one) => one.node === node), body = link && data.bodies[link.body], pose = link && poses[link.body];
      const name = link ? data.names[link.body] : null, lines = [];
      if (name) lines.push(name);
      if (data.scale) {
        const [metres, x0, y0] = data.scale, point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
        const length = (pixels) => numbers.withUnit(pixels * metres, "m", 4);
        if (pose) lines.push(`origin (${length(pose[0] - x0)}, ${length(y0 - pose[1])}), angle ${significant(Math.atan2(pose[3], pose[2]) * 180 / Math.PI, 5)}°`);
        lines.push(`pointer (${length(point.x - x0)}, ${length(y0 - point.y)})`);
      } else if (body && body.column !== undefined) {
        const word = shown.words.find((one) => +one.dataset.column === body.column);
        if (word) lines.push(word.textContent);
      }
      pointed(event, lines);
    });
    figure.addEventListener("pointerleave", (event) => pointed(event, null));
    show(grid ? data.start || 0 : 0);

    // Another motion at the same instant; `pictures`: what it is drawn in now, where that is another.
    function update(next, source, pictures) {
      const at = values[Math.min(Math.round(place), count - 1)], row = place;
      take(next, source);
      if (pictures !== undefined) figure.querySelector(".stations").outerHTML = pictures;
      if (pictures !== undefined) shown = parts(figure);
      switches.forEach(({ box, name }, index) => { name.data = caption(data.sets[index], Math.round(place)); turn(index, box.checked); });
      show(timed && at <= values[count - 1] ? rowOf(at) : Math.min(row, count - 1));
    }
    function stop() {
      playing = false;
      document.removeEventListener("instant", follow);
    }
    return { update, stop, running };
  }
  for (const figure of document.querySelectorAll("figure.moving")) player(figure, JSON.parse(document.getElementById(`${figure.id}-data`).textContent), page);
  return { player };
})();
