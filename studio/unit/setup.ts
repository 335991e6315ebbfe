// The same cases each time; `SEED=7 npm run unit` takes others.

import fc from "fast-check";

fc.configureGlobal({ seed: Number(process.env.SEED ?? 1) });
