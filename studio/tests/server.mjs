// A studio on a folder of its own, and the program beside it.

import { execFileSync, spawn } from "node:child_process";
import {
  copyFileSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

export const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
export const dam = process.env.DAM
  ? resolve(process.env.INIT_CWD ?? ".", process.env.DAM)
  : join(root, "target/release/dam");
export const browser = {
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
  ],
};

export class Server {
  constructor(scenes = { "two_masses.json": "scenarios/rocker/two_masses.json" }) {
    this.base = mkdtempSync(join(tmpdir(), "dam-studio-"));
    this.folder = join(this.base, "scenes");
    mkdirSync(this.folder);
    for (const [name, from] of Object.entries(scenes)) copyFileSync(join(root, from), join(this.folder, name));
  }
  path(name = "two_masses.json") {
    return join(this.folder, name);
  }
  text(name) {
    return readFileSync(this.path(name), "utf8");
  }
  // A file of the project.
  read(name) {
    return readFileSync(join(root, name), "utf8");
  }
  write(text, name) {
    writeFileSync(this.path(name), text);
  }
  // With its first scene open; with `home` the first page.
  async start({ port, home = false } = {}) {
    const scene = home
      ? undefined
      : readdirSync(this.folder)
          .filter((name) => name.endsWith(".json"))
          .sort()[0];
    const args = [
      "studio",
      scene ? this.path(scene) : this.folder,
      "--no-open",
      ...(port ? ["--port", String(port)] : []),
    ];
    this.child = spawn(dam, args, { env: { ...process.env, XDG_STATE_HOME: join(this.base, "state") } });
    this.address = await new Promise((found, failed) => {
      let told = "";
      this.child.stderr.on("data", (more) => {
        told += more;
        const match = /http:\S+/.exec(told);
        if (match) found(match[0]);
      });
      this.child.on("exit", () => failed(new Error(told)));
    });
    return this.address;
  }
  // Names of the pinned runs that are kept.
  pinned() {
    const folder = join(this.base, "state/dam/pins");
    const files = existsSync(folder)
      ? readdirSync(folder).filter((name) => name.endsWith(".json") && !name.startsWith("."))
      : [];
    return files.flatMap((name) => JSON.parse(readFileSync(join(folder, name), "utf8")).pins.map((pin) => pin.name));
  }
  remove(name) {
    rmSync(this.path(name));
  }
  async kill() {
    const gone = new Promise((done) => this.child.once("exit", done));
    this.child.kill("SIGKILL");
    await gone;
  }
  async end() {
    if (this.child?.exitCode === null && this.child.signalCode === null) await this.kill();
    rmSync(this.base, { recursive: true, force: true });
  }
  // The figures of the program for a text.
  run(text) {
    return this.ask(text, "run");
  }
  // The best value of a parameter.
  find(text, vary, subject) {
    const maximize = vary.split("=")[0];
    return this.ask(text, "find", "--vary", vary, "--subject", subject, "--maximize", maximize).best.value;
  }
  // What the program answers to a text.
  ask(text, command, ...options) {
    const file = join(this.base, "asked.json");
    writeFileSync(file, text);
    let out;
    try {
      out = execFileSync(dam, [command, file, ...options, "--json", "--quiet"], {
        encoding: "utf8",
        stdio: ["ignore", "pipe", "ignore"],
        maxBuffer: 1 << 26,
      });
    } catch (error) {
      out = error.stdout;
    }
    return JSON.parse(out);
  }
}
