// How long a move of a slider takes to the frame that shows its answer, measured in Chromium:
// from the time stamp of the input event to the presentation of the first frame behind the
// answer (the browser's trace), 1000 moves at 60 a second; then the same while the map follows.
//
//     DAM=target/release/dam npm --prefix studio run latency [-- scenario.json] [--moves 1000] [--press] [--even]
//     npm --prefix studio run latency -- --empty 4
//
// Each move comes at another place of its sixtieth, as how moves and frames lie to each other changes
// the result by half a frame; `--even`: at even distances. `--empty`: no studio, but a page with a
// slider and a number, which is another so many milliseconds after a move: what the browser takes.
// Behind the studio stands that page in the same browser, with a number that is another 4 ms after a move:
// 95 % of the moves are to be shown at most 20 ms later than there, at 3 times the processor time of the
// process that draws the page (all that it does from the first move to the last answer).
// `--press`: the press with its ejector, whose run takes longer, without a map; 95 % of its moves are
// to be shown within 100 ms, of others within 33 ms. Writes latency/latency.json, latency/latency.md
// and latency/latency.svg, of the press latency/press.json and so on.

import { chromium } from "@playwright/test";
import { mkdirSync, writeFileSync } from "node:fs";
import { cpus, loadavg } from "node:os";
import { basename, join, dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { browser as options, Server } from "./tests/server.mjs";

const {
  values: { press, moves: count, even, empty },
  positionals: [given],
} = parseArgs({
  allowPositionals: true,
  options: {
    press: { type: "boolean", default: false },
    moves: { type: "string", default: "1000" },
    even: { type: "boolean", default: false },
    empty: { type: "string" },
  },
});
const scenario = given ?? (press ? "scenarios/press/ejector.json" : "scenarios/rocker/two_masses.json"),
  moves = Number(count);
if (!Number.isInteger(moves) || moves < 1) throw new Error(`--moves ${count} is no number of moves`);
// What a move may take (ms), and what the files are called.
const DELAY = 4,
  target = press ? 100 : 33,
  name = press ? "press" : "latency",
  load = loadavg()[0];
const out = join(dirname(fileURLToPath(import.meta.url)), "latency");
mkdirSync(out, { recursive: true });
const quantile = (list, part) => {
  const sorted = [...list].sort((a, b) => a - b);
  return sorted.length ? sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))] : NaN;
};

// In the page: every input event with its time and the version that it makes, every answer
// with the time of the frame that follows it.
const watch = () => {
  const seen = (window.seen = { inputs: [], pushes: [], answers: [], maps: [] });
  addEventListener(
    "pointerrawupdate",
    (event) => {
      if (event.target.type === "range") seen.inputs.push(event.timeStamp);
    },
    true,
  );
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (text) {
    const message = JSON.parse(text);
    // The version that an edit leads to, and when its input came.
    if (message.type === "push")
      seen.pushes.push({ version: message.version + message.updates.length, input: seen.inputs.at(-1) });
    return send.call(this, text);
  };
  new PerformanceObserver((list) => {
    for (const mark of list.getEntriesByName("answer")) seen.answers.push({ version: mark.detail, at: mark.startTime });
  }).observe({ type: "mark" });
  new PerformanceObserver((list) => {
    for (const mark of list.getEntriesByName("map")) seen.maps.push({ ...mark.detail, at: mark.startTime });
  }).observe({ type: "mark" });
};

// Processor time of all pages of the browser until now (ms).
async function drawing(page) {
  const client = await page.context().browser().newBrowserCDPSession(),
    { processInfo } = await client.send("SystemInfo.getProcessInfo");
  await client.detach();
  return processInfo.filter((one) => one.type === "renderer").reduce((sum, one) => sum + 1000 * one.cpuTime, 0);
}

