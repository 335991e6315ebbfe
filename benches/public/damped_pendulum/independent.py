"""Horizontal and vertical place of the mass centre as cosine and sine, the angle counted on."""
import os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from extrapolation import integrate

ARM, MASS, MOMENT, GRAVITY, DAMPING = 0.5, 1.0, 0.001, 9.80665, 0.1


def slopes(_, y):
    cos, sin, _, speed = y
    torque = -MASS * GRAVITY * ARM * cos - DAMPING * speed
    return [-sin * speed, cos * speed, speed, torque / (MOMENT + MASS * ARM**2)]


times = [0, 0.5, 0.8]
for t, y in zip(times, integrate(slopes, [1.0, 0.0, 0.0, 0.0], times)):
    print(t, *(repr(value) for value in y[2:]))
