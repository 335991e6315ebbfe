"""Real and imaginary part of exp(i·angle), which needs no sine, with the spring's angle
counted on as a third coordinate."""
import os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from extrapolation import integrate

LENGTH, MASS, MOMENT, GRAVITY, RATE, DAMPING = 2.0, 1.0, 0.1, 9.80665, 200.0, 10.0


def slopes(_, y):
    cos, sin, angle, speed = y
    inertia = MOMENT + MASS * LENGTH**2
    torque = -MASS * GRAVITY * LENGTH * cos - RATE * angle - DAMPING * speed
    return [-sin * speed, cos * speed, speed, torque / inertia]


times = [0, 0.5, 1, 5]
for t, (cos, sin, *_) in zip(times, integrate(slopes, [1.0, 0.0, 0.0, 0.0], times)):
    print(t, "x", repr(LENGTH * cos), "z", repr(LENGTH * sin))
