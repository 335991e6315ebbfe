// What is said of a motion: its greatest values, and where velocity or acceleration jump.

import { counted, placed, type Motion } from "./motion";

const NAMES = ["velocity", "acceleration", "jerk"];
const sized = (value: number, unit: string): string => numbers.withUnit(value, unit, 4);
const where = (motion: Motion, at: number): string => counted(placed(motion, at + motion.phase), motion.axis);

export function Greatest({ motion }: { motion: Motion }) {
  const { peaks, units, speed, axis } = motion;
  return (
    <div class="greatest" role="group" aria-label="greatest values">
      <dl>
        {peaks.map(({ value, at }, k) => (
          <div key={NAMES[k]}>
            <dt>greatest {NAMES[k]}</dt>
            <dd>
              <b>{sized(value, units[k + 1]!)}</b> at {where(motion, at)}
            </dd>
          </div>
        ))}
      </dl>
      {axis !== "s" && (
        <p class="soft">
          {speed === null
            ? `Per ${axis === "rad" ? "radian" : "metre"} of the drive, as its speed is not constant.`
            : `At ${sized(speed, `${axis}/s`)} of the drive.`}
        </p>
      )}
    </div>
  );
}

// Jumps in words, in the order of the axis.
export function Jumps({ motion }: { motion: Motion }) {
  const { jumps, units } = motion,
    place = (at: number) => placed(motion, at + motion.phase);
  const sorted = [...jumps].sort((a, b) => place(a.at) - place(b.at) || a.order - b.order);
  return (
    <ul class="matching" aria-label="matching at the boundaries">
      {sorted.map((one) => (
        <li key={`${one.order} ${one.at}`} class="jumps">
          {one.order === 1 ? "Velocity" : "Acceleration"} jumps by{" "}
          {sized(Math.abs(one.after - one.before), units[one.order]!)} at {where(motion, one.at)}
          {one.order === 1 ? ": a hard shock." : "."}
        </li>
      ))}
      {!sorted.length && <li>Velocity and acceleration are continuous.</li>}
    </ul>
  );
}
