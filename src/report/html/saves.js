"use strict";
// Each chart of a page is saved as a picture that needs nothing else: as it looks now, zoomed and
// switched, in the colours of the page.
(() => {
  // Pixels of a PNG a pixel of the page.
  const SHARP = 2;
  const drawn = (chart) => completed(picture.alone(chart.querySelector("svg.dam-plot")));

  // Hatchings that stand in another picture of the page are in the copy too.
  function completed(copy) {
    const wanted = new Set([...picture.written(copy).matchAll(/url\([^)#]*#([\w-]+)/g)].map(([, id]) => id));
    for (const id of wanted) {
      const there = document.getElementById(id);
      if (!there || copy.querySelector(`#${id}`)) continue;
      const node = there.cloneNode(true), [own, other] = [there, node].map((one) => [one, ...one.querySelectorAll("*")]);
      own.forEach((one, k) => ["fill", "stroke", "stroke-width"].forEach((name) => other[k].setAttribute(name, getComputedStyle(one).getPropertyValue(name))));
      copy.prepend(node);
    }
    return copy;
  }

  // Name of the file, of what the chart is called.
  function named(chart, kind) {
    const { title, id } = page.plots[+chart.querySelector("g.plot").dataset.plot];
    const name = (id || title).normalize("NFC").replace(/[^\p{L}\p{N}.]+/gu, "-").replace(/^-+|-+$/g, "");
    return `${name || "chart"}.${kind}`;
  }

  const content = {
    svg: async (chart) => picture.written(drawn(chart)),
    png: async (chart) => {
      const svg = drawn(chart), [width, height] = ["width", "height"].map((name) => Math.round(SHARP * svg.getAttribute(name)));
      const image = new Image(), canvas = Object.assign(document.createElement("canvas"), { width, height });
      image.src = `data:image/svg+xml,${encodeURIComponent(picture.written(svg))}`;
      await image.decode();
      canvas.getContext("2d").drawImage(image, 0, 0, width, height);
      const letters = atob(canvas.toDataURL("image/png").split(",")[1]);
      return new Blob([Uint8Array.from(letters, (letter) => letter.charCodeAt(0))], { type: "image/png" });
    },
  };

  for (const chart of document.querySelectorAll(".chart:has(g.plot)")) {
    const bar = Object.assign(document.createElement("div"), { className: "saves" });
    for (const kind of Object.keys(content)) {
      const button = Object.assign(document.createElement("button"), { type: "button", textContent: kind.toUpperCase(), title: `save this chart as ${kind.toUpperCase()}` });
      button.setAttribute("aria-label", button.title);
      button.addEventListener("click", async () => picture.save(named(chart, kind), await content[kind](chart)));
      bar.append(button);
    }
    chart.append(bar);
  }
})();