async function measure(page, client, slider) {
  const bar = page.getByLabel(slider, { exact: true });
  // Of many numbers it may be out of sight.
  await bar.scrollIntoViewIfNeeded();
  const box = await bar.boundingBox();
  await page.evaluate(() => {
    for (const list of Object.values(window.seen)) list.length = 0;
  });
  const events = [];
  client.on("Tracing.dataCollected", ({ value }) => events.push(...value));
  await client.send("Tracing.start", {
    transferMode: "ReportEvents",
    traceConfig: {
      includedCategories: ["blink.user_timing", "cc", "benchmark", "disabled-by-default-devtools.timeline.frame"],
    },
  });
  const y = box.y + box.height / 2,
    x = (share) => box.x + 8 + share * (box.width - 16);
  await page.mouse.move(x(0.3), y);
  await page.mouse.down();
  const worked = await drawing(page);
  const begun = performance.now();
  for (let k = 0; k < moves; k++) {
    const place = even ? 0 : (k * 0.618034) % 1;
    const wait = begun + ((k + place) * 1000) / 60 - performance.now();
    if (wait > 0) await new Promise((done) => setTimeout(done, wait));
    // To and fro, never the same place twice in a row.
    void client.send("Input.dispatchMouseEvent", {
      type: "mouseMoved",
      x: x(0.3 + 0.2 * Math.sin(k / 15) + 0.1 * Math.sin(k / 3)),
      y,
      button: "left",
      buttons: 1,
    });
  }
  const rate = moves / ((performance.now() - begun) / 1000);
  await page.mouse.up();
  await page.waitForTimeout(500);
  const work = (await drawing(page)) - worked;
  await page.waitForTimeout(1000);
  const ended = new Promise((done) => client.once("Tracing.tracingComplete", done));
  await client.send("Tracing.end");
  await ended;
  const seen = await page.evaluate(() => window.seen);
  // Marks stand in the trace by the clock of presented frames.
  const marks = events
    .filter((one) => one.name === "answer" && one.args?.data?.startTime !== undefined)
    .sort((a, b) => a.ts - b.ts);
  const offset = marks.length ? marks[0].ts / 1000 - marks[0].args.data.startTime : NaN;
  // A frame that takes what the page has drawn: when it takes it, and when it is presented.
  // Numbers of frames are used again.
  const frames = [],
    open = new Map();
  for (const { name, ph, ts, id2, id, pid, cat } of [...events].sort((a, b) => a.ts - b.ts)) {
    if (!cat.includes("timeline.frame")) continue;
    const key = `${pid} ${id2?.local ?? id2?.global ?? id}`;
    if (name === "Commit" && ph === "b") open.set(key, ts / 1000 - offset);
    if (name !== "SwapEndToPresentationCompositorFrame" || ph !== "e" || !open.has(key)) continue;
    frames.push({ taken: open.get(key), presented: ts / 1000 - offset });
    open.delete(key);
  }
  const shown = frames.sort((a, b) => a.taken - b.taken);
  const after = (time) => shown.find((one) => one.taken >= time)?.presented ?? NaN;
  // Each input is shown by the first answer to its version or a later one.
  const times = [];
  for (const push of seen.pushes) {
    const answer = seen.answers.find((one) => one.version >= push.version);
    if (answer) times.push(after(answer.at) - push.input);
  }
  const maps = (cells) =>
    seen.maps
      .filter((one) => one.cells === cells)
      .map((one) => {
        const push = seen.pushes.find((two) => two.version === one.version);
        return push ? after(one.at) - push.input : NaN;
      })
      .filter(Number.isFinite);
  return {
    times: times.filter(Number.isFinite),
    rate,
    // For each move that the page heard of.
    work: work / seen.inputs.length,
    answers: seen.answers.length,
    inputs: seen.inputs.length,
    coarse: maps(25),
    fine: maps(400),
  };
}

if (empty !== undefined) {
  const browser = await chromium.launch(options),
    { times } = await bare(browser, Number(empty));
  console.log(
    `empty page, ${empty} ms: half ${quantile(times, 0.5).toFixed(1)} ms, 95 % ${quantile(times, 0.95).toFixed(1)} ms, ${((100 * times.filter((time) => time <= target).length) / times.length).toFixed(1)} % within ${target} ms`,
  );
  await browser.close();
  process.exit();
}

const server = new Server({ [basename(scenario)]: scenario });
const results = [];
try {
  await server.start();
  const browser = await chromium.launch(options);
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  // Where others compute beside it even the page takes its time.
  page.setDefaultTimeout(120_000);
  await page.addInitScript(watch);
  const begun = Date.now();
  await page.goto(server.address);
  await page.waitForSelector(".verdict");
  const first = Date.now() - begun;
  const client = await page.context().newCDPSession(page);
  const labels = await page
    .locator(".slider input[type=range]")
    .evaluateAll((all) => all.map((one) => one.getAttribute("aria-label")));
  // A number that the map is not over, so that the map follows.
  const slider = labels.find((one) => /stiffness/.test(one)) ?? labels.at(-1);
  results.push({ name: "charts, figures and machine", ...(await measure(page, client, slider)) });
  if (!press) {
    await page.getByRole("button", { name: "Map over two numbers" }).click();
    await page.locator(".map-view").getByText("400 points").waitFor({ timeout: 300_000 });
    results.push({ name: "the same while the map follows", ...(await measure(page, client, slider)) });
  }
  const text = await page.evaluate(() =>
    (
      document.querySelector(".cm-content").cmTile?.view ?? document.querySelector(".cm-content").cmView.view
    ).state.doc.toString(),
  );
  const own = await page
    .locator(".figures td span[title]")
    .evaluateAll((all) => all.map((one) => Number(one.title.split(" ")[0])));
  const objects = Object.values(server.run(text).objects);
  const agree = objects.every((object) => own.includes(object.delta_abs) && own.includes(object.peak_speed));
  await page.close();
  const alone = await bare(browser, DELAY);
  results.push({ name: "a page with a slider and a number alone", ...alone });
  await browser.close();

  const row = ({ name, times, rate, answers, inputs, work }) =>
    `| ${name} | ${inputs} at ${rate.toFixed(0)}/s | ${answers} | ${quantile(times, 0.5).toFixed(1)} | ${quantile(times, 0.95).toFixed(1)} | ${quantile(times, 0.99).toFixed(1)} | ${((100 * times.filter((time) => time <= target).length) / times.length).toFixed(1)} % | ${(quantile(times, 0.95) - quantile(alone.times, 0.95)).toFixed(1)} | ${work.toFixed(1)} ms, ${(work / alone.work).toFixed(1)} times |`;
  const map = press ? null : results[1],
    mapped =
      map &&
      `Map of 25 cells ${quantile(map.coarse, 0.5).toFixed(0)} ms, 95 % within ${quantile(map.coarse, 0.95).toFixed(0)} ms; all 400 cells ${quantile(map.fine, 0.5).toFixed(0)} ms, 95 % within ${quantile(map.fine, 0.95).toFixed(0)} ms, after the move that they answer.`;
  const words = [
    `${basename(scenario)}, ${cpus().length} cores, ${cpus()[0]?.model.trim()}; milliseconds from the input event to the presented frame; load at the beginning ${load.toFixed(1)}`,
    "",
    `| what follows | moves | answers | half | 95 % | 99 % | within ${target} ms | 95 % above the page alone | processor time a move |`,
    "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ...results.map(row),
    "",
    [`First answer ${first} ms after the address was opened.`, mapped].filter(Boolean).join(" "),
    `Figures after the last move ${agree ? "equal" : "DIFFER from"} those of dam run.`,
    "",
  ].join("\n");
  console.log(words);
  writeFileSync(join(out, `${name}.md`), words);
  writeFileSync(join(out, `${name}.json`), JSON.stringify({ scenario, target, load, first, agree, results }, null, 1));
  writeFileSync(join(out, `${name}.svg`), chart());
  if (!agree) process.exitCode = 1;
} finally {
  await server.end();
}

