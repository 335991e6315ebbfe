"""Crank, rod and piston in absolute coordinates with multipliers."""
import math, os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from bodies import Bodies
from extrapolation import integrate

RHO = 7700.0
web = RHO * 0.1 * 0.05 * 0.02
journal = RHO * math.pi / 4 * 0.05**2 * 0.1
pin = RHO * math.pi / 4 * 0.03**2 * 0.1
mass = journal + 2 * web + pin
centre = (2 * web * 0.05 + pin * 0.1) / mass
about_axis = (
    journal * 0.025**2 / 2
    + 2 * (web * (0.1**2 + 0.05**2) / 12 + web * 0.05**2)
    + pin * (0.015**2 / 2 + 0.1**2)
)
rod = RHO * 0.2 * 0.06 * 0.02
rod_moment = rod * (0.2**2 + 0.06**2) / 12
piston = RHO * math.pi / 4 * 0.1**2 * 0.1
if __name__ == "__main__":
    print("crank", repr(mass), repr(centre), repr(about_axis - mass * centre**2))
    print("rod", repr(rod), repr(rod_moment), "piston", repr(piston))
    bodies = Bodies((0.0, -9.80665))
    # The inertia of 1 kg m² on the crank's shaft turns with it.
    crank = bodies.body(mass, 1.0 + about_axis - mass * centre**2)
    bar = bodies.body(rod, rod_moment)
    slide = bodies.body(piston, 1.0)
    bodies.pin(crank, (-centre, 0), None, (0, 0))
    bodies.pin(bar, (-0.1, 0), crank, (0.1 - centre, 0))
    bodies.pin(slide, (0, 0), bar, (0.1, 0))
    bodies.guide(slide, (1, 0))
    up, w = math.pi / 2, 10.0
    # At the top the rod turns by -w/2.
    places = [0, centre, up, 0, 0.2, up, 0, 0.3, 0]
    speeds = [-w * centre, 0, w, -w * 0.1 / 2, 0, -w / 2, 0, 0, 0]
    times = [0, 1, 2, 5]
    for t, y in zip(times, integrate(bodies.slopes, places + speeds, times, 2e-12)):
        print(t, "angle", repr(y[2] - up), "speed", repr(y[11]))
