"""Least contact force, preload and speed of lift-off of elastic followers, and a valve behind a tappet.

A follower as a chain of masses m_i at the absolute coordinates y_i, links c_i, b_i, the first
against the cam, a closing spring P + R y_n on the last mass. While the contact is closed the chain
is linear, and its steady motion repeats with each turn: with the lift as a Fourier series
U = sum U_k e^{ik phi} the steady motion is Y_k = K(ik w)^-1 (c_1 + ik w b_1) U_k e_1, and the
contact force N = c_1 (U - y_1) + b_1 (U' w - y_1') follows term by term. No integration, no start,
no event: nothing is shared with the program, which runs the chain from rest until it repeats.

- margin: the least N over a turn (fine grid, then parabola through three points).
- preload_needed: N is that of P = 0 plus P * (share of the chain), so P is the zero.
- lift_off_speed: bisection on min N = 0 over the speed, from the scene's speed upwards;
  speed_for_50_N: the same on min N = 50 N.

- lightly damped followers lift off in many narrow bands of speed, each about a resonance. The first
  is found by steps of 2e-5 of the speed from far below, with N on 2^12 places of the turn, then
  bisection with N on 2^15: nothing of resonances is used.

The tappet: rigid, a valve behind it by a constant ratio r, the spring on the valve:
N = (m_t + r^2 m_v) U'' w^2 + r (P + R r U), so P_needed = max over phi of -(N without P)/r.
"""

import json
import math
from pathlib import Path

import numpy as np

from laws import cam, polynomial4567

LIFT, RISE, DWELL, BACK, PHASE = 0.0105, *(math.radians(a) for a in (70, 4, 70, -30))
RPM = 2 * math.pi / 60
RATE, PRELOAD = 40e3, 300.0
POINTS = 1 << 15


def lift(phi):
    return cam(phi + PHASE, polynomial4567, LIFT, RISE, DWELL, BACK)


GRID = 2 * math.pi * np.arange(POINTS) / POINTS
TABLE = np.array([lift(phi) for phi in GRID]).T
SPECTRUM = np.fft.rfft(TABLE[0])


def chain(masses, stiffness, damping, speed, preload):
    """Contact force on GRID, closed throughout."""
    n = len(masses)
    order = np.arange(len(SPECTRUM))
    s = 1j * order * speed
    links = [c + s * b for c, b in zip(stiffness, damping)]
    force = np.zeros(len(order), complex)
    for k in range(len(order)):
        matrix = np.zeros((n, n), complex)
        for i, m in enumerate(masses):
            matrix[i, i] += m * s[k] ** 2
        for i in range(n):
            matrix[i, i] += links[i][k]
            if i:
                matrix[i - 1, i - 1] += links[i][k]
                matrix[i - 1, i] -= links[i][k]
                matrix[i, i - 1] -= links[i][k]
        matrix[-1, -1] += RATE
        right = np.zeros(n, complex)
        right[0] += links[0][k] * SPECTRUM[k]
        if k == 0:
            right[-1] -= preload * POINTS
        y = np.linalg.solve(matrix, right)
        force[k] = links[0][k] * (SPECTRUM[k] - y[0])
    return np.fft.irfft(force, POINTS)


def least(values):
    """Minimum of a periodic table: parabola through the three lowest neighbours."""
    i = int(np.argmin(values))
    a, b, c = values[i - 1], values[i], values[(i + 1) % len(values)]
    shift = 0.5 * (a - c) / (a - 2 * b + c)
    return float(b - 0.25 * (a - c) * shift), float((GRID[i] + shift * GRID[1]) % (2 * math.pi))


