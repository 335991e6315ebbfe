"""Reference figures of scenarios/steady: machines with one degree of freedom.

Written from Newton and the energy theorem alone, in plain Python: Gauss-Legendre
quadrature (20 points) on 400 panels between the breaks, roots by bisection, the
motor's cycle by Runge-Kutta of order 4 with Richardson extrapolation.
Every figure is computed twice, the second time on twice as many panels (steps);
the difference is its spread.
"""

import json
import math
import os

TAU = 2 * math.pi


def legendre(n):
    """Places and weights of Gauss's rule by Newton's method."""
    rule = []
    for i in range(n):
        x = math.cos(math.pi * (i + 0.75) / (n + 0.5))
        for _ in range(100):
            p0, p1 = 1.0, x
            for k in range(2, n + 1):
                p0, p1 = p1, ((2 * k - 1) * x * p1 - (k - 1) * p0) / k
            slope = n * (x * p1 - p0) / (x * x - 1)
            x, before = x - p1 / slope, x
            if abs(x - before) < 1e-16:
                break
        rule.append((x, 2 / ((1 - x * x) * slope * slope)))
    return rule


RULE = sorted(legendre(20))


def crank(radius, rod, mass, inertia):
    """J(phi), x'(phi) and J'(phi) of a slider-crank, x from the crank's axis."""

    def at(phi):
        sin, cos = math.sin(phi), math.cos(phi)
        root = math.sqrt(rod**2 - (radius * sin) ** 2)
        first = -radius * sin - radius**2 * sin * cos / root
        second = -radius * cos - radius**2 * (cos**2 - sin**2) / root - radius**4 * sin**2 * cos**2 / root**3
        return inertia + mass * first**2, first, 2 * mass * first * second

    return at


class Cycle:
    """J and the work of a cycle on panels between breaks; forces of the position."""

    def __init__(self, machine, moment, breaks, panels):
        ends = [0.0] + breaks + [TAU]
        self.places, work = [], 0.0
        self.edges = [(0.0, 0.0)]
        for low, high in zip(ends, ends[1:]):
            count = max(2, math.ceil(panels * (high - low) / TAU))
            for i in range(count):
                a, b = low + (high - low) * i / count, low + (high - low) * (i + 1) / count
                for x, weight in RULE:
                    phi = (a + b + (b - a) * x) / 2
                    # Work from the panel's start by a rule of its own.
                    inner = sum(w * moment((a + phi + (phi - a) * y) / 2) for y, w in RULE) * (phi - a) / 2
                    self.places.append((phi, weight * (b - a) / 2, machine(phi)[0], work + inner))
                work += sum(w * moment((a + b + (b - a) * y) / 2) for y, w in RULE) * (b - a) / 2
                self.edges.append((b, work))
        self.surplus, self.machine, self.moment = work, machine, moment

    def work(self, phi):
        """Work from phi = 0."""
        a, done = max(edge for edge in self.edges if edge[0] <= phi)
        return done + sum(w * self.moment((a + phi + (phi - a) * y) / 2) for y, w in RULE) * (phi - a) / 2

    def period(self, energy, added):
        return sum(w * math.sqrt((j + added) / (2 * (energy + work))) for _, w, j, work in self.places)

    def energy(self, mean, added):
        """T(0) whose mean over time is given."""
        least = -min(work for _, _, _, work in self.places)
        low, high = least * (1 + 1e-12) + 1e-9, 1e9
        for _ in range(200):
            middle = (low + high) / 2
            low, high = (middle, high) if TAU / self.period(middle, added) < mean else (low, middle)
        return (low + high) / 2

    def extremes(self, energy, added):
        """Least and greatest speed: samples, then golden section around the best."""

        def speed(phi):
            return math.sqrt(2 * (energy + self.work(phi)) / (self.machine(phi)[0] + added))

        found = []
        for sense in (-1, 1):
            square = lambda p: sense * (energy + p[3]) / (p[2] + added)
            best = max(range(len(self.places)), key=lambda i: square(self.places[i]))
            low = self.places[max(best - 1, 0)][0]
            high = self.places[min(best + 1, len(self.places) - 1)][0]
            golden = (math.sqrt(5) - 1) / 2
            for _ in range(90):
                one, two = high - golden * (high - low), low + golden * (high - low)
                low, high = (low, two) if sense * speed(one) > sense * speed(two) else (one, high)
            found.append(speed((low + high) / 2))
        return found


def figures(cycle, mean, added, balance):
    energy = cycle.energy(mean, added)
    least, greatest = cycle.extremes(energy, added)
    period = cycle.period(energy, added)
    angle = sum(w * math.sqrt(2 * (energy + a) / (j + added)) for _, w, j, a in cycle.places) / TAU
    return {
        "steady.period": period,
        "steady.mean_time": TAU / period,
        "steady.mean_angle": angle,
        "steady.least_speed": least,
        "steady.greatest_speed": greatest,
        "steady.fluctuation": (greatest - least) / mean,
        "steady.energy_at_start": energy,
        **({} if balance is None else {"steady.balance": balance}),
    }


