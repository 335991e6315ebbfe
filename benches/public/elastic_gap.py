"""A body between two elastic and damped stops at -gap and gap, which push only:
closed forms of the linear pieces between two switches, which are found by bisection: free;
in contact with its damper; with the damper cut off at the spring's force, where nothing is left of
both (leaving) or twice the spring (entering)."""
from math import cos, cosh, exp, sin, sinh, sqrt


class Body:
    def __init__(self, inertia, rate, damping, gap, start):
        self.inertia, self.rate, self.damping, self.gap, self.start = inertia, rate, damping, gap, start

    def force(self, side, x, v):
        """Regime: (rate, damping) of what acts on x - side*self.gap; side 0: free."""
        if side == 0:
            return 0.0, 0.0
        depth = side * x - self.gap
        spring, damper = self.rate * depth, self.damping * side * v
        if damper < -spring:
            return 0.0, 0.0
        if damper > spring:
            return 2 * self.rate, 0.0
        return self.rate, self.damping

    def moved(self, x, v, place, rate, damping, t):
        """x'' = -(rate (x - place) + damping v)/self.inertia in closed form."""
        a, w2, y = damping / (2 * self.inertia), rate / self.inertia, x - place
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

    def run(self, end, steps=2000):
        def where(x, v):
            side = 1 if x > self.gap else -1 if x < -self.gap else 0
            return (side,) + self.force(side, x, v)

        t, x, v = 0.0, self.start, 0.0
        regime = where(x - 1e-12, v)
        step = end / steps
        while t < end - 1e-15:
            side, rate, damping = regime
            h = min(step, end - t)
            at = lambda s: self.moved(x, v, side * self.gap, rate, damping, s)
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
