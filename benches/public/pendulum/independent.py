"""Position of the mass centre in Cartesian coordinates, with a multiplier for the rod."""
import os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from extrapolation import integrate

LENGTH, MASS, MOMENT, GRAVITY = 2.0, 1.0, 0.1, 9.80665


def slopes(_, y):
    # x, z, u, w: the rod turns with the centre, its moment is an inertia m' = J/l² along the path.
    x, z, u, w = y
    mass = MASS + MOMENT / LENGTH**2
    # m'·a = (0, -m·g) + l·(x, z), x·ax + z·az = -(u² + w²).
    square = x * x + z * z
    force = (-mass * (u * u + w * w) + z * MASS * GRAVITY) / square
    return [u, w, force * x / mass, (force * z - MASS * GRAVITY) / mass]


times = [0, 1, 2.5, 5]
for t, (x, z, *_) in zip(times, integrate(slopes, [LENGTH, 0.0, 0.0, 0.0], times)):
    print(t, "x", repr(x), "z", repr(z))
