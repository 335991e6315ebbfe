"""Reference figures of scenarios/press: asynchronous motor, belt, flywheel, gear, crank, ram.

Absolute coordinates: motor angle, flywheel angle, crankshaft angle, ram position.
The belt, the gear shaft and the frame with the rod are springs with dampers
between them; the blow is a constant force while the crank is in its window.
The ejector is a lever in fragments on an eccentric of the crankshaft, pressed
to it by a spring at its tip.
"""

import math

from laws import slider_crank
from piecewise import object_figures, pair_figures, simulate, twice, write

# 4-pole motor, 3 kW at 1440 rpm: 19.9 N m, breakdown torque 2.6 times that
ROTOR, BREAKDOWN, SLIP, SYNCHRONOUS = 0.0095, 51.7, 0.2, 1500 * 2 * math.pi / 60
BELT_RATIO, FLYWHEEL, BELT, BELT_DAMPING_CAPACITY = 0.25, 8.0, 2.5e4, 0.8
GEAR_RATIO, CRANKSHAFT, SHAFT, SHAFT_DAMPING_CAPACITY = 0.28, 1.8, 1.2e6, 0.3
CRANK, ROD, RAM, FRAME, FRAME_DAMPING_CAPACITY = 0.04, 0.4, 85.0, 3.0e8, 0.5
BLOW, FIRST, LAST = -180e3, math.radians(335), math.radians(357)
FRICTION, WIDTH = 900.0, 0.01
# The ejector: lever, eccentric (lowest at the crank's outer dead centre), spring
LEVER, BENDING, LEVER_DAMPING_CAPACITY, PIECES = 0.8, 9.0e5, 0.4, 5
SWING, RATE, PRELOAD = math.radians(15), 10.0, 15.0


def damper(psi, stiffness, inertia):
    return psi * math.sqrt(stiffness * inertia) / (2 * math.pi)


BELT_B = damper(BELT_DAMPING_CAPACITY, BELT, FLYWHEEL)
SHAFT_B = damper(SHAFT_DAMPING_CAPACITY, SHAFT, CRANKSHAFT)
FRAME_B = damper(FRAME_DAMPING_CAPACITY, FRAME, RAM)


def forces(y, blow):
    """Belt moment at the flywheel, shaft moment at the crankshaft, frame force at the ram, ram load."""
    motor, fly, crank, ram, w_motor, w_fly, w_crank, v_ram = y
    belt = BELT * (BELT_RATIO * motor - fly) + BELT_B * (BELT_RATIO * w_motor - w_fly)
    shaft = SHAFT * (GEAR_RATIO * fly - crank) + SHAFT_B * (GEAR_RATIO * w_fly - w_crank)
    x, x1, _ = slider_crank(crank, CRANK, ROD)
    frame = FRAME * (x - ram) + FRAME_B * (x1 * w_crank - v_ram)
    load = (BLOW if blow else 0.0) - FRICTION * math.tanh(v_ram / WIDTH)
    return belt, shaft, frame, x1, load


def rhs(t, y, mode):
    belt, shaft, frame, x1, load = forces(y, mode == "blow")
    slip = 1 - y[4] / SYNCHRONOUS
    torque = 2 * BREAKDOWN / (slip / SLIP + SLIP / slip) if slip else 0.0
    return [
        y[4], y[5], y[6], y[7],
        (torque - BELT_RATIO * belt) / ROTOR,
        (belt - GEAR_RATIO * shaft) / FLYWHEEL,
        (shaft - x1 * frame) / CRANKSHAFT,
        (frame + load) / RAM,
    ]


def guards(mode):
    # inside the window sin((phi - first)/2) and sin((last - phi)/2) have equal sign
    middle, half = (FIRST + LAST) / 2, (LAST - FIRST) / 2
    inside = lambda t, y: math.cos(y[2] - middle) - math.cos(half)
    return [(inside, -1, "idle")] if mode == "blow" else [(inside, +1, "blow")]


def run(speed, duration, rtol):
    """Starts on the law with the links unloaded, motor at `speed`, crank at its outer dead centre."""
    w = [speed, BELT_RATIO * speed, BELT_RATIO * GEAR_RATIO * speed, 0.0]
    start = [0.0, 0.0, 0.0, CRANK + ROD] + w
    scale = [1.0, 0.1, 1e-2, 1e-3]
    motion = simulate(
        rhs, guards, start, "idle", duration, max_step=2e-4, rtol=rtol,
        atol=[1e-3 * rtol * s for s in scale] + [rtol * s for s in scale],
    )
    figures = {}
    figures["motor.peak_speed"] = motion.peak(lambda t, y, m: y[4])
    figures["motor.final.displacement"], figures["motor.final.speed"] = motion.end[0], motion.end[4]
    figures |= object_figures(
        "flywheel", motion, duration,
        delta=lambda t, y, m: y[1] - BELT_RATIO * y[0],
        speed=lambda t, y, m: y[5], acceleration=lambda t, y, m: rhs(t, y, m)[5],
        reaction=lambda t, y, m: forces(y, False)[0],
    )
    figures["flywheel.final.speed"] = motion.end[5]
    figures |= object_figures(
        "crankshaft", motion, duration,
        delta=lambda t, y, m: y[2] - GEAR_RATIO * y[1],
        speed=lambda t, y, m: y[6], acceleration=lambda t, y, m: rhs(t, y, m)[6],
        reaction=lambda t, y, m: forces(y, False)[1],
    )
    figures["crankshaft.final.displacement"] = motion.end[2]
    figures |= object_figures(
        "ram", motion, duration,
        delta=lambda t, y, m: y[3] - slider_crank(y[2], CRANK, ROD)[0],
        speed=lambda t, y, m: y[7], acceleration=lambda t, y, m: rhs(t, y, m)[7],
        reaction=lambda t, y, m: forces(y, False)[2],
    )
    figures["ram.final.displacement"], figures["ram.final.speed"] = motion.end[3], motion.end[7]
    least = motion.extremes(lambda t, y, m: y[5])[0]
    print(f"# flywheel speed {least:.3f} rad/s at least, {len(motion.switches)} ends of the window")
    return figures


