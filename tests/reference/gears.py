"""Reference figures of scenarios/gears: a gear with backlash under an alternating moment.

Absolute angle of the driven wheel; tooth contact by flank, Kelvin-Voigt cut off
at zero, gap centred on the law.
"""

import math

from piecewise import object_figures, pair_figures, simulate, twice, write

RATIO, INERTIA, STIFFNESS, PSI, GAP = 0.5, 0.004, 1.0e6, 2.5, 1.25e-3
DAMPING = PSI * math.sqrt(STIFFNESS * INERTIA) / (2 * math.pi)
SPEED = 1800 * 2 * math.pi / 60
# moment of the valve springs over the driver's angle, four lobes a turn of the
# camshaft: half a turn of the driver each (degrees, N m)
POINTS = [(0, -18.0), (60, -18.0), (80, 12.0), (140, 12.0), (160, -18.0)]
PERIOD = math.pi
DRAG = 0.01


def moment(t):
    degrees = math.degrees((SPEED * t) % PERIOD)
    for (a, va), (b, vb) in zip(POINTS, POINTS[1:] + [(180, POINTS[0][1])]):
        if a <= degrees <= b:
            return va + (vb - va) * (degrees - a) / (b - a)
    raise ValueError(degrees)


def breaks(duration):
    turns = int(duration * SPEED / PERIOD) + 1
    return [(math.radians(a) + PERIOD * k) / SPEED for a, _ in POINTS for k in range(turns + 1)]


def run(duration, rtol):
    """Lower flank L (x < 0, pressed towards +), upper flank U, open O."""

    def lower(t, y):
        x, v = y[0] - RATIO * SPEED * t, y[1] - RATIO * SPEED
        p = -x - GAP / 2
        return p, STIFFNESS * p - DAMPING * v

    def upper(t, y):
        x, v = y[0] - RATIO * SPEED * t, y[1] - RATIO * SPEED
        p = x - GAP / 2
        return p, STIFFNESS * p + DAMPING * v

    def contact(t, y, mode):
        return {"L": lower(t, y)[1], "U": upper(t, y)[1], "O": 0.0}[mode]

    def rhs(t, y, mode):
        push = contact(t, y, mode) * (1 if mode == "L" else -1)
        return [y[1], (push + moment(t) - DRAG * y[1]) / INERTIA]

    def guards(mode):
        if mode == "O":
            return [(lambda t, y: min(lower(t, y)), +1, "L"), (lambda t, y: min(upper(t, y)), +1, "U")]
        flank = lower if mode == "L" else upper
        return [(lambda t, y: flank(t, y)[0], -1, "O"), (lambda t, y: flank(t, y)[1], -1, "O")]

    # static start: the moment at t = 0 (drag is viscous and counts as zero) presses the lower flank
    start = [-GAP / 2 + POINTS[0][1] / STIFFNESS, RATIO * SPEED]
    motion = simulate(
        rhs, guards, start, "L", duration, breaks=breaks(duration), max_step=3e-5, rtol=rtol,
        atol=[1e-6 * rtol, rtol],
    )
    figures = object_figures(
        "wheel", motion, duration,
        delta=lambda t, y, m: y[0] - RATIO * SPEED * t,
        speed=lambda t, y, m: y[1], acceleration=lambda t, y, m: rhs(t, y, m)[1],
        reaction=contact,
    )
    figures |= pair_figures(
        "wheel", motion, lambda mode: mode == "O", duration,
        approach=lambda t, before, after, y: abs(y[1] - RATIO * SPEED), force=contact,
    )
    figures["wheel.final.displacement"], figures["wheel.final.speed"] = motion.end
    figures["run.switches"] = len(motion.switches)
    return figures


if __name__ == "__main__":
    write(
        "gears",
        "Gears with backlash: absolute coordinates, DOP853 at rtol 1e-12, spread against rtol 1e-10. "
        "Script: gears.py.",
        {
            "timing_gear_rattle": twice(lambda rtol: run(0.1, rtol)),
        },
    )
