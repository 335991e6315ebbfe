// The inputs of a linkage that is drawn: a slider for each, over the positions that are known.

import { nearest, type Course, type Sketch } from "./linkage";

interface Props {
  sketch: Sketch;
  at: number[];
  disabled: boolean;
  set: (values: number[]) => void;
}

export function InputRows({ sketch: { courses }, at, disabled, set }: Props) {
  return (
    <>
      {courses.map((course, k) => (
        <InputRow
          key={course.name}
          course={course}
          value={at[k]!}
          disabled={disabled}
          set={(value) => set(at.map((one, other) => (other === k ? value : one)))}
        />
      ))}
    </>
  );
}

function InputRow({
  course,
  value,
  disabled,
  set,
}: {
  course: Course;
  value: number;
  disabled: boolean;
  set: (value: number) => void;
}) {
  const label = course.name ? `input ${course.name} of the linkage` : "input of the linkage";
  return (
    <>
      <label class="input-row">
        {course.name || "input"}{" "}
        <input
          type="range"
          aria-label={label}
          disabled={disabled}
          min={0}
          max={course.values.length - 1}
          value={nearest(course, value)}
          onInput={(event) => set(course.values[Number(event.currentTarget.value)]!)}
        />
      </label>
      <output>
        {course.unit === "rad"
          ? numbers.withUnit((value * 180) / Math.PI, "°", 4)
          : numbers.withUnit(value, course.unit, 4)}
      </output>
    </>
  );
}
