"""Forces expected by scenarios/kinetostatics: free-body equations of every link, solved densely.

Positions are closed forms whose derivatives are carried along (value, first, second); reactions, two normal forces
a guide and the driving moment are the unknowns; friction is iterated to 1e-14. Extremes are looked for on a fine grid
and refined by golden section, ends of self-locking by bisection, work over the turn by Gauss's rule between the places, found
by bisection, at which a pair turns round or a block leans over.
Needs nothing but Python. Prints address and value.
"""

from math import atan2, copysign, cos, hypot, pi, sin, sqrt

GRID = 7200


class Jet:
    """A function of the crank's angle with two derivatives."""

    def __init__(self, v, d=0.0, dd=0.0):
        self.v, self.d, self.dd = v, d, dd

    def __add__(self, o):
        o = o if isinstance(o, Jet) else Jet(o)
        return Jet(self.v + o.v, self.d + o.d, self.dd + o.dd)

    def __mul__(self, o):
        o = o if isinstance(o, Jet) else Jet(o)
        return Jet(self.v * o.v, self.d * o.v + self.v * o.d, self.dd * o.v + 2 * self.d * o.d + self.v * o.dd)

    __radd__, __rmul__ = __add__, __mul__

    def __sub__(self, o):
        return self + o * -1.0 if isinstance(o, Jet) else self + -o

    def of(self, f, f1, f2):
        return Jet(f, f1 * self.d, f2 * self.d**2 + f1 * self.dd)


def sine(x):
    return x.of(sin(x.v), cos(x.v), -sin(x.v))


def cosine(x):
    return x.of(cos(x.v), -sin(x.v), -cos(x.v))


def root(x):
    r = sqrt(x.v)
    return x.of(r, 0.5 / r, -0.25 / r**3)


def direction(y, x):
    """Angle of (x, y): its derivative is (x y' - y x')/(x² + y²)."""
    r2 = x.v**2 + y.v**2
    first = (x.v * y.d - y.v * x.d) / r2
    second = (x.v * y.dd - y.v * x.dd) / r2 - first * 2 * (x.v * x.d + y.v * y.d) / r2
    return Jet(atan2(y.v, x.v), first, second)


class Machine:
    """Links with mass, centre and moment; pins (i, j, place, diameter); guides (i, j, ...); ground is link -1."""

    def solve(self, phi, speed):
        frames = self.frames(Jet(phi, 1.0))
        rows = 3 * len(self.links)
        point = lambda link, at: frame_point(frames[link], at) if link >= 0 else [Jet(at[0]), Jet(at[1])]
        centres = [point(k, link[1]) for k, link in enumerate(self.links)]
        right = [0.0] * rows
        moved = 0.0  # power of applied forces less that of inertia
        for k, (mass, _, moment) in enumerate(self.links):
            forces = [mass * (c.dd * speed**2 + g) for c, g in zip(centres[k], (0.0, self.gravity))]
            couple = moment * frames[k][2].dd * speed**2
            for a in range(2):
                right[3 * k + a] += forces[a]
                moved -= forces[a] * centres[k][a].d * speed
            right[3 * k + 2] += couple
            moved -= couple * frames[k][2].d * speed
        load = 0.0
        for k, at, force, couple in self.loads:
            p = point(k, at)
            right[3 * k] -= force[0]
            right[3 * k + 1] -= force[1]
            right[3 * k + 2] -= couple + arm(p, centres[k], force)
            load += (force[0] * p[0].d + force[1] * p[1].d + couple * frames[k][2].d) * speed
        columns, terms = [], []
        for name, i, j, at, diameter, mu in self.pins:
            p = point(j, at)
            for unit in ((1.0, 0.0), (0.0, 1.0)):
                columns.append(effect(rows, i, j, p, centres, unit))
            rate = (frames[j][2].d - (frames[i][2].d if i >= 0 else 0.0)) * speed
            couple = [0.0] * rows
            couple[3 * j + 2] = 1.0
            if i >= 0:
                couple[3 * i + 2] = -1.0
            terms.append((name, "pin", len(columns) - 2, mu * diameter / 2, rate, couple))
        for name, i, j, psi, along, corners, half, mu in self.guides(frames):
            t, n = (cos(psi), sin(psi)), (-sin(psi), cos(psi))
            o = point(j, (0.0, 0.0))
            for b in corners:
                foot = [Jet(o[a].v + b * t[a]) for a in range(2)]
                columns.append(effect(rows, i, j, foot, centres, n))
                # The face on which a positive or a negative force presses.
                rubs = {}
                for sign in (1.0, -1.0):
                    face = [Jet(foot[a].v - sign * half * n[a]) for a in range(2)]
                    rubs[sign] = effect(rows, i, j, face, centres, t)
                terms.append((name, "corner", len(columns) - 1, mu, along.d * speed, rubs))
        drive = [0.0] * rows
        drive[2] = 1.0
        columns.append(drive)
        x, before = gauss(columns, right), None
        for _ in range(400):
            loss, losses, total = 0.0, {}, list(right)
            for name, kind, first, mu, rate, how in terms:
                if kind == "pin":
                    size, column = mu * hypot(x[first], x[first + 1]), how
                else:
                    size, column = mu * abs(x[first]), how[copysign(1.0, x[first])]
                losses[name] = losses.get(name, 0.0) + size * abs(rate)
                loss += size * abs(rate)
                for row in range(rows):
                    total[row] += copysign(size, rate) * column[row]
            if before is not None and max(abs(a - b) for a, b in zip(x, before)) <= 1e-14 * max(map(abs, x)):
                break
            before, x = x, gauss(columns, total)
        assert abs(x[-1] * speed + load + moved - loss) < 1e-9 * (abs(load) + loss + 1.0)
        shaking = [-sum(l[0] * c[a].dd for l, c in zip(self.links, centres)) * speed**2 for a in range(2)]
        return {"x": x, "drive": x[-1], "load": load, "loss": loss, "losses": losses, "terms": terms, "shaking": shaking}


