"""Figures of scenarios/joint_friction/arm_comes_to_rest: an arm of two links swings to rest by the friction of its pins.

Newton and Euler's equations of both links, the reactions in both pins from the accelerations of the centres
of mass, the couple of each pin -sign * mu * d/2 * |R| by a fixed point. A pin at rest has the couple that keeps
it so. Where the rate of a pin passes zero, and where a couple passes its limit, all ways to go on (each pin at
rest turns either way, or stays) are tried, and exactly one must agree with Coulomb's law. Runge and Kutta's
classical method with a fixed step, cut at these places by bisection, taken with h and h/2 and extrapolated.
Needs nothing but Python. Writes several_friction.json.
"""

import itertools
import json
import math
import pathlib

LENGTH = 0.5
MASSES, MOMENTS = (2.0, 1.5), (0.05, 0.02)
CENTRES = ((0.25, 0.02), (0.2, 0.0))
LIMITS = (0.5 * 0.16 / 2, 0.5 * 0.12 / 2)
GRAVITY = 9.80665
START = (math.radians(20), math.radians(40), 2.0, -3.0)
DURATION = 6.0


def bodies(state, spins):
    """Reactions (elbow, shoulder) and moments about the centres, for angular accelerations of both links."""
    q, p, u, v = state
    a, b = q, q + p
    wa, wb = u, u + v
    ca, sa, cb, sb = math.cos(a), math.sin(a), math.cos(b), math.sin(b)
    (x1, y1), (x2, y2) = CENTRES
    c1 = (x1 * ca - y1 * sa, x1 * sa + y1 * ca)
    c2 = (x2 * cb - y2 * sb, x2 * sb + y2 * cb)
    e = (LENGTH * ca, LENGTH * sa)
    s1, s2 = spins

    def turned(r, spin, rate):
        return (-spin * r[1] - rate * rate * r[0], spin * r[0] - rate * rate * r[1])

    a1, ae, a2 = turned(c1, s1, wa), turned(e, s1, wa), turned(c2, s2, wb)
    elbow = (MASSES[1] * (ae[0] + a2[0]), MASSES[1] * (ae[1] + a2[1] + GRAVITY))
    shoulder = (elbow[0] + MASSES[0] * a1[0], elbow[1] + MASSES[0] * (a1[1] + GRAVITY))
    # Couples of the pins are what is missing: (shoulder - elbow) on the first link, elbow on the second.
    d = (e[0] - c1[0], e[1] - c1[1])
    first = MOMENTS[0] * s1 + c1[0] * shoulder[1] - c1[1] * shoulder[0] + d[0] * elbow[1] - d[1] * elbow[0]
    second = MOMENTS[1] * s2 + c2[0] * elbow[1] - c2[1] * elbow[0]
    return first, second, math.hypot(*shoulder), math.hypot(*elbow)


def solve(state, signs):
    """Accelerations of both pins, couples of both and their limits; a sign of 0 holds the pin at rest."""
    f0, s0, _, _ = bodies(state, (0.0, 0.0))
    f1, s1, _, _ = bodies(state, (1.0, 0.0))
    f2, s2, _, _ = bodies(state, (0.0, 1.0))
    # Sums for the pins: (first + second) = shoulder's couple, second = elbow's couple; by accelerations of the pins.
    m11, m12 = f1 + s1 + f2 + s2 - 2 * (f0 + s0), f2 + s2 - f0 - s0
    m21, m22 = s1 + s2 - 2 * s0, s2 - s0
    r1, r2 = f0 + s0, s0
    one = two = 0.0
    before = None
    for _ in range(200):
        if signs[0] == 0 and signs[1] == 0:
            x = y = 0.0
        elif signs[0] == 0:
            x, y = 0.0, (two - r2) / m22
        elif signs[1] == 0:
            x, y = (one - r1) / m11, 0.0
        else:
            det = m11 * m22 - m12 * m21
            x = ((one - r1) * m22 - (two - r2) * m12) / det
            y = ((two - r2) * m11 - (one - r1) * m21) / det
        first, second, shoulder, elbow = bodies(state, (x, x + y))
        limits = (LIMITS[0] * shoulder, LIMITS[1] * elbow)
        one = first + second if signs[0] == 0 else -signs[0] * limits[0]
        two = second if signs[1] == 0 else -signs[1] * limits[1]
        if before is not None and abs(x - before[0]) + abs(y - before[1]) <= 1e-15 * (abs(x) + abs(y)):
            break
        before = (x, y)
    return (x, y), (one, two), limits


