"""Reference figures of scenarios/grooved_cam: a lever in a worn groove, Hunt-Crossley contact.

Absolute angle of the lever; N = c p (1 + kappa p') cut off at zero on either
flank, the gap centred on the law.
"""

import math

from piecewise import object_figures, pair_figures, simulate, twice, write


def run(rtol, duration=0.2):
    """No load; starts in the middle of the gap."""
    amplitude, w, kappa = 0.05, 2 * math.pi * 15, 0.9
    inertia, stiffness, gap = 0.02, 4.0e5, 2.0e-3

    def law(t):
        return amplitude * math.sin(w * t), amplitude * w * math.cos(w * t), -amplitude * w * w * math.sin(w * t)

    def flank(side, t, y):
        u, u1, _ = law(t)
        p, rate = side * (y[0] - u) - gap / 2, side * (y[1] - u1)
        return p, 1 + kappa * rate

    sides = {"L": -1, "U": +1}

    def contact(t, y, mode):
        if mode == "O":
            return 0.0
        p, factor = flank(sides[mode], t, y)
        return stiffness * p * factor

    def rhs(t, y, mode):
        return [y[1], -sides.get(mode, 0) * contact(t, y, mode) / inertia]

    def guards(mode):
        if mode == "O":
            return [(lambda t, y, s=s: min(flank(s, t, y)), +1, name) for name, s in sides.items()]
        s = sides[mode]
        return [(lambda t, y: flank(s, t, y)[0], -1, "O"), (lambda t, y: flank(s, t, y)[1], -1, "O")]

    motion = simulate(
        rhs, guards, [0.0, amplitude * w], "O", duration, max_step=2e-5, rtol=rtol, atol=[1e-6 * rtol, rtol]
    )
    figures = object_figures(
        "lever", motion, duration,
        delta=lambda t, y, m: y[0] - law(t)[0],
        speed=lambda t, y, m: y[1], acceleration=lambda t, y, m: rhs(t, y, m)[1],
        reaction=contact,
    )
    figures |= pair_figures(
        "lever", motion, lambda mode: mode == "O", duration,
        approach=lambda t, before, after, y: sides[after] * (y[1] - law(t)[1]), force=contact,
    )
    figures["lever.final.displacement"], figures["lever.final.speed"] = motion.end
    figures["run.switches"] = len(motion.switches)
    return figures


if __name__ == "__main__":
    write(
        "grooved_cam",
        "Lever in a worn groove: absolute coordinates, DOP853 at rtol 1e-12, spread against rtol 1e-10. "
        "Script: grooved_cam.py.",
        {"worn_groove": twice(run)},
    )
