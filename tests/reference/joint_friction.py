"""Figures of scenarios/joint_friction/press_runs_out: a crank press runs out by the friction of its joints.

Free bodies of crank, rod and slide; friction from the reactions by a fixed point. While the crank
turns one way, w = phi'^2/2 is a function of its angle, dw/dphi = phi'', with the directions of all
pairs known piece by piece: the slide turns round in the dead centres, the pin of the slide half way
between them. Runge and Kutta's method over the angle up to w = 0; there the weight of the rod must be
too small to turn the crank back. Needs nothing but Python. Writes joint_friction.json.
"""

import json
import math
import pathlib

R, L = 0.06, 0.24
FLYWHEEL, WEIGHT = 0.12, 40.0 * 9.81
ROD, CENTRE, ROD_MOMENT = 1.8, 0.09, 0.012
SLIDE = 6.0
PIN_O, PIN_A, PIN_B = 0.05, 0.04, 0.03
CORNERS, HALF_HEIGHT = (0.05, -0.06), 0.02
MU = 0.12
GRAVITY = 9.81
START, SPEED = 0.4, 12.0


def transfer(q):
    """First and second derivatives by q of the rod's angle, the slide, the rod's centre."""
    s, c = math.sin(q), math.cos(q)
    sb = -R * s / L
    cb = math.sqrt(1 - sb * sb)
    b1 = -R * c / (L * cb)
    b2 = (R * s / L + sb * b1 * b1) / cb
    x1, x2 = -R * s - L * sb * b1, -R * c - L * (cb * b1 * b1 + sb * b2)
    cx1, cx2 = -R * s - CENTRE * sb * b1, -R * c - CENTRE * (cb * b1 * b1 + sb * b2)
    cy1, cy2 = R * c + CENTRE * cb * b1, -R * s + CENTRE * (-sb * b1 * b1 + cb * b2)
    return (s, c, sb, cb), (b1, b2), (x1, x2), (cx1, cx2), (cy1, cy2)


def inertia(q):
    _, (b1, _), (x1, _), (cx1, _), (cy1, _) = transfer(q)
    return FLYWHEEL + ROD * (cx1**2 + cy1**2) + ROD_MOMENT * b1**2 + SLIDE * x1**2


def acceleration(q, w, slides, swings):
    """phi'' for w = phi'^2/2; `slides` and `swings` are the signs of x' and of the rod's b'."""
    (s, c, sb, cb), (b1, b2), (x1, x2), (cx1, cx2), (cy1, cy2) = transfer(q)
    v2 = 2 * w
    fall = ROD * GRAVITY
    mass = FLYWHEEL + ROD * (cx1**2 + cy1**2) + ROD_MOMENT * b1**2 + SLIDE * x1**2
    bias = ROD * (cx1 * cx2 + cy1 * cy2) + ROD_MOMENT * b1 * b2 + SLIDE * x1 * x2
    mo = ma = mb = t = 0.0
    before = math.inf
    for _ in range(200):
        a = (mo + ma * (b1 - 1) - mb * b1 + t * x1 - bias * v2 - fall * cy1) / mass
        ddx = x1 * a + x2 * v2
        rx, ry = ROD * (cx1 * a + cx2 * v2), ROD * (cy1 * a + cy2 * v2) + fall
        spin = ROD_MOMENT * (b1 * a + b2 * v2)
        xb = SLIDE * ddx - t
        xa = xb + rx
        # Moments on the rod about A: those of its inertia, of -B at its end, of both couples.
        # spin + centre x r = L*(cb*(-yb) - sb*(-xb)) + ma - mb
        about = spin + CENTRE * (cb * ry - sb * rx)
        yb = (ma - mb - about + L * sb * xb) / (L * cb)
        ya = yb + ry
        n = SLIDE * GRAVITY - yb
        guide = -slides * MU * HALF_HEIGHT * n
        moment = -mb - guide
        first = (moment - CORNERS[1] * n) / (CORNERS[0] - CORNERS[1])
        second = n - first
        mo = -MU * PIN_O / 2 * math.hypot(xa, ya + WEIGHT)
        ma = MU * PIN_A / 2 * math.hypot(xa, ya)
        mb = swings * MU * PIN_B / 2 * math.hypot(xb, yb)
        t = -slides * MU * (abs(first) + abs(second))
        if a == before:
            break
        before = a
    return a


def piece(q, end, w, steps):
    """From q to `end` within a quarter of a turn; the angle of the stop, if it is reached."""
    middle = 0.5 * (q + end)
    slides, swings = math.copysign(1, transfer(middle)[2][0]), math.copysign(1, transfer(middle)[1][0])
    f = lambda q, w: acceleration(q, w, slides, swings)

    def step(q, w, h):
        k1 = f(q, w)
        k2 = f(q + h / 2, w + h / 2 * k1)
        k3 = f(q + h / 2, w + h / 2 * k2)
        k4 = f(q + h, w + h * k3)
        return w + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)

    h = (end - q) / steps
    for i in range(steps):
        here = q + i * h
        next_w = step(here, w, h)
        if next_w <= 0:
            low, high = 0.0, h
            for _ in range(60):
                half = 0.5 * (low + high)
                low, high = (half, high) if step(here, w, half) > 0 else (low, half)
            return 0.0, here + high
        w = next_w
    return w, None


def run(steps):
    q, w = START, 0.5 * SPEED * SPEED
    while True:
        end = (math.floor(q / (math.pi / 2) + 1e-9) + 1) * math.pi / 2
        w, stop = piece(q, end, w, steps)
        if stop is not None:
            return stop
        q = end


if __name__ == "__main__":
    coarse, fine = run(100), run(200)
    weight = ROD * GRAVITY * R * (1 - CENTRE / L)
    assert weight < MU * PIN_O / 2 * WEIGHT, "the crank may not swing back"
    risen = weight * (math.sin(fine) - math.sin(START))
    figures = {
        "press.final.displacement": fine,
        "press.friction_loss": 0.5 * inertia(START) * SPEED * SPEED - risen,
        "two step widths differ by": abs(fine - coarse),
    }
    path = pathlib.Path(__file__).with_name("joint_friction.json")
    path.write_text(json.dumps({"press_runs_out": figures}, indent=2) + "\n")
    print(path.read_text())
