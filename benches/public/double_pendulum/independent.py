"""Two rods in absolute coordinates with multipliers."""
import os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from bodies import Bodies, couple
from extrapolation import integrate

MASS = 7700 * 0.5 * 0.06 * 0.06
MOMENT = MASS * (0.5**2 + 0.06**2) / 12
bodies = Bodies((0.0, -9.80665))
first, second = bodies.body(MASS, MOMENT), bodies.body(MASS, MOMENT)
bodies.pin(first, (-0.25, 0), None, (0, 0))
bodies.pin(second, (-0.25, 0), first, (0.25, 0))
bodies.forces.append(couple(first, lambda t, angle, speed: -0.1 * speed))
times = [0, 1, 3]
for t, y in zip(times, integrate(bodies.slopes, [0.25, 0, 0, 0.75, 0, 0] + [0.0] * 6, times, 1e-13)):
    print(t, "first", repr(y[2]), repr(y[8]), "second less first", repr(y[5] - y[2]), repr(y[11] - y[8]))
