"""Reference figures of scenarios/four_bar: the sley of a loom, four-bar and elastic reed.

The sley's motion psi(t) is the loop closure of the four-bar; the reed is two
masses in absolute angles behind it; the cloth resists while the sley is beyond
its beat-up angle.
"""

import math

import numpy as np
from laws import four_bar
from piecewise import Motion, object_figures, simulate, twice, write
from scipy.optimize import brentq

CRANK, COUPLER, ROCKER, FRAME = 0.04, 0.12, 0.1, 0.13
SPEED, PHASE = 300 * 2 * math.pi / 60, math.radians(90)
INERTIA, STIFFNESS, PSI = 0.06, 4.0e4, 0.35
J1, J2 = INERTIA / 8, INERTIA * 7 / 8  # cut in two: shares 1 and 7 of 8
C = 2 * STIFFNESS
B = PSI * C / (2 * math.pi * math.sqrt(STIFFNESS / INERTIA))
BEAT, FROM = -160.0, math.radians(139.5)  # moment against the sley beyond its beat-up angle


def sley(t):
    psi, first, second = four_bar(SPEED * t + PHASE, CRANK, COUPLER, ROCKER, FRAME)
    return psi, first * SPEED, second * SPEED**2


def jerk(t):
    """Third derivative of psi, by a sixth-order central difference of the second."""
    h = 2e-5
    f = [sley(t + k * h)[2] for k in (-3, -2, -1, 1, 2, 3)]
    return float(np.dot([-1, 9, -45, 45, -9, 1], f)) / (60 * h)


def rhs(t, y, mode):
    psi, rate, _ = sley(t)
    first = C * (y[0] - psi) + B * (y[2] - rate)
    second = C * (y[1] - y[0]) + B * (y[3] - y[2])
    load = BEAT if mode == "beat" else 0.0
    return [y[2], y[3], (second - first) / J1, (load - second) / J2]


def run(rtol, duration=0.8):
    # quiet start: each link carries the inertia of what is behind it
    psi, rate, a = sley(0.0)
    third = jerk(0.0)
    d1 = -(J1 + J2) / C
    d2 = d1 - J2 / C
    start = [psi + d1 * a, psi + d2 * a, rate + d1 * third, rate + d2 * third]
    edge = lambda t: sley(t)[0] - FROM
    grid = np.linspace(0, duration, 8001)
    values = [edge(t) for t in grid]
    breaks = [brentq(edge, p, q, xtol=1e-16) for p, q, u, v in zip(grid, grid[1:], values, values[1:]) if u * v < 0]

    mode, times, time, state = ("beat" if edge(0.0) > 0 else "free"), breaks + [duration], 0.0, start
    motion = Motion()
    for stop in times:
        shift = time
        part = simulate(
            lambda t, y, m: rhs(t + shift, y, m), lambda m: [], state, mode, stop - time,
            max_step=1e-4, rtol=rtol, atol=[1e-4 * rtol] * 2 + [1e-2 * rtol] * 2,
        )
        for m, solution in part.pieces:
            motion.pieces.append((m, Shifted(solution, shift)))
        state, time = part.end, stop
        mode = "free" if mode == "beat" else "beat"
    figures = {
        "sley.peak_speed": motion.peak(lambda t, y, m: sley(t)[1]),
        "sley.peak_acceleration": motion.peak(lambda t, y, m: sley(t)[2]),
        "sley.final.displacement": sley(duration)[0],
        "sley.final.speed": sley(duration)[1],
    }
    figures |= object_figures(
        "reed", motion, duration,
        delta=lambda t, y, m: y[1] - sley(t)[0], speed=lambda t, y, m: y[3],
        acceleration=lambda t, y, m: rhs(t, y, m)[3],
        reaction=lambda t, y, m: C * (y[0] - sley(t)[0]) + B * (y[2] - sley(t)[1]),
    )
    figures["reed.final.displacement"], figures["reed.final.speed"] = state[1], state[3]
    print(f"# sley between {math.degrees(min(v + FROM for v in values)):.4f} and {math.degrees(max(v + FROM for v in values)):.4f} deg, {len(breaks)} ends of the beat-up")
    return figures


class Shifted:
    """A solution that starts at another time."""

    def __init__(self, solution, shift):
        self.t = solution.t + shift
        self.y = solution.y
        self.sol = lambda t: solution.sol(t - shift)


if __name__ == "__main__":
    write(
        "loom_sley",
        "Sley of a loom: loop closure and absolute angles, DOP853 at rtol 1e-12, spread against rtol 1e-10. "
        "Script: loom_sley.py.",
        {"loom_sley": twice(run)},
    )
