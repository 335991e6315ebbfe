"""Reference figures of scenarios/valve_train: a cam, a follower and its valve spring.

Absolute coordinate y of the valve (m, positive open), cam law U(theta) from its
definition, contact force N = c(U - y) + b(U' w - y') cut off at zero.
"""

import math

from laws import cam, polynomial4567
from piecewise import exact, object_figures, pair_figures, simulate, twice, write

LIFT, RISE, DWELL, BACK, PHASE = 0.0105, *(math.radians(a) for a in (70, 4, 70, -30))
MASS, STIFFNESS, PSI = 0.3, 3.0e6, 0.5
RATE, PRELOAD = 40e3, 300.0
DAMPING = PSI * math.sqrt(STIFFNESS * MASS) / (2 * math.pi)


def law(phi):
    return cam(phi + PHASE, polynomial4567, LIFT, RISE, DWELL, BACK)


def joints(speed, duration):
    """Times at which the cam's formula changes."""
    angles = (0, RISE, RISE + DWELL, RISE + DWELL + BACK)
    turns = int(duration * speed / (2 * math.pi)) + 2
    return [(a - PHASE + 2 * math.pi * k) / speed for a in angles for k in range(-1, turns)]


def elastic(speed, duration, rtol):
    """One mass on the cam, engaged (E) or open (O)."""

    def press(t, y):  # penetration and Kelvin-Voigt force
        u, u1, _ = law(speed * t)
        p, rate = u - y[0], u1 * speed - y[1]
        return p, STIFFNESS * p + DAMPING * rate

    def contact(t, y, mode):
        return press(t, y)[1] if mode == "E" else 0.0

    def rhs(t, y, mode):
        return [y[1], (contact(t, y, mode) - PRELOAD - RATE * y[0]) / MASS]

    def guards(mode):
        if mode == "E":
            return [(lambda t, y: press(t, y)[0], -1, "O"), (lambda t, y: press(t, y)[1], -1, "O")]
        return [(lambda t, y: min(press(t, y)), +1, "E")]

    # spring at rest: c(0 - y) = preload + rate*y
    start = [-PRELOAD / (STIFFNESS + RATE), 0.0]
    motion = simulate(
        rhs, guards, start, "E", duration,
        breaks=joints(speed, duration), max_step=1e-4, rtol=rtol, atol=[1e-4 * rtol, rtol],
    )
    figures = object_figures(
        "valve", motion, duration,
        delta=lambda t, y, m: y[0] - law(speed * t)[0],
        speed=lambda t, y, m: y[1],
        acceleration=lambda t, y, m: rhs(t, y, m)[1],
        reaction=contact,
    )
    figures |= pair_figures(
        "valve", motion, lambda mode: mode == "O", duration,
        approach=lambda t, before, after, y: law(speed * t)[1] * speed - y[1],
        force=contact,
    )
    figures["valve.final.displacement"], figures["valve.final.speed"] = motion.end
    figures["valve.pair.in_working_order"] = steady(motion, speed, duration)
    return figures


def steady(motion, speed, duration):
    """1 when no separation falls into the last two turns of the cam, else 0."""
    openings = [s[0] for s in motion.switches if s[2] == "O"]
    return int(all(t < duration - 4 * math.pi / speed for t in openings))


def rigid(speed):
    """The same follower, rigid: N = m U'' w^2 + preload + rate U over the cam.

    Extremes from the stationary points of N in the rise (the return mirrors it):
    dN/dtau = m L w^2/beta^3 theta''' + rate L/beta theta' = 0, divided by
    theta'-factor tau^1(1-tau): roots of a polynomial, found by numpy.
    """
    import numpy as np

    theta1 = np.polynomial.Polynomial([0, 0, 0, 140, -420, 420, -140])
    third = theta1.deriv().deriv()
    theta = theta1.integ()
    n = (
        MASS * LIFT * speed**2 / RISE**2 * theta1.deriv()
        + PRELOAD
        + RATE * LIFT * theta
    )
    stationary = [r.real for r in n.deriv().roots() if abs(r.imag) < 1e-12 and 0 <= r.real <= 1]
    values = [float(n(tau)) for tau in stationary + [0.0, 1.0]]
    peak = float(max(abs(theta1.deriv()(r.real)) for r in third.roots() if 0 < r.real < 1))
    return {
        "valve.pair.margin": min(values),
        "valve.pair.max_contact_force": max(values),
        "valve.peak_reaction": max(abs(v) for v in values),
        "valve.peak_speed": LIFT / RISE * speed * 35 / 16,
        "valve.peak_acceleration": LIFT / RISE**2 * speed**2 * peak,
    }


def pushrod(speed, duration, rtol):
    """Tappet with pushrod (mass 1) and rocker arm with valve (mass 2), at the valve."""
    m1, m2, c1, c2, b1, b2 = 0.18, 0.16, 9.0e6, 4.5e6, 180.0, 120.0

    def press(t, y):
        u, u1, _ = law(speed * t)
        p, rate = u - y[0], u1 * speed - y[2]
        return p, c1 * p + b1 * rate

    def contact(t, y, mode):
        return press(t, y)[1] if mode == "E" else 0.0

    def rhs(t, y, mode):
        link = c2 * (y[1] - y[0]) + b2 * (y[3] - y[2])
        spring = PRELOAD + RATE * y[1]
        return [y[2], y[3], (contact(t, y, mode) + link) / m1, (-link - spring) / m2]

    def guards(mode):
        if mode == "E":
            return [(lambda t, y: press(t, y)[0], -1, "O"), (lambda t, y: press(t, y)[1], -1, "O")]
        return [(lambda t, y: min(press(t, y)), +1, "E")]

    series = 1 / (1 / c1 + 1 / c2)
    y2 = -PRELOAD / (series + RATE)
    force = PRELOAD + RATE * y2
    start = [-force / c1, y2, 0.0, 0.0]
    motion = simulate(
        rhs, guards, start, "E", duration,
        breaks=joints(speed, duration), max_step=4e-5, rtol=rtol,
        atol=[1e-4 * rtol, 1e-4 * rtol, rtol, rtol],
    )
    figures = object_figures(
        "valve", motion, duration,
        delta=lambda t, y, m: y[1] - law(speed * t)[0],
        speed=lambda t, y, m: y[3],
        acceleration=lambda t, y, m: rhs(t, y, m)[3],
        reaction=contact,
    )
    figures |= pair_figures(
        "valve", motion, lambda mode: mode == "O", duration,
        approach=lambda t, before, after, y: law(speed * t)[1] * speed - y[2],
        force=contact,
    )
    figures["valve.final.displacement"], figures["valve.final.speed"] = motion.end[1], motion.end[3]
    figures["valve.pair.in_working_order"] = steady(motion, speed, duration)
    return figures


RPM = 2 * math.pi / 60
if __name__ == "__main__":
    write(
        "valve_train",
        "Cam follower of a valve train: absolute coordinates, DOP853 at rtol 1e-12, spread against "
        "rtol 1e-10; the rigid follower in closed form. Script: valve_train.py.",
        {
            "in_working_order": twice(lambda rtol: elastic(1500 * RPM, 0.16, rtol)),
            "lift_off": twice(lambda rtol: elastic(1950 * RPM, 0.16, rtol)),
            "rigid_margin": exact(rigid(1500 * RPM)),
            "pushrod": twice(lambda rtol: pushrod(1800 * RPM, 0.2, rtol)),
        },
    )
