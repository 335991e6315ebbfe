// The line to the server: one WebSocket, JSON in both directions, answers as bytes.

export type Message = { type: string } & Record<string, any>;

const KEY = "dam-studio-token", SCENE = "dam-studio-scene", TAB = "dam-studio-tab";

// The token comes behind the # of the first address, where no server sees it, and stays in
// this window alone.
function token(): string | null {
  const given = location.hash.slice(1);
  if (/^[0-9a-f]{64}$/.test(given)) {
    sessionStorage.setItem(KEY, given);
    sessionStorage.removeItem(SCENE);
    history.replaceState(null, "", location.pathname);
  }
  return sessionStorage.getItem(KEY);
}

// The tab, the same when it is loaded or connected anew: runs that were pinned in it are there.
function tab(): string {
  const kept = sessionStorage.getItem(TAB);
  if (kept) return kept;
  const made = Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("");
  sessionStorage.setItem(TAB, made);
  return made;
}

// The scene that this window shows, so that it does when it is loaded anew; empty: the first page.
export const shownScene = {
  get: (): string | null => sessionStorage.getItem(SCENE),
  set: (scene: string): void => sessionStorage.setItem(SCENE, scene),
};

// What the user chose: in this browser, and with the server for others and for later ones, as
// what a browser keeps goes with the port.
export class Kept {
  constructor(private readonly name: string) {}
  private get key(): string { return `dam-studio-${this.name}`; }
  get(): string | null { try { return localStorage.getItem(this.key); } catch { return null; } }
  set(value: string, link: Link): void {
    this.take(value);
    link.send({ type: "keep", name: this.name, value });
  }
  // From the server, where this browser has nothing; true: it is taken.
  offer(settings: Record<string, string>): boolean {
    const value = settings[this.name];
    if (value === undefined || this.get() !== null) return false;
    this.take(value);
    return this.get() !== null;
  }
  // A browser that keeps nothing has it for this page alone.
  private take(value: string): void { try { localStorage.setItem(this.key, value); } catch { /* Nothing more can be done. */ } }
}

export class Link {
  private socket: WebSocket | null = null;
  private readonly token = token();
  private readonly heard = new Map<string, (message: Message) => void>();
  private wait = 250;
  answer: (frame: ArrayBuffer) => void = () => {};
  state: (connected: boolean) => void = () => {};

  get known(): boolean { return this.token !== null; }

  on(type: string, act: (message: Message) => void): void { this.heard.set(type, act); }

  connect(): void {
    const socket = new WebSocket(`ws://${location.host}/ws`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => socket.send(JSON.stringify({ type: "hello", token: this.token, tab: tab() }));
    socket.onmessage = (event) => {
      if (typeof event.data !== "string") { this.answer(event.data); return; }
      const message = JSON.parse(event.data) as Message;
      if (message.type === "welcome") { this.wait = 250; this.state(true); }
      this.heard.get(message.type)?.(message);
    };
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.socket = null;
      this.state(false);
      setTimeout(() => this.connect(), this.wait);
      this.wait = Math.min(4000, 2 * this.wait);
    };
  }

  send(message: Message): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  async get(path: string): Promise<any> { return (await this.fetched(path)).json(); }
  async text(path: string): Promise<string> { return (await this.fetched(path)).text(); }

  private async fetched(path: string): Promise<Response> {
    const answer = await fetch(path, { headers: { Authorization: `Bearer ${this.token}` } });
    if (answer.ok) return answer;
    // What was refused is told in words.
    const told = await answer.json().catch(() => null);
    throw new Error(told?.error ?? `${answer.status}`);
  }
}
