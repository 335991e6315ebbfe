"""Gear and load as coordinates of their own, extrapolated."""
import math, os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from extrapolation import integrate


def slopes(t, y):
    gear, load, vg, vl = y
    moment = 1e4 * (gear - load)
    # The motor's inertia and torque on the gear's side.
    torque = 10 * 10 * math.sin(2 * math.pi * 5 * t)
    return [vg, vl, (torque - 10 * vg - moment) / (2 + 0.1 * 100), moment / 2]


times = [0, 0.5, 1]
for t, y in zip(times, integrate(slopes, [0.0] * 4, times)):
    print(t, "gear", repr(y[0]), repr(y[2]), "load", repr(y[1]), repr(y[3]))
