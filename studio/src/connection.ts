// Who answers this interface: a server. In the single file it is `offline/connection.ts`.

import type { Link } from "./link";
import { Server } from "./server";

export const connection = (): Link => new Server();

// What stands in the bar besides.
export const Besides = (_: { scene: string; link: Link; tell: (words: string) => void }) => null;