LEVER_J = [LEVER * ((m + 1) ** 3 - m**3) / PIECES**3 for m in range(PIECES)]
LEVER_C = PIECES * BENDING
LEVER_B = LEVER_DAMPING_CAPACITY * LEVER_C / (2 * math.pi * math.sqrt(BENDING / LEVER))
HEAD = 4 + PIECES  # displacements: motor, flywheel, crankshaft, ram, fragments; then the speeds


def eccentric(crank):
    """U and U' of the ejector."""
    return -SWING * math.cos(crank), SWING * math.sin(crank)


def press(y):
    """Penetration of the lever's root into its eccentric, and the Kelvin-Voigt force."""
    u, u1 = eccentric(y[2])
    depth, rate = u - y[4], u1 * y[HEAD + 2] - y[HEAD + 4]
    return depth, LEVER_C * depth + LEVER_B * rate


def ejecting(t, y, mode):
    shift = list(y[:4]) + list(y[HEAD : HEAD + 4])
    drive = rhs(t, shift, "idle")
    push = press(y)[1] if mode == "E" else 0.0
    crank = drive[6] - push * eccentric(y[2])[1] / CRANKSHAFT
    forces = [push]
    for m in range(PIECES - 1):
        bend, rate = y[4 + m] - y[5 + m], y[HEAD + 4 + m] - y[HEAD + 5 + m]
        forces.append(LEVER_C * bend + LEVER_B * rate)
    forces.append(PRELOAD + RATE * y[3 + PIECES])
    lever = [(forces[m] - forces[m + 1]) / LEVER_J[m] for m in range(PIECES)]
    return list(y[HEAD:]) + [drive[4], drive[5], crank, drive[7]] + lever


def ejector(speed, duration, rtol):
    """Starts on the law with the links unloaded, the lever lowest and at rest."""

    def guards(mode):
        # The eccentric pushes the lever from t = 0 on, as U'' w^2 t^2/2: in the first
        # microsecond less than the rounding of the angles, which is no switch.
        held = lambda k: lambda t, y: press(y)[k] if t > 1e-6 else 1.0
        if mode == "E":
            return [(held(0), -1, "O"), (held(1), -1, "O")]
        return [(lambda t, y: min(press(y)), +1, "E")]

    def push(t, y, mode):
        return press(y)[1] if mode == "E" else 0.0

    w = [speed, BELT_RATIO * speed, BELT_RATIO * GEAR_RATIO * speed, 0.0]
    start = [0.0, 0.0, 0.0, CRANK + ROD] + [-SWING] * PIECES + w + [0.0] * PIECES
    scale = [1.0, 0.1, 1e-2, 1e-3] + [1e-2] * PIECES
    motion = simulate(
        ejecting, guards, start, "E", duration, max_step=1e-4, rtol=rtol,
        atol=[1e-3 * rtol * s for s in scale] + [rtol * s for s in scale],
    )
    tip = 3 + PIECES
    figures = object_figures(
        "ejector", motion, duration,
        delta=lambda t, y, m: y[tip] - eccentric(y[2])[0],
        speed=lambda t, y, m: y[HEAD + tip],
        acceleration=lambda t, y, m: ejecting(t, y, m)[HEAD + tip],
        reaction=push,
    )
    figures |= pair_figures(
        "ejector", motion, lambda mode: mode == "O", duration,
        approach=lambda t, before, after, y: eccentric(y[2])[1] * y[HEAD + 2] - y[HEAD + 4],
        force=push,
    )
    figures["ejector.final.displacement"], figures["ejector.final.speed"] = motion.end[tip], motion.end[HEAD + tip]
    for name, delta in {
        "flywheel": lambda t, y, m: y[1] - BELT_RATIO * y[0],
        "crankshaft": lambda t, y, m: y[2] - GEAR_RATIO * y[1],
        "ram": lambda t, y, m: y[3] - slider_crank(y[2], CRANK, ROD)[0],
    }.items():
        figures[f"{name}.delta_min"], figures[f"{name}.delta_max"] = motion.extremes(delta)
    figures["motor.final.displacement"], figures["motor.final.speed"] = motion.end[0], motion.end[HEAD]
    for time, before, after, y in motion.switches:
        print(f"# {time:.9f} {before} -> {after}")
    return figures


if __name__ == "__main__":
    write(
        "press",
        "Eccentric press: absolute coordinates, DOP853 at rtol 1e-12, spread against rtol 1e-10. "
        "Script: press.py.",
        {
            "punching": twice(lambda rtol: run(155.0, 1.5, rtol)),
            "run_up": twice(lambda rtol: run(0.0, 1.2, rtol)),
            "ejector": twice(lambda rtol: ejector(155.0, 0.6, rtol)),
        },
    )
