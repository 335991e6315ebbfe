"""Crank, rod and slide in absolute coordinates with multipliers."""
import math, os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from bodies import Bodies, strut
from extrapolation import integrate

# What has no mass of its own gets none that tells: its centre is the pin or the slide, where
# its mass would be at rest or add to the slide's.
bodies = Bodies()
crank = bodies.body(1.0, 1.0)
slide = bodies.body(0.5, 1.0)
rod = bodies.body(0.5, 2.0)
bodies.pin(crank, (0, 0), None, (0, 0))
bodies.pin(rod, (-1.0, 0), crank, (0.5, 0))
bodies.pin(rod, (0, 0), slide, (0, 0))
bodies.guide(slide, (0, 1))
bodies.forces.append(strut(crank, (0.25, 0), rod, (-0.5, 0), 1.0, 1.0, 1.0))
bodies.forces.append(lambda _, __, ___, push, ____: push(rod, (1.0, 0), 1.0, 0.0))
x, p = math.sqrt(0.75), math.asin(-0.5)
start = [0, 0, math.pi / 2, x, 0, 0, x, 0, p] + [0.0] * 9
times = [0, 2.5, 5, 10]
for t, y in zip(times, integrate(bodies.slopes, start, times, 1e-14)):
    print(t, "q", repr(y[2]), "x", repr(y[3]), "p", repr(y[8]))
