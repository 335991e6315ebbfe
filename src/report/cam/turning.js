"use strict";
// Turns the cam and moves its follower; one reading for each place of the turn.
(() => {
  const data = JSON.parse(document.getElementById("turning").textContent);
  const cam = document.getElementById("cam-turning");
  const follower = document.getElementById("cam-follower");
  const slider = document.getElementById("cam-angle");
  const button = document.getElementById("cam-play");
  const reading = document.getElementById("cam-reading");
  const last = data.lift.length - 1;
  const SECONDS = 6;
  const cells = data.columns.map((column) => {
    const name = document.createElement("dt");
    const value = document.createElement("dd");
    name.textContent = column.name;
    reading.append(name, value);
    return value;
  });

  // A line at the present angle in every diagram: frame from 66 to width - 18 pixels.
  const charts = document.querySelector(".charts");
  const lines = [...charts.querySelectorAll("svg")].map((svg) => {
    const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
    line.setAttribute("class", "now");
    svg.append(line);
    return { line, width: svg.viewBox.baseVal.width, height: svg.viewBox.baseVal.height };
  });

  const words = (value, unit) => {
    if (value === null) return "straight";
    const size = Math.abs(value);
    const text = size !== 0 && (size < 1e-3 || size >= 1e6) ? value.toExponential(3) : Number(value.toPrecision(5)).toString();
    return `${text.replace("-", "−")} ${unit}`;
  };

  const show = (place) => {
    const below = Math.min(Math.floor(place), last - 1);
    const share = place - below;
    const lift = data.lift[below] * (1 - share) + data.lift[below + 1] * share;
    const phi = data.from + ((data.to - data.from) * place) / last;
    cam.setAttribute("transform", `rotate(${data.cam * phi} ${data.axis[0]} ${data.axis[1]})`);
    follower.setAttribute(
      "transform",
      `translate(${data.shift[0] * lift} ${data.shift[1] * lift}) rotate(${data.turn * lift} ${data.about[0]} ${data.about[1]})`
    );
    const nearest = Math.round(place);
    data.columns.forEach((column, index) => {
      cells[index].textContent = words(column.values[nearest], column.unit);
    });
    for (const { line, width, height } of lines) {
      const x = 66 + (place / last) * (width - 84);
      line.setAttribute("d", `M${x} 38V${height - 44}`);
    }
    slider.value = String(nearest);
  };

  let place = 0;
  let direction = 1;
  let playing = false;
  let before = 0;
  const step = (now) => {
    if (!playing) return;
    place += (direction * (now - before) * last) / (1000 * SECONDS);
    before = now;
    if (data.closed) place %= last;
    else if (place > last || place < 0) {
      // An open profile is run there and back.
      direction = place > last ? -1 : 1;
      place = Math.min(Math.max(place, 0), last);
    }
    show(place);
    requestAnimationFrame(step);
  };
  button.addEventListener("click", () => {
    playing = !playing;
    button.textContent = playing ? "Pause" : "Turn";
    before = performance.now();
    if (playing) requestAnimationFrame(step);
  });
  slider.addEventListener("input", () => {
    place = Number(slider.value);
    show(place);
  });
  show(0);
})();
