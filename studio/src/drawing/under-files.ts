// What a file has that can lie below a drawing: a picture, or the lines of a DXF file.

import { written } from "./measures";
import { planOf, type Plan } from "./dxf";
import type { Kept } from "./pictures";

const SORTS = ["image/png", "image/jpeg"],
  LARGEST = 20 << 20;

export interface Found extends Omit<Kept, "underlay"> {
  // In pixels, or in units of the file.
  width: number;
  height: number;
  // Metres in a unit of the file, where that is known.
  unit: number | null;
  // What is to be said of it.
  words: string;
}

// Text: why it cannot be shown.
export async function readFrom(file: Blob, name: string): Promise<Found | string> {
  const isPlan = /\.(dxf|dwg)$/i.test(name) || /\bdxf$/.test(file.type);
  if (!isPlan && !SORTS.includes(file.type)) return `${name} is no PNG, JPEG or DXF file.`;
  if (file.size > LARGEST) return `${name} is larger than 20 MB.`;
  if (isPlan) {
    const plan = planOf(await file.text(), name);
    return typeof plan === "string" ? plan : { ...plan, words: wordsOf(plan, name) };
  }
  try {
    const { width, height } = await createImageBitmap(file);
    return { image: file, width, height, unit: null, words: "" };
  } catch {
    return `${name} cannot be read as a picture.`;
  }
}

function wordsOf({ width, height, unit, without }: Plan, name: string): string {
  const size = unit
      ? `${name} is ${written(width * unit, "length")} wide and ${written(height * unit, "length")} high.`
      : `${name} names no unit: scale it by two places whose distance you know.`,
    left = [...without].map(([kind, count]) => `${count} ${kind}`).join(", ");
  return left ? `${size} Not shown: ${left}.` : size;
}