def punch(machine, force, contact, driving):
    return lambda phi: driving - (force * machine(phi)[1] if phi > contact else 0.0)


PRESS = dict(radius=0.08, rod=0.4, mass=220.0, inertia=1.5)
FORCE, CONTACT = 90e3, math.radians(322.0)


def press_flywheel(panels):
    """The press at 32 rad/s with the flywheel for a fluctuation of 0.1."""
    machine = crank(**PRESS)
    bare = Cycle(machine, punch(machine, FORCE, CONTACT, 0.0), [CONTACT], panels)
    driving = -bare.surplus / TAU
    cycle = Cycle(machine, punch(machine, FORCE, CONTACT, driving), [CONTACT], panels)
    low, high = 0.0, 100.0
    for _ in range(60):
        added = (low + high) / 2
        least, greatest = cycle.extremes(cycle.energy(32.0, added), added)
        low, high = (added, high) if (greatest - least) / 32.0 > 0.1 else (low, added)
    return {**figures(cycle, 32.0, added, driving), "steady.flywheel": added, "steady.cycle_work": bare.surplus}


def press_motor(steps):
    """The press with a motor M = 800 (1 - w/w0), w0 = 160/3 rad/s: its periodic cycle."""
    machine = crank(**PRESS)
    stall, no_load = 800.0, 160.0 / 3.0

    def rates(phi, state, punching):
        energy, slope = state[0], state[2]
        inertia, first, _ = machine(phi)
        speed = math.sqrt(2 * energy / inertia)
        moment = stall * (1 - speed / no_load) - (FORCE * first if punching else 0.0)
        # T, t, dT/dT(0), integral of w.
        return (moment, 1 / speed, -stall / no_load / (inertia * speed) * slope, speed)

    def run(energy, count):
        state, seen = (energy, 0.0, 1.0, 0.0), []
        for low, high, punching in ((0.0, CONTACT, False), (CONTACT, TAU, True)):
            n = math.ceil(count * (high - low) / TAU)
            h = (high - low) / n
            for i in range(n):
                phi = low + i * h
                seen.append(math.sqrt(2 * state[0] / machine(phi)[0]))
                k1 = rates(phi, state, punching)
                k2 = rates(phi + h / 2, tuple(s + h / 2 * k for s, k in zip(state, k1)), punching)
                k3 = rates(phi + h / 2, tuple(s + h / 2 * k for s, k in zip(state, k2)), punching)
                k4 = rates(phi + h, tuple(s + h * k for s, k in zip(state, k3)), punching)
                state = tuple(s + h / 6 * (a + 2 * b + 2 * c + d) for s, a, b, c, d in zip(state, k1, k2, k3, k4))
        return state, seen

    def fixed(count):
        energy = 0.5 * machine(0.0)[0] * 25.0**2
        for _ in range(60):
            state, seen = run(energy, count)
            step = (state[0] - energy) / (1 - state[2])
            energy += step
            if abs(step) < 1e-13 * energy:
                break
        return energy, state

    def extrapolated(count):
        (e1, s1), (e2, s2) = fixed(count), fixed(2 * count)
        rich = lambda a, b: b + (b - a) / 15
        return rich(e1, e2), [rich(a, b) for a, b in zip(s1, s2)]

    energy, state = extrapolated(steps)
    return {
        "steady.period": state[1],
        "steady.mean_time": TAU / state[1],
        "steady.mean_angle": state[3] / TAU,
        "steady.speed_at_start": math.sqrt(2 * energy / machine(0.0)[0]),
        "steady.energy_at_start": energy,
        "steady.multiplier": state[2],
    }


