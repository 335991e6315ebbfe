// The units that values can be shown in, and those of each system.

export const TURN = 2 * Math.PI;
const DEGREE = TURN / 360,
  // By definition.
  INCH = 0.0254,
  POUND = 0.45359237,
  POUND_FORCE = POUND * 9.80665;

type Choice = [string, [string, number][]];

// Of every SI unit the others, with how many of it they are.
export const CHOICES: Record<string, Choice> = {
  rad: [
    "angles",
    [
      ["rad", 1],
      ["mrad", 1e-3],
      ["deg", DEGREE],
    ],
  ],
  m: [
    "lengths",
    [
      ["m", 1],
      ["mm", 1e-3],
      ["µm", 1e-6],
      ["in", INCH],
    ],
  ],
  "rad/s": [
    "angular speeds",
    [
      ["rad/s", 1],
      ["rpm", TURN / 60],
      ["rev/s", TURN],
      ["deg/s", DEGREE],
    ],
  ],
  "m/s": [
    "speeds",
    [
      ["m/s", 1],
      ["mm/s", 1e-3],
      ["m/min", 1 / 60],
      ["in/s", INCH],
    ],
  ],
  "rad/s²": [
    "angular accelerations",
    [
      ["rad/s²", 1],
      ["deg/s²", DEGREE],
    ],
  ],
  "m/s²": [
    "accelerations",
    [
      ["m/s²", 1],
      ["mm/s²", 1e-3],
      ["in/s²", INCH],
    ],
  ],
  N: [
    "forces",
    [
      ["N", 1],
      ["kN", 1e3],
      ["MN", 1e6],
      ["lbf", POUND_FORCE],
    ],
  ],
  "N m": [
    "moments",
    [
      ["N m", 1],
      ["kN m", 1e3],
      ["N mm", 1e-3],
      ["lbf in", POUND_FORCE * INCH],
    ],
  ],
  kg: [
    "masses",
    [
      ["kg", 1],
      ["g", 1e-3],
      ["t", 1e3],
      ["lb", POUND],
    ],
  ],
  "kg m²": [
    "moments of inertia",
    [
      ["kg m²", 1],
      ["kg mm²", 1e-6],
      ["lb in²", POUND * INCH ** 2],
    ],
  ],
  "N/m": [
    "stiffnesses",
    [
      ["N/m", 1],
      ["N/mm", 1e3],
      ["kN/mm", 1e6],
      ["lbf/in", POUND_FORCE / INCH],
    ],
  ],
  "N m/rad": [
    "rotational stiffnesses",
    [
      ["N m/rad", 1],
      ["kN m/rad", 1e3],
      ["N m/deg", 1 / DEGREE],
      ["lbf in/rad", POUND_FORCE * INCH],
    ],
  ],
  Pa: [
    "pressures",
    [
      ["Pa", 1],
      ["MPa", 1e6],
      ["bar", 1e5],
      ["psi", POUND_FORCE / INCH ** 2],
    ],
  ],
  s: [
    "times",
    [
      ["s", 1],
      ["ms", 1e-3],
    ],
  ],
  J: [
    "energies",
    [
      ["J", 1],
      ["kJ", 1e3],
      ["mJ", 1e-3],
      ["lbf in", POUND_FORCE * INCH],
    ],
  ],
};

// Of each system the unit for every SI unit.
export const SYSTEMS: Record<string, Record<string, string>> = {
  SI: Object.fromEntries(Object.keys(CHOICES).map((si) => [si, si])),
  "mm, N, deg": {
    ...{ rad: "deg", m: "mm", "rad/s": "rpm", "m/s": "mm/s", "rad/s²": "deg/s²", "m/s²": "mm/s²" },
    ...{ N: "N", "N m": "N mm", kg: "kg", "kg m²": "kg mm²", "N/m": "N/mm", "N m/rad": "N m/deg" },
    ...{ Pa: "MPa", s: "s", J: "mJ" },
  },
  "in, lbf, deg": {
    ...{ rad: "deg", m: "in", "rad/s": "rpm", "m/s": "in/s", "rad/s²": "deg/s²", "m/s²": "in/s²" },
    ...{ N: "lbf", "N m": "lbf in", kg: "lb", "kg m²": "lb in²", "N/m": "lbf/in", "N m/rad": "lbf in/rad" },
    ...{ Pa: "psi", s: "s", J: "lbf in" },
  },
};
