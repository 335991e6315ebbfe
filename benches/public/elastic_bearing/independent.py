"""Shaft, housing and load as coordinates of their own: a linear system, extrapolated."""
import os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from extrapolation import integrate, solved

# The gear's output has no inertia: φ = shaft/3 + 2·housing/3.
MASS = [[1.0, 0, 0], [0, 5.0, 0], [0, 0, 50.0]]


def slopes(t, y):
    s, h, l, vs, vh, vl = y
    moment = 1000.0 * (s / 3 + 2 * h / 3 - l)
    torque = 100.0 * min(t / 5, 1.0)
    force = [torque - moment / 3, -2 * moment / 3 - 1e5 * h - 5.0 * vh, moment]
    return [vs, vh, vl] + solved(MASS, force)


y = [0.0] * 6
for t, y in zip([0, 5, 7], integrate(slopes, y, [0, 5, 7], 2e-12)):
    print(t, "shaft", repr(y[0]), "housing", repr(y[1]), "load", repr(y[2]), repr(y[5]))