def press_elastic(steps):
    """The same press with a frame that yields, 100 MN/m and 30 kN s/m: in absolute coordinates, over the angle."""
    radius, rod, mass, inertia = 0.08, 0.4, 220.0, 1.5
    stall, idle, stiffness, damping = 800.0, 160 / 3, 100e6, 30e3

    def rates(phi, state, force):
        place, speed, turning, _, _ = state
        sin, cos = math.sin(phi), math.cos(phi)
        root = math.sqrt(rod**2 - (radius * sin) ** 2)
        law, first = radius * cos + root, -radius * sin - radius**2 * sin * cos / root
        link = stiffness * (place - law) + damping * (speed - first * turning)
        moment = stall * (1 - turning / idle) + link * first
        return (speed / turning, (force - link) / mass / turning, moment / inertia / turning, 1 / turning, turning)

    def run(start, count):
        state, seen = tuple(start) + (0.0, 0.0), []
        for low, high, force in ((0.0, CONTACT, 0.0), (CONTACT, TAU, -90e3)):
            n = math.ceil(count * (high - low) / TAU)
            h = (high - low) / n
            for i in range(n):
                phi = low + i * h
                seen.append(state[2])
                k1 = rates(phi, state, force)
                k2 = rates(phi + h / 2, tuple(s + h / 2 * k for s, k in zip(state, k1)), force)
                k3 = rates(phi + h / 2, tuple(s + h / 2 * k for s, k in zip(state, k2)), force)
                k4 = rates(phi + h, tuple(s + h * k for s, k in zip(state, k3)), force)
                state = tuple(s + h / 6 * (a + 2 * b + 2 * c + d) for s, a, b, c, d in zip(state, k1, k2, k3, k4))
        return state, seen

    def fixed(count):
        # All but the slowest mode dies away within a turn: Aitken's extrapolation of the turns.
        state = [radius + rod, 0.0, 25.0]
        for _ in range(4):
            one = run(state, count)[0][:3]
            two = run(one, count)[0][:3]
            three = run(two, count)[0][:3]
            ratio = (three[2] - two[2]) / (two[2] - one[2]) if two[2] != one[2] else 0.0
            state = [c + (c - b) * ratio / (1 - ratio) for b, c in zip(two, three)]
        shift = 1e-3
        slope = (run([state[0], state[1], state[2] + shift], count)[0], run([state[0], state[1], state[2] - shift], count)[0])
        vector = [(a - b) / (2 * shift) for a, b in zip(slope[0][:3], slope[1][:3])]
        for _ in range(2):
            scaled = [v / vector[2] * shift for v in vector]
            ends = [run([x + sign * d for x, d in zip(state, scaled)], count)[0][:3] for sign in (1, -1)]
            vector = [(a - b) / (2 * shift) for a, b in zip(*ends)]
        end, seen = run(state, count)
        return state[2], end, vector[2], extreme(seen, 1), extreme(seen, -1)

    def extreme(seen, sense):
        i = max(range(1, len(seen) - 1), key=lambda i: sense * seen[i])
        a, b, c = seen[i - 1 : i + 2]
        return b - (c - a) ** 2 / (8 * (a - 2 * b + c))

    rich = lambda a, b: b + (b - a) / 15
    (w1, e1, m1, g1, l1), (w2, e2, m2, g2, l2) = fixed(steps), fixed(2 * steps)
    period, greatest, least = rich(e1[3], e2[3]), rich(g1, g2), rich(l1, l2)
    return {
        "steady.period": period,
        "steady.mean_time": TAU / period,
        "steady.mean_angle": rich(e1[4], e2[4]) / TAU,
        "steady.speed_at_start": rich(w1, w2),
        "steady.greatest_speed": greatest,
        "steady.least_speed": least,
        "steady.fluctuation": (greatest - least) * period / TAU,
        "steady.multiplier": rich(m1, m2),
    }


# Gas force on the piston over the crank angle (N), every 20 degrees: straight in between.
GAS = [21600, 19800, 13600, 8250, 5140, 3480, 2480, 1860, 1240, 500, 540, 640, 830, 1190, 1880, 3390, 7100, 14600, 21600]


def engine(panels):
    """Two-stroke engine: flywheel and crank 0.02 kg m2, piston with its share of the rod 2.9 kg."""
    machine = crank(0.06, 0.24, 2.9, 0.02)

    def gas(phi):
        place = phi / math.radians(20.0)
        i = min(int(place), 17)
        return -(GAS[i] + (GAS[i + 1] - GAS[i]) * (place - i)) * machine(phi)[1]

    breaks = [math.radians(20.0 * i) for i in range(1, 18)]
    bare = Cycle(machine, gas, breaks, panels)
    load = -bare.surplus / TAU
    cycle = Cycle(machine, lambda phi: gas(phi) + load, breaks, panels)
    return {**figures(cycle, 200.0, 0.0, load), "steady.cycle_work": bare.surplus}


def twice(name, f, coarse, fine):
    one, two = f(coarse), f(fine)
    return {
        "scene": f"scenarios/steady/{name}.json",
        "figures": {key: {"value": two[key], "spread": abs(two[key] - one[key])} for key in two},
    }


if __name__ == "__main__":
    cases = [
        twice("press_flywheel", press_flywheel, 60, 120),
        twice("press_motor", press_motor, 4000, 8000),
        twice("press_elastic", press_elastic, 4000, 8000),
        twice("engine", engine, 60, 120),
    ]
    path = os.path.join(os.path.dirname(__file__), "steady.json")
    with open(path, "w") as file:
        json.dump({"source": "tests/reference/steady.py", "cases": cases}, file, indent=1)
        file.write("\n")
    for case in cases:
        print(case["scene"])
        for key, entry in case["figures"].items():
            print(f"  {key} {entry['value']!r} spread {entry['spread']:.1e}")
