// Pictures that this browser keeps for itself: nothing of them is sent, and no scene has them.

import type { Underlay } from "./underlay";

export interface Kept {
  // A picture, or the path of a plan (`dxf.ts`).
  image?: Blob;
  path?: string;
  underlay: Underlay;
}

const NAME = "dam-studio-pictures",
  STORE = "pictures";

function opened(): Promise<IDBDatabase> {
  return new Promise((done, failed) => {
    const request = indexedDB.open(NAME, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE);
    request.onsuccess = () => done(request.result);
    request.onerror = () => failed(request.error);
  });
}

async function asked<T>(mode: IDBTransactionMode, ask: (store: IDBObjectStore) => IDBRequest<T>): Promise<T> {
  const base = await opened();
  try {
    return await new Promise((done, failed) => {
      const request = ask(base.transaction(STORE, mode).objectStore(STORE));
      request.onsuccess = () => done(request.result);
      request.onerror = () => failed(request.error);
    });
  } finally {
    base.close();
  }
}

// Null: there is none.
export async function picture(key: string): Promise<Kept | null> {
  try {
    return (await asked<Kept | undefined>("readonly", (store) => store.get(key))) ?? null;
  } catch {
    return null;
  }
}

// Keeps a picture, or forgets it; false: this browser keeps nothing.
export async function keep(key: string, kept: Kept | null): Promise<boolean> {
  try {
    if (kept) await asked("readwrite", (store) => store.put(kept, key));
    else await asked("readwrite", (store) => store.delete(key));
    return true;
  } catch {
    return false;
  }
}
