"""Angles of the three moving links as coordinates, two multipliers for the loop."""
import math, os, sys
sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from extrapolation import integrate, solved

GRAVITY, DAMPING = 9.80665, 0.1
# Place of the first point, centre, mass, moment about the centre; frames parallel at the start.
BODIES = {
    1: ((0.4, 0.0), (0.2, 0.0), 7.7, 0.10427083333333337),
    2: ((0.1, 1.1), (0.05, 0.55), 21.26231995808548, 2.1660988457299584),
    4: ((0.65, 0.1), (0.325, 0.05), 12.659710946542187, 0.4589145218121544),
}


def turned(v, angle):
    c, s = math.cos(angle), math.sin(angle)
    return (c * v[0] - s * v[1], s * v[0] + c * v[1])


def slopes(_, y):
    p, q, r, vp, vq, vr = y
    (a, c1, m1, j1), (b, c2, m2, j2), (d, c4, m4, j4) = (BODIES[k] for k in (1, 2, 4))
    a, b, d = turned(a, p), turned(b, q), turned(d, r)
    c1, c2, c4 = turned(c1, p), turned(c2, q), turned(c4, r)
    dot = lambda u, v: u[0] * v[0] + u[1] * v[1]
    cross = lambda u, v: u[0] * v[1] - u[1] * v[0]
    # Centre of body 2: a + c2.
    mass = [
        [j1 + m1 * dot(c1, c1) + m2 * dot(a, a), m2 * dot(a, c2), 0],
        [m2 * dot(a, c2), j2 + m2 * dot(c2, c2), 0],
        [0, 0, j4 + m4 * dot(c4, c4)],
    ]
    swirl = m2 * cross(a, c2)
    force = [
        swirl * vq**2 - GRAVITY * (m1 * c1[0] + m2 * a[0]) - DAMPING * vp,
        -swirl * vp**2 - GRAVITY * m2 * c2[0],
        -GRAVITY * m4 * c4[0],
    ]
    # a + b = ground + d; the derivative of u by its angle is (-u_y, u_x).
    g = [[-a[1], -b[1], d[1]], [a[0], b[0], -d[0]]]
    right = [sum(v * v * s * u[k] for u, v, s in ((a, vp, 1), (b, vq, 1), (d, vr, -1))) for k in (0, 1)]
    matrix = [mass[i] + [g[0][i], g[1][i]] for i in range(3)] + [g[k] + [0, 0] for k in range(2)]
    return [vp, vq, vr] + solved(matrix, force + right)[:3]


times = [0, 1, 2, 3, 4, 5]
for t, y in zip(times, integrate(slopes, [0.0] * 6, times, 3e-14)):
    print(t, "phi", repr(y[0]), "w", repr(y[3]))
