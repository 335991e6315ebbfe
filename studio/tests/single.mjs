// The studio as one file: OFFLINE=… names it.

import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

export const file = process.env.OFFLINE && resolve(process.env.INIT_CWD ?? ".", process.env.OFFLINE);
export const address = file ? pathToFileURL(file).href : "";
export const WHY = "the single file is built by its own command";

// What the page asks of others: nothing is to be.
export function requested(page) {
  const requests = [];
  page.on("request", (request) => {
    if (/^(https?|wss?|ftp):/.test(request.url())) requests.push(request.url());
  });
  return requests;
}
