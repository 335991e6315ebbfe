"""Greatest spring force of one mass that is lifted out of a dwell, for every motion law.

    m x'' = k (U(t) - x),  x(0) = x'(0) = 0,  U = h f(tau), tau = t / T

A drive at constant speed, one rise of 60 degrees and 60 degrees of the dwell after it. Laws by their accelerations, each scaled so that f(1) = 1, integrated together with
the mass by scipy's DOP853 at 1e-12, piece by piece. Shares nothing with the program.

Run: python3 tests/reference/starts.py > tests/reference/starts.json
"""
import json
from math import cos, pi, sin

import numpy as np
from scipy.integrate import solve_ivp

M, K, H = 2.0, 2e5, 0.02
OMEGA = 300 * 2 * pi / 60
T = (pi / 3) / OMEGA
END = 2 * T


def symmetric(pieces):
    """Pieces of the first half of an acceleration, and the second half by symmetry."""
    mirrored = [(1 - b, 1 - a, (lambda f: lambda x: -f(1 - x))(f)) for a, b, f in reversed(pieces)]
    return pieces + mirrored


ONE = lambda x: 1.0
LAWS = {
    "parabolic": symmetric([(0, 0.5, ONE)]),
    "harmonic": symmetric([(0, 0.5, lambda x: cos(pi * x))]),
    "cycloidal": symmetric([(0, 0.5, lambda x: sin(2 * pi * x))]),
    "modified_trapezoid": symmetric(
        [
            (0, 1 / 8, lambda x: sin(4 * pi * x)),
            (1 / 8, 3 / 8, ONE),
            (3 / 8, 0.5, lambda x: sin(4 * pi * (x - 1 / 4))),
        ]
    ),
    "modified_sine": symmetric(
        [
            (0, 1 / 8, lambda x: sin(4 * pi * x)),
            (1 / 8, 0.5, lambda x: cos(4 * pi / 3 * (x - 1 / 8))),
        ]
    ),
    "modified_constant_velocity": symmetric(
        [
            (0, 1 / 16, lambda x: sin(8 * pi * x)),
            (1 / 16, 1 / 4, lambda x: cos(8 * pi / 3 * (x - 1 / 16))),
            (1 / 4, 0.5, lambda x: 0.0),
        ]
    ),
    "3-4-5": symmetric([(0, 0.5, lambda x: 60 * x - 180 * x**2 + 120 * x**3)]),
    "4-5-6-7": symmetric([(0, 0.5, lambda x: 420 * x**2 - 1680 * x**3 + 2100 * x**4 - 840 * x**5)]),
}


def greatest(pieces):
    def run(scale, observe):
        y = np.array([0.0, 0.0, 0.0, 0.0])  # f, f', x, x'
        most = 0.0
        for a, b, acceleration in pieces + [(1, END / T, lambda x: 0.0)]:

            def slope(t, y):
                tau = t / T
                pull = K * (H * y[0] - y[2]) / M
                return [y[1] / T, scale * acceleration(tau) / T, y[3], pull]

            found = solve_ivp(slope, (a * T, b * T), y, "DOP853", rtol=1e-12, atol=1e-15, dense_output=observe)
            if observe:
                times = np.linspace(a * T, b * T, 200001)
                states = found.sol(times)
                most = max(most, np.abs(K * (H * states[0] - states[2])).max())
            y = found.y[:, -1].copy()
            if b == 1:
                lift = y[0]
                y[:2] = [1.0, 0.0]
        return lift, most

    lift, _ = run(1.0, False)
    return run(1.0 / lift, True)[1]


def dragged(power):
    """Angle and speed after 4 s of a rotor of 0.2 kg m^2 out of rest, by 3 t^power - 0.05 v |v|."""

    def slope(t, y):
        return [y[1], (3 * t**power - 0.05 * y[1] * abs(y[1])) / 0.2]

    return list(solve_ivp(slope, (0, 4), [0, 0], "DOP853", rtol=1e-12, atol=1e-15).y[:, -1])


force = {name: greatest(pieces) for name, pieces in LAWS.items()}
drag = {str(power): dragged(power) for power in (1, 2, 3, 5)}
print(json.dumps({"end": END, "force": force, "drag": drag}, indent=1))
