// A server at the other end: one WebSocket.
//
// The token goes to the program that gave the address, when it is opened. A window that comes back
// does not know who listens at the port by then: both sides prove that they have the token.

import { shownScene, TAB, TOKEN, type Link } from "./link";
import { Hearers, type Heard, type HeardMessage, type SaidMessage } from "./messages";

// The token comes behind the # of the first address, where no server sees it, and stays in
// this window alone.
function token(): { text: string | null; isNew: boolean } {
  const given = location.hash.slice(1),
    isNew = /^[0-9a-f]{64}$/.test(given);
  if (isNew) {
    sessionStorage.setItem(TOKEN, given);
    shownScene.forget();
    history.replaceState(null, "", location.pathname);
  }
  return { text: sessionStorage.getItem(TOKEN), isNew };
}

const hex = (bytes: Uint8Array): string => Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
const random = (count: number): string => hex(crypto.getRandomValues(new Uint8Array(count)));
async function hash(text: string): Promise<string> {
  return hex(new Uint8Array(await crypto.subtle.digest("SHA-256", new TextEncoder().encode(text))));
}

// The tab, the same when it is loaded or connected anew: runs that were pinned in it are there.
function tab(): string {
  const kept = sessionStorage.getItem(TAB);
  if (kept) return kept;
  const made = random(16);
  sessionStorage.setItem(TAB, made);
  return made;
}

export class Server implements Link {
  private socket: WebSocket | null = null;
  private token: string | null;
  // The token came with the address: nobody else has been asked yet.
  private isNew: boolean;
  // Who makes the edits of this page, however often the connection is made anew.
  private readonly author = random(16);
  private readonly heard = new Hearers();
  private wait = 250;
  private isWelcome = false;
  answer: (frame: ArrayBuffer) => void = () => {};
  state: (connected: boolean) => void = () => {};

  constructor() {
    ({ text: this.token, isNew: this.isNew } = token());
  }

  get isOpen(): boolean {
    return this.socket?.readyState === WebSocket.OPEN && this.isWelcome;
  }

  get known(): boolean {
    return this.token !== null;
  }

  on<K extends keyof Heard>(type: K, act: (message: Heard[K]) => void): void {
    this.heard.on(type, act);
  }

  connect(): void {
    const socket = new WebSocket(`ws://${location.host}/ws`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    this.isWelcome = false;
    const say = (message: SaidMessage) => socket.send(JSON.stringify(message)),
      own = { tab: tab(), author: this.author },
      token = this.token ?? "";
    const number = random(32);
    let isProven = this.isNew;
    socket.onopen = async () => {
      if (this.isNew) say({ type: "hello", token, ...own });
      else say({ type: "back", name: await hash(`name ${token}`), number, ...own });
    };
    const greet = async (message: HeardMessage) => {
      if (message.type === "challenge" && message.proof === (await hash(`program ${token} ${number}`))) {
        isProven = true;
        say({ type: "proof", proof: await hash(`window ${token} ${message.number}`) });
      } else if (message.type === "welcome" && isProven) {
        this.token = message.token!;
        sessionStorage.setItem(TOKEN, this.token);
        this.isNew = false;
        this.isWelcome = true;
        this.wait = 250;
        this.state(true);
        this.heard.tell(message);
      } else socket.close();
    };
    socket.onmessage = (event) => {
      if (this.isWelcome && typeof event.data !== "string") {
        this.answer(event.data);
        return;
      }
      const message = JSON.parse(event.data) as HeardMessage;
      if (this.isWelcome) this.heard.tell(message);
      else void greet(message);
    };
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.socket = null;
      this.isWelcome = false;
      this.state(false);
      setTimeout(() => this.connect(), this.wait);
      this.wait = Math.min(4000, 2 * this.wait);
    };
  }

  send(message: SaidMessage): boolean {
    if (!this.isOpen) return false;
    this.socket!.send(JSON.stringify(message));
    return true;
  }

  async get<T>(path: string): Promise<T> {
    return (await this.fetched(path)).json();
  }
  async text(path: string): Promise<string> {
    return (await this.fetched(path)).text();
  }

  private async fetched(path: string): Promise<Response> {
    // Nobody but a server that was proven to be the own one is given the token.
    if (!this.isOpen) throw new Error("the server does not answer");
    const answer = await fetch(path, { headers: { Authorization: `Bearer ${this.token}` } });
    if (answer.ok) return answer;
    // What was refused is told in words.
    const told = await answer.json().catch(() => null);
    throw new Error(told?.error ?? `${answer.status}`);
  }
}
