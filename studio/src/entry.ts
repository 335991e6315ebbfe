// A number as it is typed: plain or worked out, as `2*3`, `1/3` or `(1 + 2)/4`, with a unit behind it.

export interface Entry {
  number: string;
  unit: string;
}
// What was typed: a number; what is wrong with it; a text that is no number, or names others.
export type Typed = { sort: "number"; entry: Entry } | { sort: "wrong"; why: string } | { sort: "text" };

const PLAIN = /^-?(0|[1-9]\d*)(\.\d+)?([eE][-+]?\d+)?$/;
const TOKEN = /\s*(?:((?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|(\*\*|[-+*/^()]))/y;
const POWERS = ["^", "**"];

class Reader {
  at = 0;
  constructor(private readonly text: string) {}

  // The next number or sign; it is taken where it fits.
  private take(fits: (token: string) => boolean): string | null {
    TOKEN.lastIndex = this.at;
    const match = TOKEN.exec(this.text),
      token = match?.[1] ?? match?.[2];
    if (!match || token === undefined || !fits(token)) return null;
    this.at = TOKEN.lastIndex;
    return token;
  }

  sum(): number {
    let value = this.product();
    for (let sign: string | null; (sign = this.take((token) => token === "+" || token === "-")); )
      value += (sign === "-" ? -1 : 1) * this.product();
    return value;
  }
  private product(): number {
    let value = this.signed();
    for (let sign: string | null; (sign = this.take((token) => token === "*" || token === "/")); )
      value = sign === "*" ? value * this.signed() : value / this.signed();
    return value;
  }
  private signed(): number {
    const sign = this.take((token) => token === "-" || token === "+");
    return sign ? (sign === "-" ? -1 : 1) * this.signed() : this.power();
  }
  private power(): number {
    const base = this.single();
    return this.take((token) => POWERS.includes(token)) ? base ** this.signed() : base;
  }
  private single(): number {
    if (this.take((token) => token === "(")) {
      const value = this.sum();
      return this.take((token) => token === ")") ? value : NaN;
    }
    const number = this.take((token) => /[\d.]/.test(token));
    return number === null ? NaN : Number(number);
  }
}

export function typedNumber(given: string): Typed {
  const text = given.trim().replaceAll("−", "-").replaceAll("×", "*").replaceAll("·", "*");
  if (!/^[-+(\s]*(\d|\.\d)/.test(text)) return { sort: "text" };
  const comma = /^[-+]?\d+,(\d+)(.*)$/.exec(text);
  if (comma) return { sort: "wrong", why: `Use a decimal point: ${text.replace(",", ".")}` };
  const reader = new Reader(text),
    value = reader.sum(),
    number = text.slice(0, reader.at).trim(),
    unit = text.slice(reader.at).trim();
  // A sign before a letter: it reckons with what has a name.
  if (Number.isNaN(value) && /[-+*/^(]\s*$/.test(number) && /^[A-Za-z_]/.test(unit)) return { sort: "text" };
  if (!Number.isFinite(value)) return { sort: "wrong", why: `“${given.trim()}” is not a number.` };
  // `0x10` is no zero with the unit x10.
  if (unit && (!/^[A-Za-zµμ°%Ω]/.test(unit) || (number === "0" && /^[xob][\da-f]/i.test(unit))))
    return { sort: "wrong", why: `“${given.trim()}” is not a number.` };
  return {
    sort: "number",
    entry: { number: PLAIN.test(number) ? number : String(Number(value.toPrecision(15))), unit },
  };
}
