"""Frame, crank, rod and slide in absolute coordinates with multipliers."""
import os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from bodies import Bodies, couple
from extrapolation import integrate

bodies = Bodies()
frame = bodies.body(2.0, 1.0)
crank = bodies.body(0.2, 0.2 / 12 * 0.1**2)
rod = bodies.body(0.2, 0.2 / 12 * 0.3**2)
slide = bodies.body(0.4, 0.001 * 0.4)
bodies.pin(crank, (-0.05, 0), frame, (0, 0))
bodies.pin(rod, (-0.15, 0), crank, (0.05, 0))
bodies.pin(slide, (0, 0), rod, (0.15, 0))
bodies.rail(slide, frame)


def springs(_, __, y, ___, force):
    for k in range(3):
        force[k] -= 5000.0 * y[k] + 50.0 * y[12 + k]


bodies.forces += [springs, couple(crank, 0.1)]
start = [0, 0, 0, 0.05, 0, 0, 0.25, 0, 0, 0.4, 0, 0] + [0.0] * 12
times = [0, 0.1, 0.2, 0.3]
for t, y in zip(times, integrate(bodies.slopes, start, times, 1e-13)):
    print(t, "x", repr(y[9]), "y", repr(y[10]), "frame", repr(y[0]), repr(y[1]), repr(y[2]), "crank", repr(y[5]))
