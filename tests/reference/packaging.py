"""Reference figures of scenarios/packaging: a cam lever pushes a slide, Hunt-Crossley contact.

Absolute angle of the lever and absolute position of the pusher. The lever is
driven towards negative angles; the closing moment holds it against the cam
from there, so the contact presses with p = x = lever - U > 0.
"""

import math

from laws import cam, polynomial345
from piecewise import object_figures, pair_figures, simulate, twice, write

SPEED, PHASE = 240 * 2 * math.pi / 60, math.radians(-20)
LIFT, ANGLES = math.radians(-25), [math.radians(a) for a in (100, 40, 100)]
LENGTH, WIDTH, HEIGHT, DENSITY, MODULUS = 0.08, 0.016, 0.025, 7850, 210e9
LEVER = DENSITY * WIDTH * HEIGHT * LENGTH**3 / 3
STIFFNESS = 3 * MODULUS * (WIDTH * HEIGHT**3 / 12) / LENGTH
LEVER_PSI, CLOSING = 0.2, 12.0
LEVER_B = LEVER_PSI * math.sqrt(STIFFNESS * LEVER) / (2 * math.pi)
KAPPA = LEVER_B / CLOSING  # b/(c p*) with the static penetration p* = closing/c
ARM, PUSHER, PUSHER_C, PUSHER_PSI = 0.08, 1.2, 2.0e6, 0.3
PUSHER_B = PUSHER_PSI * math.sqrt(PUSHER_C * PUSHER) / (2 * math.pi)
PRODUCT, FIRST, LAST = 30.0, math.radians(-30), math.radians(-15)


def law(t):
    u, u1, u2 = cam(SPEED * t + PHASE, polynomial345, LIFT, *ANGLES)
    return u, u1 * SPEED, u2 * SPEED**2


def pressing(t, y):
    u, v, _ = law(t)
    return y[0] - u, 1 + KAPPA * (y[2] - v)


def contact(t, y, mode):
    p, factor = pressing(t, y)
    return STIFFNESS * p * factor if mode[0] == "engaged" else 0.0


def bend(y):
    return PUSHER_C * (y[1] - ARM * y[0]) + PUSHER_B * (y[3] - ARM * y[2])


def rhs(t, y, mode):
    load = PRODUCT if mode[1] == "product" else 0.0
    return [
        y[2], y[3],
        (CLOSING - contact(t, y, mode) + ARM * bend(y)) / LEVER,
        (load - bend(y)) / PUSHER,
    ]


def guards(mode):
    pair, product = mode
    watch = []
    if pair == "engaged":
        watch += [(lambda t, y, k=k: pressing(t, y)[k], -1, ("open", product)) for k in (0, 1)]
    else:
        watch += [(lambda t, y: min(pressing(t, y)), +1, ("engaged", product))]
    if product == "product":
        watch += [(lambda t, y: y[0] - LAST, +1, (pair, "free"))]
    else:
        watch += [(lambda t, y: y[0] - LAST, -1, (pair, "product"))]
    return watch


def run(rtol, duration=0.75):
    edges = [0.0, ANGLES[0], ANGLES[0] + ANGLES[1], sum(ANGLES)]
    breaks = [(e - PHASE + 2 * math.pi * k) / SPEED for e in edges for k in range(-1, 4)]
    start = [CLOSING / STIFFNESS, ARM * CLOSING / STIFFNESS, 0.0, 0.0]
    motion = simulate(
        rhs, guards, start, ("engaged", "free"), duration, breaks=breaks, max_step=3e-5, rtol=rtol,
        atol=[1e-6 * rtol, 1e-6 * rtol, 1e-2 * rtol, 1e-2 * rtol],
    )
    figures = object_figures(
        "lever", motion, duration,
        delta=lambda t, y, m: y[0] - law(t)[0], speed=lambda t, y, m: y[2],
        acceleration=lambda t, y, m: rhs(t, y, m)[2], reaction=contact,
    )
    figures |= pair_figures(
        "lever", motion, lambda m: m[0] == "open", duration,
        approach=lambda *a: 0.0, force=contact,
    )
    figures["lever.pair.in_working_order"] = int(figures["lever.pair.separations"] == 0)
    figures["lever.final.displacement"], figures["lever.final.speed"] = motion.end[0], motion.end[2]
    figures |= object_figures(
        "pusher", motion, duration,
        delta=lambda t, y, m: y[1] - ARM * y[0], speed=lambda t, y, m: y[3],
        acceleration=lambda t, y, m: rhs(t, y, m)[3], reaction=lambda t, y, m: bend(y),
    )
    figures["pusher.final.displacement"], figures["pusher.final.speed"] = motion.end[1], motion.end[3]
    print("#", len(motion.switches), "switches", [round(s[0], 4) for s in motion.switches])
    return figures


if __name__ == "__main__":
    write(
        "packaging",
        "Cam lever and pusher: absolute coordinates, DOP853 at rtol 1e-12, spread against rtol 1e-10. "
        "Script: packaging.py.",
        {"pusher": twice(run)},
    )