// The slider and the number, and nothing else.
async function bare(browser, delay) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  await page.addInitScript(watch);
  // (Of this machine: moves come at once to pages that are trusted alone.)
  await page.route("http://127.0.0.1/", (route) =>
    route.fulfill({
      contentType: "text/html",
      body: '<!doctype html><input type="range" aria-label="slider" max="1000" style="width: 300px"><p>0</p>',
    }),
  );
  await page.goto("http://127.0.0.1/");
  await page.evaluate((delay) => {
    const number = document.querySelector("p");
    let version = 0;
    document.querySelector("input").addEventListener("pointerrawupdate", (event) => {
      const own = ++version;
      window.seen.pushes.push({ version: own, input: event.timeStamp });
      setTimeout(() => {
        number.textContent = String(own);
        performance.mark("answer", { detail: own });
      }, delay);
    });
  }, delay);
  return measure(page, await page.context().newCDPSession(page), "slider");
}

// How many of the moves are shown within a time: one curve a measurement.
function chart() {
  const [w, h, left, top, most] = [
    720,
    320,
    60,
    30,
    Math.max(1.5 * target, ...results.map(({ times }) => 1.05 * quantile(times, 0.99))),
  ];
  const x = (time) => left + (time / most) * (w - left - 20),
    y = (share) => top + (1 - share) * (h - top - 50);
  const colours = ["#1d5a9e", "#c04f15", "#4f5a66"];
  const curves = results.map(({ name, times }, k) => {
    const sorted = [...times].sort((a, b) => a - b);
    const points = sorted.map(
      (time, i) => `${x(Math.min(time, most)).toFixed(1)} ${y((i + 1) / sorted.length).toFixed(1)}`,
    );
    return `<path d="M${points.join("L")}" fill="none" stroke="${colours[k]}" stroke-width="1.6"/><text x="${left + 12}" y="${top + 20 + 18 * k}" fill="${colours[k]}">${name}</text>`;
  });
  const grid = [0, 0.25, 0.5, 0.75, 0.95, 1].map(
    (share) =>
      `<path d="M${left} ${y(share)}H${w - 20}" stroke="#d5dae0"/><text x="${left - 8}" y="${y(share) + 4}" text-anchor="end">${100 * share} %</text>`,
  );
  const step = most > 400 ? 100 : most > 120 ? 25 : 10;
  const ticks = Array.from({ length: Math.floor(most / step) + 1 }, (_, k) => k * step).map(
    (time) =>
      `<path d="M${x(time)} ${y(0)}v5" stroke="#4f5a66"/><text x="${x(time)}" y="${y(0) + 20}" text-anchor="middle">${time}</text>`,
  );
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${w} ${h}" width="${w}" height="${h}" font-family="system-ui, sans-serif" font-size="12" fill="#4f5a66"><rect width="${w}" height="${h}" fill="#ffffff"/>${grid.join("")}${ticks.join("")}<path d="M${x(target)} ${top}V${y(0)}" stroke="#8f1d3f" stroke-dasharray="6 4"/>${curves.join("")}<text x="${(left + w) / 2}" y="${h - 8}" text-anchor="middle">ms from the input event to the presented frame</text></svg>\n`;
}
