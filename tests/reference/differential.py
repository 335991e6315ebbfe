"""Reference figures of scenarios/differential.

held_ring, phase_adjuster and summing_lever in closed form; two_motors in absolute
coordinates by the classical Runge-Kutta method with Richardson extrapolation.
"""

import json
import math
from pathlib import Path


def held_ring():
    """A motor on the sun of a planetary gear whose ring is held; a rigid carrier.

    Willis: w_s - i0 w_r = (1 - i0) w_c, i0 = -72/24: w_c = w_s / 4. At the sun
    (J + Jc/16) w' = T0 (1 - w/w0) + W/4; the ring bears 3/4 of the carrier's force.
    """
    rotor, carrier, stall, no_load, load, end = 0.02, 0.4, 12.0, 150.0, -16.0, 0.4
    inertia = rotor + carrier / 16
    slope = stall / no_load
    final = (stall + load / 4) / slope
    rate = slope / inertia
    speed = final * (1 - math.exp(-rate * end))
    angle = final * (end - (1 - math.exp(-rate * end)) / rate)
    start = (stall + load / 4) / inertia
    force = load - carrier * start / 4
    return {
        "motor.final.displacement": angle,
        "motor.final.speed": speed,
        "gear.final.displacement": angle / 4,
        "gear.final.speed": speed / 4,
        "gear.peak_acceleration": start / 4,
        "gear.peak_reaction": abs(force),
        "housing.peak_reaction": 0.75 * abs(force),
        "housing.final.displacement": 0.0,
    }


def phase_adjuster():
    """A cylinder behind a planetary gear: the press turns the sun at constant speed, the
    adjusting drive accelerates the ring. J d'' + b d' + c d = -J (3/4) a from rest.
    """
    inertia, stiffness, damping = 0.5, 2e5, 40.0
    sun, adjust, end = 40.0, 60.0, 0.05
    asked = 0.75 * adjust
    static = -inertia * asked / stiffness
    decay = damping / (2 * inertia)
    frequency = math.sqrt(stiffness / inertia - decay**2)
    fall = math.exp(-decay * end)
    cos, sin = math.cos(frequency * end), math.sin(frequency * end)
    delta = static * (1 - fall * (cos + decay / frequency * sin))
    rate = static * fall * sin * (frequency + decay**2 / frequency)
    return {
        "cylinder.delta_min": static * (1 + math.exp(-decay * math.pi / frequency)),
        "cylinder.delta_max": 0.0,
        "cylinder.final.displacement": sun * end / 4 + asked * end**2 / 2 + delta,
        "cylinder.final.speed": sun / 4 + asked * end + rate,
        "press.final.displacement": sun * end,
        "adjuster.final.speed": adjust * end,
    }


def summing_lever():
    """Two rods on a lever, 0 and 0.5 m along it; the output at 0.3 m pulls a spring."""
    speed, place, rate, end = 0.1, 0.02, 3000.0, 0.5
    first, second = (0.5 - 0.3) / 0.5, 0.3 / 0.5
    out = first * speed * end + second * place
    force = rate * out
    return {
        "output.final.displacement": out,
        "output.final.speed": first * speed,
        "output.peak_reaction": force,
        "moving.peak_reaction": first * force,
        "held.peak_reaction": second * force,
        "held.final.displacement": place,
    }


def two_motors_rates(state):
    left, right, drum, v_left, v_right, v_drum = state
    stretch = drum - 0.5 * (left + right)
    rate = v_drum - 0.5 * (v_left + v_right)
    pull = 9000.0 * stretch + 12.0 * rate
    return (
        v_left,
        v_right,
        v_drum,
        (30.0 * (1 - v_left / 100.0) + 0.5 * pull) / 0.05,
        (24.0 * (1 - v_right / 80.0) + 0.5 * pull) / 0.08,
        (-pull - 35.0 - 0.2 * v_drum) / 0.3,
    )


def runge_kutta(rates, state, end, steps):
    h = end / steps
    moved = lambda y, k, f: [a + f * b for a, b in zip(y, k)]
    for _ in range(steps):
        k1 = rates(state)
        k2 = rates(moved(state, k1, h / 2))
        k3 = rates(moved(state, k2, h / 2))
        k4 = rates(moved(state, k3, h))
        state = [y + h / 6 * (a + 2 * b + 2 * c + d) for y, a, b, c, d in zip(state, k1, k2, k3, k4)]
    return state


def two_motors():
    """Two motors lift one load by a bevel differential: phi = (phi_1 + phi_2)/2."""
    end = 0.5
    coarse, fine = (runge_kutta(two_motors_rates, [0.0] * 6, end, n) for n in (40_000, 80_000))
    best = [f + (f - c) / 15 for c, f in zip(coarse, fine)]
    assert max(abs(b - f) for b, f in zip(best, fine)) < 1e-9
    left, right, drum, v_left, v_right, v_drum = best
    return {
        "left.final.displacement": left,
        "left.final.speed": v_left,
        "right.final.displacement": right,
        "right.final.speed": v_right,
        "drum.final.displacement": drum,
        "drum.final.speed": v_drum,
    }


if __name__ == "__main__":
    found = {f.__name__: f() for f in (held_ring, phase_adjuster, summing_lever, two_motors)}
    Path(__file__).with_suffix(".json").write_text(json.dumps(found, indent=2) + "\n")
    print(json.dumps(found, indent=2))