def slope(state, signs):
    (x, y), couples, _ = solve(state, signs)
    power = -sum(c * w for c, w, s in zip(couples, state[2:], signs) if s)
    return (state[2], state[3], x, y, power)


def step(state, signs, h):
    def moved(k, part):
        return tuple(s + part * h * d for s, d in zip(state, k))

    k1 = slope(state[:4], signs)
    k2 = slope(moved(k1, 0.5)[:4], signs)
    k3 = slope(moved(k2, 0.5)[:4], signs)
    k4 = slope(moved(k3, 1.0)[:4], signs)
    return tuple(s + h / 6 * (a + 2 * b + 2 * c + d) for s, a, b, c, d in zip(state, k1, k2, k3, k4))


def passed(state, signs):
    """The pins that have turned back, or whose couple holds no longer."""
    _, couples, limits = solve(state[:4], signs)
    turned = [k for k in (0, 1) if signs[k] and signs[k] * state[2 + k] < 0]
    loose = [k for k in (0, 1) if not signs[k] and abs(couples[k]) > limits[k]]
    return turned, loose


def go_on(state, signs, turned, loose):
    resting = [k for k in (0, 1) if signs[k] == 0 or k in turned]
    found = []
    for way in itertools.product((0, 1, -1), repeat=len(resting)):
        tried = list(signs)
        for k, sign in zip(resting, way):
            tried[k] = sign
        accelerations, couples, limits = solve(state[:4], tried)
        if all(
            accelerations[k] * s > -1e-6 * (k in loose) if s else abs(couples[k]) <= limits[k] * (1 - 1e-9 * (k in loose))
            for k, s in zip(resting, way)
        ):
            found.append(tuple(tried))
    if len(found) != 1:
        raise SystemExit(f"{len(found)} ways at {state}")
    return found[0]


def run(h):
    state, signs, t = START + (0.0,), (1, -1), 0.0
    rest, since, switches = 0.0, None, []
    number, count = 0, round(DURATION / h)
    while number < count:
        left = (number + 1) * h - t
        new = step(state, signs, left)
        if signs == (0, 0) or passed(new, signs) == ([], []):
            state, t, number = new, (number + 1) * h, number + 1
            continue
        low, high = 0.0, left
        for _ in range(60):
            middle = 0.5 * (low + high)
            if passed(step(state, signs, middle), signs) == ([], []):
                low = middle
            else:
                high = middle
        state = step(state, signs, high)
        t += high
        turned, loose = passed(state, signs)
        state = tuple(0.0 if k - 2 in turned else s for k, s in enumerate(state))
        signs = go_on(state, signs, turned, loose)
        switches.append((t, signs))
        if signs == (0, 0):
            since = t
    if since is not None:
        rest = DURATION - since
    return state, rest, switches


def main():
    (one, first, _), (two, second, switches) = run(1e-4), run(5e-5)
    better = [b + (b - a) / 15 for a, b in zip(one + (first,), two + (second,))]
    spread = [abs(b - a) for a, b in zip(two + (second,), better)]
    for t, signs in switches:
        print(f"{t:.12f} {signs}")
    names = {
        "arm.shoulder.final.displacement": 0,
        "arm.elbow.final.displacement": 1,
        "arm.friction_loss": 4,
        "arm.time_at_rest": 5,
    }
    out = {name: {"value": better[k], "spread": spread[k]} for name, k in names.items()}
    for name, figure in out.items():
        print(name, figure)
    path = pathlib.Path(__file__).with_suffix(".json")
    path.write_text(json.dumps({"arm_comes_to_rest": out}, indent=2) + "\n")


if __name__ == "__main__":
    main()
