"""Closed reduction: all cranks turn alike, couplers move without turning."""
import math, os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from extrapolation import integrate

GRAVITY = 9.81


def motion(windows):
    inertia, moment = (windows + 1) / 3 + windows, (windows + 1) / 2 + windows
    slopes = lambda _, y: [y[1], moment / inertia * GRAVITY * math.sin(y[0])]
    return integrate(slopes, [0.0, 1.0], [0, 10], 1e-13)[-1]


for windows in (1, 2, 40):
    angle, speed = motion(windows)
    print(windows, "angle", repr(angle), "speed", repr(speed), "x of the first tip", repr(math.sin(angle)))
