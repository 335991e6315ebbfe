"""Crank and rod angle and the slide's place as three coordinates with two multipliers."""
import math, os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from extrapolation import integrate, solved

CRANK, ROD, M1, M2, M3, TORQUE = 0.1, 0.3, 0.2, 0.2, 0.4, 0.1


def slopes(_, y):
    a, b, x, va, vb, vx = y
    j1, j2 = M1 * CRANK**2 / 12, M2 * ROD**2 / 12
    # Rod's centre: crank·e(a) + rod/2·e(b).
    half = ROD / 2
    cross = M2 * CRANK * half * math.cos(a - b)
    swirl = M2 * CRANK * half * math.sin(a - b)
    mass = [[j1 + M1 * CRANK**2 / 4 + M2 * CRANK**2, cross, 0], [cross, j2 + M2 * half**2, 0], [0, 0, M3]]
    force = [TORQUE - swirl * vb**2, swirl * va**2, 0]
    # crank·cos a + rod·cos b - x = 0, crank·sin a + rod·sin b = 0.
    g = [
        [-CRANK * math.sin(a), -ROD * math.sin(b), -1],
        [CRANK * math.cos(a), ROD * math.cos(b), 0],
    ]
    right = [
        CRANK * math.cos(a) * va**2 + ROD * math.cos(b) * vb**2,
        CRANK * math.sin(a) * va**2 + ROD * math.sin(b) * vb**2,
    ]
    matrix = [mass[i] + [g[0][i], g[1][i]] for i in range(3)] + [g[k] + [0, 0] for k in range(2)]
    found = solved(matrix, force + right)
    return [va, vb, vx] + found[:3]


times = [0, 0.1, 0.2, 0.3]
for t, y in zip(times, integrate(slopes, [0, 0, CRANK + ROD, 0, 0, 0], times)):
    print(t, "x", repr(y[2]), "crank", repr(y[0]), repr(y[3]))
