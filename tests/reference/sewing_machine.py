"""Reference figures of scenarios/fan_out: one crank moves needle bar and take-up lever.

Absolute coordinates: motor, arm shaft, take-up lever; the needle bar is rigid
and enters the shaft's equation through Lagrange.
"""

import math

from laws import four_bar, slider_crank
from piecewise import object_figures, simulate, twice, write

ROTOR, STALL, NO_LOAD = 1.6e-4, 4.0, 450.0
SHAFT_J, SHAFT_C, SHAFT_PSI = 3.0e-4, 900.0, 0.3
NEEDLE, CRANK, ROD, VISCOUS = 0.055, 0.0155, 0.05, 0.8
LEVER_J, LEVER_C, LEVER_PSI = 1.1e-5, 220.0, 0.3
BAR = dict(crank=0.012, coupler=0.034, rocker=0.03, frame=0.04)
LEVER_PHASE = math.radians(40)
PIERCE, FIRST, LAST = -9.0, math.radians(285), math.radians(330)
# thread tension on the lever over the shaft's angle (deg, N m), one turn
TENSION = [(20, 0.0), (90, -0.02), (150, -0.12), (200, 0.0)]


def damper(psi, stiffness, inertia):
    return psi * math.sqrt(stiffness * inertia) / (2 * math.pi)


SHAFT_B, LEVER_B = damper(SHAFT_PSI, SHAFT_C, SHAFT_J), damper(LEVER_PSI, LEVER_C, LEVER_J)


def lever_law(phi):
    return four_bar(phi + LEVER_PHASE, **BAR)


def tension(phi):
    degrees = math.degrees(phi) % 360
    for (a, va), (b, vb) in zip(TENSION[:-1], TENSION[1:]):
        if a <= degrees <= b:
            return va + (vb - va) * (degrees - a) / (b - a)
    return 0.0


def parts(y, mode):
    motor, shaft, lever, w_motor, w_shaft, w_lever = y
    twist = SHAFT_C * (shaft - motor) + SHAFT_B * (w_shaft - w_motor)
    psi, psi1, _ = lever_law(shaft)
    bend = LEVER_C * (lever - psi) + LEVER_B * (w_lever - psi1 * w_shaft)
    x, x1, x2 = slider_crank(shaft, CRANK, ROD)
    push = (PIERCE if mode % len(EDGES) == PIERCING else 0.0) - VISCOUS * x1 * w_shaft
    torque = STALL * (1 - w_motor / NO_LOAD)
    a_shaft = (-twist + psi1 * bend + push * x1 - NEEDLE * x1 * x2 * w_shaft**2) / (SHAFT_J + NEEDLE * x1 * x1)
    a_needle = x1 * a_shaft + x2 * w_shaft**2
    return {
        "twist": twist, "bend": bend, "delta": lever - psi,
        "a": ((torque + twist) / ROTOR, a_shaft, (tension(shaft) - bend) / LEVER_J),
        "needle": (x, x1 * w_shaft, a_needle, push - NEEDLE * a_needle),
    }


# corners of loads over the shaft's angle, in order; the mode counts them through
EDGES = [math.radians(a) for a in (20, 90, 150, 200, 285, 330)]
PIERCING = 5  # after edge 285 and before 330: mode = 5 (mod 6)


def rhs(t, y, mode):
    return [y[3], y[4], y[5], *parts(y, mode)["a"]]


def guards(mode):
    # mode k: between edge k-1 and edge k of the endless sequence
    edge = lambda k: EDGES[k % 6] + 2 * math.pi * (k // 6)
    return [
        (lambda t, y: y[1] - edge(mode), +1, mode + 1),
        (lambda t, y: y[1] - edge(mode - 1), -1, mode - 1),
    ]


def run(rtol, duration=0.15):
    start = [0.0, 0.0, lever_law(0.0)[0], 0.0, 0.0, 0.0]
    motion = simulate(
        rhs, guards, start, 0, duration, max_step=1e-4, rtol=rtol,
        atol=[1e-4 * rtol] * 3 + [1e-2 * rtol] * 3,
    )
    figures = {
        "motor.peak_speed": motion.peak(lambda t, y, m: y[3]),
        "motor.final.displacement": motion.end[0],
        "motor.final.speed": motion.end[3],
    }
    figures |= object_figures(
        "arm_shaft", motion, duration,
        delta=lambda t, y, m: y[1] - y[0], speed=lambda t, y, m: y[4],
        acceleration=lambda t, y, m: parts(y, m)["a"][1], reaction=lambda t, y, m: parts(y, m)["twist"],
    )
    figures["arm_shaft.final.displacement"] = motion.end[1]
    figures |= object_figures(
        "needle_bar", motion, duration,
        speed=lambda t, y, m: parts(y, m)["needle"][1], acceleration=lambda t, y, m: parts(y, m)["needle"][2],
        reaction=lambda t, y, m: parts(y, m)["needle"][3],
    )
    figures |= object_figures(
        "take_up", motion, duration,
        delta=lambda t, y, m: parts(y, m)["delta"], speed=lambda t, y, m: y[5],
        acceleration=lambda t, y, m: parts(y, m)["a"][2], reaction=lambda t, y, m: parts(y, m)["bend"],
    )
    figures["take_up.final.displacement"], figures["take_up.final.speed"] = motion.end[2], motion.end[5]
    print(f"# {motion.end[1] / 2 / math.pi:.2f} turns")
    return figures


if __name__ == "__main__":
    write(
        "sewing_machine",
        "Sewing machine: absolute coordinates, DOP853 at rtol 1e-12, spread against rtol 1e-10. "
        "Script: sewing_machine.py.",
        {"sewing_machine": twice(run)},
    )
