// The line to what answers, of this window, and whether it is open.

import { signal } from "@preact/signals";
import { connection } from "../connection";

export const link = connection();
export const isConnected = signal(false);
// The id of this window at the server, and the version of the program.
export const self = signal("0"),
  program = signal("");
