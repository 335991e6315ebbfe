"use strict";
// Pictures of a page as files that need nothing else: as they look, running by themselves (SVG),
// and as an animated GIF.
const picture = (() => {
  const NAMES = "http://www.w3.org/2000/svg";
  // The colour of a GIF that is none: what is there stays.
  const NOTHING = 255;
  const LOOK = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-linecap", "stroke-linejoin", "stroke-opacity", "opacity", "font-family", "font-size", "font-weight", "font-style", "text-anchor", "visibility", "display", "paint-order"];
  const make = (name, attributes) => {
    const node = document.createElementNS(NAMES, name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    return node;
  };
  const written = (svg) => new XMLSerializer().serializeToString(svg);

  // A copy with all colours in it: what reads it need not know the page's style.
  function alone(svg) {
    const copy = svg.cloneNode(true), own = [...svg.querySelectorAll("*")], other = [...copy.querySelectorAll("*")];
    own.forEach((node, k) => {
      const look = getComputedStyle(node), before = node.parentElement ? getComputedStyle(node.parentElement) : null;
      for (const name of LOOK) {
        const value = look.getPropertyValue(name), inherited = !["opacity", "display"].includes(name);
        if (value && !(inherited && node.parentElement !== svg && before?.getPropertyValue(name) === value)) other[k].setAttribute(name, value);
      }
    });
    // What follows the pointer is no part of it.
    copy.querySelectorAll(".over, .pad").forEach((node) => node.remove());
    // Nothing of the page is there to go to.
    copy.querySelectorAll("a").forEach((node) => node.removeAttribute("href"));
    const [,, width, height] = copy.getAttribute("viewBox").split(" ").map(Number);
    copy.prepend(make("rect", { width, height, fill: getComputedStyle(document.body).backgroundColor }));
    for (const [name, value] of [["xmlns", NAMES], ["width", width], ["height", height]]) copy.setAttribute(name, value);
    return copy;
  }

  // Several drawings in one, placed as on the page; one alone in its own size.
  function sheet(drawings) {
    const boxes = drawings.map((svg) => svg.getBoundingClientRect());
    const left = Math.min(...boxes.map((box) => box.left)), top = Math.min(...boxes.map((box) => box.top));
    const copies = drawings.map((svg, k) => {
      const copy = alone(svg);
      if (drawings.length > 1) for (const [name, value] of [["x", boxes[k].left - left], ["y", boxes[k].top - top], ["width", boxes[k].width], ["height", boxes[k].height]]) copy.setAttribute(name, value);
      return copy;
    });
    const far = (place, size) => Math.ceil(Math.max(...copies.map((copy) => +copy.getAttribute(place) + +copy.getAttribute(size))));
    const size = [far("x", "width"), far("y", "height")], all = make("svg", { xmlns: NAMES, width: size[0], height: size[1], viewBox: `0 0 ${size.join(" ")}` });
    all.append(make("rect", { width: size[0], height: size[1], fill: getComputedStyle(document.body).backgroundColor }), ...copies);
    return { all, size };
  }

  const same = (list) => list.every((one) => one === list[0]);

  // Lets an attribute of a node go through values, at shares of a time that repeats.
  function runs(node, at, seconds, { name, values, turns, steps, adds }) {
    const even = !steps && at.every((share, k) => Math.abs(share * (at.length - 1) - k) < 1e-6);
    const tag = turns ? "animateTransform" : "animate", constant = same(values);
    const track = { attributeName: name, dur: `${+seconds.toFixed(3)}s`, repeatCount: "indefinite", values: (constant ? [values[0], values[0]] : values).join(";") };
    if (turns) track.type = turns;
    if (adds) track.additive = "sum";
    if (steps && !constant) track.calcMode = "discrete";
    if (!even && !constant) track.keyTimes = at.map((share) => +share.toFixed(5)).join(";");
    node.append(make(tag, track));
  }

  // A value where there is one, else the one before it, at the beginning the first.
  function filled(list) {
    let last = list.find((one) => one !== null) ?? null;
    return list.map((one) => (last = one ?? last));
  }

  // Lets a node go through poses x, y and angle (rad, counterclockwise); it is hidden where there is none.
  function moves(node, at, seconds, poses) {
    const known = filled(poses), places = known.map((pose) => pose ? `${+pose[0].toFixed(2)} ${+pose[1].toFixed(2)}` : "0 0");
    shows(node, at, seconds, poses.map((pose) => pose !== null));
    // It turns on where the angle goes once round.
    let angle = known[0]?.[2] ?? 0;
    const turned = known.map((pose) => {
      if (pose) angle += pose[3] ? pose[2] - angle : Math.atan2(Math.sin(pose[2] - angle), Math.cos(pose[2] - angle));
      return `${+(-angle * 180 / Math.PI).toFixed(3)}`;
    });
    if (same(places) && same(turned)) return;
    runs(node, at, seconds, { name: "transform", values: places, turns: "translate" });
    if (turned.some((one) => +one !== 0)) runs(node, at, seconds, { name: "transform", values: turned, turns: "rotate", adds: true });
  }

  function shows(node, at, seconds, seen) {
    node.setAttribute("visibility", seen[0] ? "inherit" : "hidden");
    if (!same(seen)) runs(node, at, seconds, { name: "visibility", values: seen.map((one) => one ? "inherit" : "hidden"), steps: true });
  }

  // The colours that are most frequent in some frames, one of each small range, and the number of
  // that which is nearest to another.
  function colours(frames) {
    const counts = new Map(), range = (rgb) => (rgb >> 19 & 31) << 10 | (rgb >> 11 & 31) << 5 | rgb >> 3 & 31;
    const of = (data, i) => data[i] << 16 | data[i + 1] << 8 | data[i + 2];
    for (const data of frames) for (let i = 0; i < data.length; i += 4) { const rgb = of(data, i); counts.set(rgb, (counts.get(rgb) ?? 0) + 1); }
    const known = new Int16Array(32768).fill(-1), table = [];
    for (const [rgb] of [...counts].sort((a, b) => b[1] - a[1])) {
      if (table.length === NOTHING) break;
      if (known[range(rgb)] < 0) known[range(rgb)] = table.push([rgb >> 16, rgb >> 8 & 255, rgb & 255]) - 1;
    }
    const nearest = (data, i) => {
      const rgb = range(of(data, i));
      if (known[rgb] < 0) {
        const far = table.map(([r, g, b]) => (r - data[i]) ** 2 + (g - data[i + 1]) ** 2 + (b - data[i + 2]) ** 2);
        known[rgb] = far.indexOf(Math.min(...far));
      }
      return known[rgb];
    };
    return { table, nearest };
  }

  // Bytes by the algorithm of Lempel, Ziv and Welch, as GIF has them: codes of 9 to 12 bits.
  function compressed(pixels) {
    const CLEAR = 256, END = 257, out = [], codes = new Uint16Array(1 << 20);
    let held = 0, bits = 0, size = 9, next = END + 1, prefix = pixels[0];
    const put = (code) => {
      held |= code << bits;
      for (bits += size; bits >= 8; bits -= 8) { out.push(held & 255); held >>>= 8; }
    };
    put(CLEAR);
    for (let i = 1; i < pixels.length; i++) {
      const place = prefix << 8 | pixels[i];
      if (codes[place]) { prefix = codes[place]; continue; }
      put(prefix);
      if (next === 4096) {
        put(CLEAR);
        codes.fill(0);
        next = END + 1;
        size = 9;
      } else {
        if (next >= 1 << size) size++;
        codes[place] = next++;
      }
      prefix = pixels[i];
    }
    put(prefix);
    put(END);
    if (bits > 0) out.push(held & 255);
    const blocks = [8];
    for (let i = 0; i < out.length; i += 255) { const block = out.slice(i, i + 255); blocks.push(block.length, ...block); }
    return [...blocks, 0];
  }

  const two = (value) => [value & 255, value >> 8];

  // The part of a frame that differs from the one before, in numbers of colours; elsewhere nothing.
  function change(now, before, width, height) {
    let [left, top, right, foot] = [width, height, -1, -1];
    for (let y = 0, i = 0; y < height; y++) for (let x = 0; x < width; x++, i++) if (!before || now[i] !== before[i]) {
      if (x < left) left = x;
      if (x > right) right = x;
      if (y < top) top = y;
      foot = y;
    }
    if (right < 0) return { box: [0, 0, 1, 1], pixels: [NOTHING] };
    const box = [left, top, right - left + 1, foot - top + 1], pixels = new Uint8Array(box[2] * box[3]);
    for (let y = top, k = 0; y <= foot; y++) for (let x = left; x <= right; x++, k++) {
      const i = y * width + x;
      pixels[k] = before && now[i] === before[i] ? NOTHING : now[i];
    }
    return { box, pixels };
  }

  // An animated GIF that repeats: `frame(k)` is the picture of each instant; `tell` hears the share done.
  async function gif({ size: [width, height], frames, seconds, frame, tell }) {
    const canvas = Object.assign(document.createElement("canvas"), { width, height }), pen = canvas.getContext("2d", { willReadFrequently: true });
    const drawn = async (k) => {
      const image = new Image();
      image.src = `data:image/svg+xml,${encodeURIComponent(written(frame(k)))}`;
      await image.decode();
      pen.drawImage(image, 0, 0, width, height);
      return pen.getImageData(0, 0, width, height).data;
    };
    const some = [];
    for (let k = 0; k < 6; k++) some.push(await drawn(Math.floor(k * frames / 6)));
    const { table, nearest } = colours(some);
    const bytes = (list) => Uint8Array.from(list), parts = [
      bytes([..."GIF89a"].map((letter) => letter.charCodeAt(0))), bytes([...two(width), ...two(height), 0xf7, 0, 0]),
      bytes(Array.from({ length: 768 }, (_, i) => table[Math.floor(i / 3)]?.[i % 3] ?? 0)),
      bytes([0x21, 0xff, 11, ...[..."NETSCAPE2.0"].map((letter) => letter.charCodeAt(0)), 3, 1, 0, 0, 0]),
    ];
    let before = null;
    for (let k = 0; k < frames; k++) {
      const data = await drawn(k), now = new Uint8Array(width * height);
      for (let i = 0; i < now.length; i++) now[i] = nearest(data, 4 * i);
      const { box, pixels } = change(now, before, width, height), time = (share) => Math.round(100 * seconds * share / frames);
      parts.push(bytes([0x21, 0xf9, 4, 0x05, ...two(time(k + 1) - time(k)), NOTHING, 0, 0x2c, ...box.flatMap(two), 0]), bytes(compressed(pixels)));
      before = now;
      tell((k + 1) / frames);
    }
    return new Blob([...parts, bytes([0x3b])], { type: "image/gif" });
  }

  function save(name, content) {
    const types = { svg: "image/svg+xml", png: "image/png", html: "text/html" }, type = types[name.split(".").pop()] ?? "text/plain";
    const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
    Object.assign(document.createElement("a"), { href: url, download: name }).click();
    // The browser has taken it by then.
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
  }

  return { alone, written, sheet, runs, moves, shows, gif, save };
})();