def frame_point(frame, at):
    x, y, turn = frame
    c, s = cosine(turn), sine(turn)
    return [x + at[0] * c - at[1] * s, y + at[0] * s + at[1] * c]


def arm(p, centre, force):
    return (p[0].v - centre[0].v) * force[1] - (p[1].v - centre[1].v) * force[0]


def effect(rows, i, j, p, centres, unit):
    """What a unit force on j from i does to the equations."""
    column = [0.0] * rows
    for link, sign in ((j, 1.0), (i, -1.0)):
        if link >= 0:
            column[3 * link] += sign * unit[0]
            column[3 * link + 1] += sign * unit[1]
            column[3 * link + 2] += sign * arm(p, centres[link], unit)
    return column


def gauss(columns, right):
    n = len(right)
    m = [[columns[c][r] for c in range(n)] + [right[r]] for r in range(n)]
    for k in range(n):
        p = max(range(k, n), key=lambda r: abs(m[r][k]))
        m[k], m[p] = m[p], m[k]
        for r in range(k + 1, n):
            f = m[r][k] / m[k][k]
            if f:
                for c in range(k, n + 1):
                    m[r][c] -= f * m[k][c]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (m[k][n] - sum(m[k][c] * x[c] for c in range(k + 1, n))) / m[k][k]
    return x


class SliderCrank(Machine):
    """Crank 60 mm, rod 300 mm, slide along x, 1 kN against x; scenarios/kinetostatics/slider_crank."""

    speed, gravity = 10.0, 0.0
    links = [(0.0, (0.0, 0.0), 0.0), (1.0, (0.15, 0.0), 0.0075), (0.0, (0.0, 0.0), 0.0)]
    loads = [(2, (0.0, 0.0), (-1000.0, 0.0), 0.0)]
    pins = [("R01", -1, 0, (0, 0), 0.04, 0.1), ("R12", 0, 1, (0, 0), 0.03, 0.1), ("R23", 1, 2, (0, 0), 0.03, 0.1)]

    def frames(self, phi):
        ax, ay = 0.06 * cosine(phi), 0.06 * sine(phi)
        sx = ax + root((ay * ay) * -1.0 + 0.09)
        return [(Jet(0.0), Jet(0.0), phi), (ax, ay, direction(ay * -1.0, sx - ax)), (sx, Jet(0.0), Jet(0.0))]

    def guides(self, frames):
        return [("P03", -1, 2, 0.0, frames[2][0], (0.02, -0.03), 0.04, 0.1)]


