"""The seven bodies in absolute coordinates with twenty multipliers."""
import math, os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from bodies import Bodies, couple, strut
from extrapolation import integrate

# Mass, moment, centre of mass in the frame of the link, start angle of the frame.
BETA, GAMMA, DELTA, EPSILON = (
    -0.0617138900142764496, 0.455279819163070380255912382449,
    0.487364979543842550225598953530, 1.23054744454982119249735015568,
)
PHI = 0.222668390165885884674473185609
LINKS = [
    (0.04325, 2.194e-6, (92e-5, 0), BETA),
    (0.00365, 4.410e-7, (-115e-4, 0), BETA),
    (0.02373, 5.255e-6, (1043e-5, -1874e-5), GAMMA),
    (0.00706, 5.667e-7, (0, 1421e-5 - 2e-2), DELTA + PHI),
    (0.07050, 1.169e-5, (2308e-5, 916e-5), DELTA),
    (0.00706, 5.667e-7, (2e-2 - 1421e-5, 0), EPSILON - PHI),
    (0.05498, 1.912e-5, (-449e-5, -1228e-5), EPSILON),
]
A, B, C = (-0.06934, -0.00227), (-0.03635, 0.03273), (0.014, 0.072)
D, E, RR, SS, SC, SD, U, ZF, ZT = 28e-3, 2e-2, 7e-3, 35e-3, 18e-3, 2e-2, 4e-2, 2e-2, 4e-2

bodies = Bodies()
for mass, moment, _, _ in LINKS:
    bodies.body(mass, moment)
own = lambda k, point: (point[0] - LINKS[k][2][0], point[1] - LINKS[k][2][1])


def turned(angle, point):
    c, s = math.cos(angle), math.sin(angle)
    return c * point[0] - s * point[1], s * point[0] + c * point[1]


# Origins of the frames at the start, out along the chain.
plus = lambda p, q: (p[0] + q[0], p[1] + q[1])
F = turned(BETA, (RR, 0))
origins = [
    (0, 0), F, B,
    plus(A, turned(DELTA, (ZT, 0))), A,
    plus(A, turned(EPSILON, (0, -U))), A,
]
state = []
for (_, _, centre, angle), origin in zip(LINKS, origins):
    state += [*plus(origin, turned(angle, centre)), angle]
for a, pa, b, pb in [
    (0, (0, 0), None, (0, 0)), (0, (RR, 0), 1, (0, 0)), (2, (0, 0), None, B), (2, (0, -SS), 1, (-D, 0)),
    (4, (0, 0), None, A), (4, (ZT, 0), 3, (0, 0)), (1, (-D, 0), 3, (0, -E)), (6, (0, 0), None, A),
    (6, (0, -U), 5, (0, 0)), (1, (-D, 0), 5, (ZF, 0)),
]:
    bodies.pin(a, own(a, pa), b, pb if b is None else own(b, pb))
bodies.forces += [strut(None, C, 2, own(2, (SD, -SC)), 4530, 7785e-5), couple(0, 0.033)]

if __name__ == "__main__":
    times = [0, 0.03]
    for t, y in zip(times, integrate(bodies.slopes, state + [0.0] * 21, times, 2e-12)):
        print(t, "beta", repr(y[2]), "theta", repr(y[5] - y[2]), "gamma", repr(y[8]))
        print("phi", repr(y[11] - y[14]), "delta", repr(y[14]), "epsilon", repr(y[20]))