def results(masses, stiffness, damping, rpm):
    speed = rpm * RPM
    margin, angle = least(chain(masses, stiffness, damping, speed, PRELOAD))
    at = [least(chain(masses, stiffness, damping, speed, p))[0] for p in (0.0, PRELOAD)]
    share = (at[1] - at[0]) / PRELOAD

    def speed_for(force):
        low = high = speed
        while least(chain(masses, stiffness, damping, high, PRELOAD))[0] > force:
            low, high = high, 1.02 * high
        for _ in range(25):
            middle = 0.5 * (low + high)
            if least(chain(masses, stiffness, damping, middle, PRELOAD))[0] > force:
                low = middle
            else:
                high = middle
        return 0.5 * (low + high)

    return {
        "margin": margin,
        "margin_angle": angle,
        "preload_needed": -at[0] / share,
        "lift_off_speed": speed_for(0.0),
        "speed_for_50_N": speed_for(50.0),
    }


def harmonic(tau):
    w = math.pi
    return (1 - math.cos(w * tau)) / 2, w * math.sin(w * tau) / 2, w * w * math.cos(w * tau) / 2


class LightlyDamped:
    """One mass of 0.4 kg on 3 kN/mm behind a harmonic law, closed throughout: N over a turn."""

    def __init__(self, capacity, preload):
        self.mass, self.stiffness, self.rate, self.preload = 0.4, 3e6, 10e3, preload
        self.damping = capacity * math.sqrt(self.stiffness * self.mass) / (2 * math.pi)
        rise, dwell = math.radians(120), math.radians(30)
        table = [cam(phi, harmonic, 12e-3, rise, dwell, rise)[0] for phi in GRID]
        self.spectrum = np.fft.rfft(table)

    def least(self, speed, points):
        order = np.arange(points // 2 + 1)
        share = points / POINTS
        lift = share * self.spectrum[: points // 2 + 1]
        s = 1j * order * speed
        link = self.stiffness + s * self.damping
        right = link * lift
        right[0] -= self.preload * points
        y = right / (self.mass * s * s + link + self.rate)
        return float(np.min(np.fft.irfft(link * (lift - y), points)))

    def edge(self, low, high):
        """Where the least force becomes negative between two speeds."""
        for _ in range(30):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.least(middle, POINTS) > 0 else (low, middle)
        return 0.5 * (low + high)

    def first_edge(self, low, high):
        """The least speed at which the least force becomes negative, by small steps."""
        speed, step = low, 2e-5
        while speed < high:
            if self.least(speed * (1 + step), 1 << 12) <= 0:
                return self.edge(speed * (1 - step), speed * (1 + 2 * step))
            speed *= 1 + step
        return None


def valve_behind_tappet(rpm, tappet=0.08, valve=0.12, ratio=1.5, preload=200.0, rate=30e3):
    speed = rpm * RPM
    u, _, u2 = TABLE
    without = (tappet + ratio**2 * valve) * u2 * speed**2 + ratio * rate * ratio * u
    force = without + ratio * preload
    return {
        "margin": least(force)[0],
        "preload_needed": -least(without / ratio)[0],
        "lift_off_speed": float(
            np.sqrt(np.min((ratio * (preload + rate * ratio * u))[u2 < 0]
                           / (-(tappet + ratio**2 * valve) * u2[u2 < 0])))
        ),
    }


if __name__ == "__main__":
    one = 0.5 * math.sqrt(3e6 * 0.3) / (2 * math.pi)
    found = {
        "valve-pushrod-one-mass at 1500 rpm": results([0.3], [3e6], [one], 1500),
        "two masses at 1500 rpm": results([0.18, 0.16], [9e6, 4.5e6], [180.0, 120.0], 1500),
        "tappet with a valve behind it at 2000 rpm": valve_behind_tappet(2000),
    }
    for capacity, preload, low in [(0.02, 60, 300), (0.02, 100, 400), (0.002, 60, 150)]:
        edge = LightlyDamped(capacity, preload).first_edge(low * RPM, 1000 * RPM)
        found[f"lightly damped, {capacity}, {preload} N"] = {"lift_off_speed": edge}
    about = "Steady contact force of elastic followers by Fourier series; see contact_force.py."
    path = Path(__file__).with_name("contact_force.json")
    path.write_text(json.dumps({"about": about, "scenes": found}, indent=1) + "\n")
    print(json.dumps(found, indent=1))