class SlottedLever(Machine):
    """Crank 100 mm about (0, 300 mm), lever about 0; scenarios/kinetostatics/slotted_lever."""

    speed, gravity = 12.0, 9.81
    links = [(0.6, (0.04, 0.0), 0.0007), (0.35, (0.0, 0.0), 0.0002), (2.4, (0.22, 0.0), 0.05)]
    loads = [(2, (0.0, 0.0), (0.0, 0.0), -80.0)]
    pins = [("R01", -1, 0, (0, 0), 0.03, 0.1), ("R12", 0, 1, (0, 0), 0.025, 0.1), ("R03", -1, 2, (0, 0), 0.04, 0.1)]

    def frames(self, phi):
        ax, ay = 0.1 * cosine(phi), 0.1 * sine(phi) + 0.3
        turn = direction(ay, ax)
        self.along = root(ax * ax + ay * ay)
        return [(Jet(0.0), Jet(0.3), phi), (ax, ay, turn), (Jet(0.0), Jet(0.0), turn)]

    def guides(self, frames):
        return [("P32", 2, 1, frames[2][2].v, self.along, (0.03, -0.03), 0.015, 0.1)]


def greatest(f):
    places = [2 * pi * (k + 0.5) / GRID for k in range(GRID)]
    near = max(places, key=f)
    low, high = near - 2 * pi / GRID, near + 2 * pi / GRID
    keep = (sqrt(5) - 1) / 2
    for _ in range(40):
        a, b = high - keep * (high - low), low + keep * (high - low)
        low, high = (low, b) if f(a) >= f(b) else (a, high)
    # Where it jumps, the value of the better side.
    return max(f(low), f(high))


FIVE = [(0.0, 0.5688888888888889), (0.5384693101056831, 0.4786286704993665), (0.9061798459386640, 0.2369268850561891)]


def pieces(at, cells=720):
    """Cells of a turn, cut where the directions of friction change."""

    def pattern(q):
        s = at(q)
        return [(t[4] > 0, t[1] == "corner" and s["x"][t[2]] > 0) for t in s["terms"]]

    ends, last = [1e-7], pattern(1e-7)
    for k in range(1, cells + 1):
        to = 2 * pi * k / cells + 1e-7
        while pattern(to) != last:
            low, high = ends[-1], to
            for _ in range(50):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if pattern(middle) == last else (low, middle)
            ends.append(low)
            ends.append(high)
            last = pattern(high)
        ends.append(to)
    return list(zip(ends, ends[1:]))


def mean_of(at, f):
    total = 0.0
    for low, high in pieces(at):
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        for place, weight in FIVE:
            for side in (1.0,) if place == 0.0 else (-1.0, 1.0):
                total += half * weight * f(at(middle + side * place * half))
    return total / (2 * pi)


def edge(f, low, high):
    """Where a sign changes."""
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if (f(middle) > 0) == (f(low) > 0) else (low, middle)
    return 0.5 * (low + high)


def tell(scene, machine):
    cache = {}

    def at(phi):
        if phi not in cache:
            cache[phi] = machine.solve(phi, machine.speed)
        return cache[phi]

    def figure(name, value):
        print(f"{scene}: forces.mechanism.{name} = {value:.14g}")

    size = lambda k: lambda q: hypot(at(q)["x"][k], at(q)["x"][k + 1])
    figure("drive.greatest", greatest(lambda q: at(q)["drive"]))
    figure("drive.least", -greatest(lambda q: -at(q)["drive"]))
    for name, kind, first, *_ in machine.solve(1.0, machine.speed)["terms"]:
        if kind == "pin":
            figure(f"{name}.force.greatest", greatest(size(first)))
        else:
            corner = f"{name}.n{first - 5}"
            figure(f"{corner}.greatest", greatest(lambda q: at(q)["x"][first]))
            figure(f"{corner}.least", -greatest(lambda q: -at(q)["x"][first]))
    figure("power.loss.greatest", greatest(lambda q: at(q)["loss"]))
    figure("shaking.force.greatest", greatest(lambda q: hypot(*at(q)["shaking"])))
    places = [2 * pi * k / GRID for k in range(GRID)]
    time = 2 * pi / machine.speed
    mean = lambda f: mean_of(at, f)
    figure("cycle.drive_work", time * machine.speed * mean(lambda s: s["drive"]))
    figure("cycle.loss", time * mean(lambda s: s["loss"]))
    for name in at(1.0)["losses"]:
        figure(f"cycle.losses.{name}", time * mean(lambda s: s["losses"][name]))
    figure("cycle.rms_drive", sqrt(mean(lambda s: s["drive"] ** 2)))
    # Power of the load less the loss, where the load drives.
    locks = lambda q: at(q)["load"] - at(q)["loss"]
    signs = [(q, locks(q) > 0) for q in places]
    for (a, one), (b, other) in zip(signs, signs[1:]):
        if one != other:
            figure("a zone ends or begins at", edge(locks, a, b))


if __name__ == "__main__":
    tell("slider_crank", SliderCrank())
    tell("slotted_lever", SlottedLever())
