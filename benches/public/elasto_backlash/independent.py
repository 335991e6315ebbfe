"""Closed forms of the linear pieces between two switches, which are found by bisection: free;
in contact with its damper; with the damper cut off at the spring's force, where nothing is left of
both (leaving) or twice the spring (entering)."""
from math import cos, cosh, exp, pi, sin, sinh, sqrt

INERTIA, RATE, DAMPING, GAP, START, END = 5.0, 20e3, 50.0, pi / 8, pi / 2, 1.0


def force(side, x, v):
    """Regime: (rate, damping) of what acts on x - side*GAP; side 0: free."""
    if side == 0:
        return 0.0, 0.0
    depth = side * x - GAP
    spring, damper = RATE * depth, DAMPING * side * v
    if damper < -spring:
        return 0.0, 0.0
    if damper > spring:
        return 2 * RATE, 0.0
    return RATE, DAMPING


def moved(x, v, place, rate, damping, t):
    """x'' = -(rate (x - place) + damping v)/INERTIA in closed form."""
    a, w2, y = damping / (2 * INERTIA), rate / INERTIA, x - place
    if rate == 0.0:
        return x + v * t, v
    d = w2 - a * a
    if d > 0:
        w = sqrt(d)
        c, s = cos(w * t), sin(w * t) / w
    else:
        w = sqrt(-d)
        c, s = cosh(w * t), sinh(w * t) / w
    e = exp(-a * t)
    return place + e * (y * (c + a * s) + v * s), e * (v * (c - a * s) - w2 * y * s)


def run(end, steps=2000):
    def where(x, v):
        side = 1 if x > GAP else -1 if x < -GAP else 0
        return (side,) + force(side, x, v)

    t, x, v = 0.0, START, 0.0
    regime = where(x - 1e-12, v)
    step = END / steps
    while t < end - 1e-15:
        side, rate, damping = regime
        h = min(step, end - t)
        at = lambda s: moved(x, v, side * GAP, rate, damping, s)
        if where(*at(h)) != regime and h > 1e-15:
            low, high = 0.0, h
            for _ in range(80):
                middle = 0.5 * (low + high)
                if where(*at(middle)) == regime:
                    low = middle
                else:
                    high = middle
            h = high
        x, v = at(h)
        t += h
        regime = where(x, v)
    return x, v


if __name__ == "__main__":
    for count in (1000, 2000):
        for end in (1.0,):
            print(count, end, *(repr(value) for value in run(end, count)))
