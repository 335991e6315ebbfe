"""Reference figures of scenarios/indexing: vibration in the dwells of cams.

A heald frame driven by a modified trapezoid; a lever driven by a harmonic rise
with a cycloidal return.
"""

import math

import mpmath as mp
from laws import cam, modified_trapezoid
from piecewise import exact, object_figures, simulate, twice, write

mp.mp.dps = 40


def residual():
    """One undamped mass: d'' + k^2 d = -U''(t), exact piece by piece, into the upper dwell."""
    mass, stiffness, lift = mp.mpf(12), mp.mpf(1200000), mp.mpf("0.1")
    omega = 300 * 2 * mp.pi / 60
    rise = mp.radians(120) / omega
    lead_in = mp.radians(30) / omega  # rest before the rise
    end = mp.mpf("0.115")
    k = mp.sqrt(stiffness / mass)
    peak = lift / rise**2 * 8 * mp.pi / (2 + mp.pi)
    w = 4 * mp.pi / rise
    # U'' = sine, constant, cosine, constant, sine part of each piece of the law
    pieces = [
        (rise / 8, 0, peak, 0), (rise / 4, peak, 0, 0), (rise / 4, 0, 0, peak),
        (rise / 4, -peak, 0, 0), (rise / 8, 0, 0, -peak),
    ]
    begin, start, d, v = [], lead_in, mp.mpf(0), mp.mpf(0)

    def advance(d, v, piece, y):
        _, a, s, c = piece
        particular = lambda y: -(a / k**2 + (s * mp.sin(w * y) + c * mp.cos(w * y)) / (k**2 - w**2))
        rate = lambda y: -(s * mp.cos(w * y) - c * mp.sin(w * y)) * w / (k**2 - w**2)
        d0, v0 = d - particular(0), v - rate(0)
        return (
            particular(y) + d0 * mp.cos(k * y) + v0 / k * mp.sin(k * y),
            rate(y) + v0 * mp.cos(k * y) - d0 * k * mp.sin(k * y),
        )

    extremes = [mp.mpf(0)]
    for piece in pieces:
        steps = 400
        values = [advance(d, v, piece, piece[0] * j / steps) for j in range(steps + 1)]
        for (_, va), (_, vb), j in zip(values[:-1], values[1:], range(steps)):
            if va * vb < 0:
                y = mp.findroot(lambda y: advance(d, v, piece, y)[1], (piece[0] * j / steps, piece[0] * (j + 1) / steps), solver="anderson", tol=1e-60)
                extremes.append(advance(d, v, piece, y)[0])
        d, v = values[-1]
        start += piece[0]
    amplitude = mp.sqrt(d**2 + (v / k) ** 2)
    y = k * (end - start)
    assert 0 < y, "the run ends in the upper dwell"
    # extremes of the free vibration that fall into the run
    phase = mp.atan2(v / k, d)
    extremes += [amplitude * mp.cos(n * mp.pi) for n in range(0, 20) if 0 < phase + n * mp.pi < y]
    d1, v1 = d * mp.cos(y) + v / k * mp.sin(y), v * mp.cos(y) - d * k * mp.sin(y)
    extremes.append(d1)
    print("# residual amplitude", mp.nstr(amplitude, 12), "in the dwell for", mp.nstr(y / (2 * mp.pi), 4), "periods")
    return {
        "frame.delta_max": max(extremes),
        "frame.delta_min": min(extremes),
        "frame.peak_reaction": stiffness * max(abs(e) for e in extremes),
        "frame.peak_acceleration": stiffness / mass * max(abs(e) for e in extremes),
        "frame.final.displacement": lift + d1,
        "frame.final.speed": v1,
    }


def soft_shock():
    """Harmonic rise (its acceleration jumps at both ends), cycloidal return, one undamped mass.

    The same propagation as above, over rise, dwell, return and into the rest.
    """
    inertia, stiffness, lift = mp.mpf("0.02"), mp.mpf(9000), mp.radians(30)
    omega = 200 * 2 * mp.pi / 60
    wait, rise, dwell, back = (mp.radians(x) / omega for x in (20, 110, 50, 120))
    end = mp.mpf("0.29")
    k = mp.sqrt(stiffness / inertia)
    one = lift * (mp.pi / rise) ** 2 / 2
    two = lift * 2 * mp.pi / back**2
    # U'' of the return: the cycloidal law run backwards, -two sin(2 pi y/back)
    stretches = [
        (rise, mp.pi / rise, 0, one), (dwell, mp.mpf(1), 0, 0), (back, 2 * mp.pi / back, -two, 0),
        (end - wait - rise - dwell - back, mp.mpf(1), 0, 0),
    ]
    d, v, deviations, accelerations = mp.mpf(0), mp.mpf(0), [mp.mpf(0)], [mp.mpf(0)]
    for length, w, s, c in stretches:
        assert length > 0

        def state(y, d=d, v=v, w=w, s=s, c=c):
            particular = -(s * mp.sin(w * y) + c * mp.cos(w * y)) / (k**2 - w**2)
            rate = -(s * mp.cos(w * y) - c * mp.sin(w * y)) * w / (k**2 - w**2)
            d0, v0 = d + c / (k**2 - w**2), v + s * w / (k**2 - w**2)
            return (
                particular + d0 * mp.cos(k * y) + v0 / k * mp.sin(k * y),
                rate + v0 * mp.cos(k * y) - d0 * k * mp.sin(k * y),
            )

        steps = 600
        values = [state(length * j / steps)[1] for j in range(steps + 1)]
        for j in range(steps):
            if values[j] * values[j + 1] < 0:
                bracket = (length * j / steps, length * (j + 1) / steps)
                y = mp.findroot(lambda y: state(y)[1], bracket, solver="anderson", tol=1e-60)
                deviations.append(state(y)[0])
        d, v = state(length)
        deviations.append(d)
    return {
        "lever.delta_max": max(deviations),
        "lever.delta_min": min(deviations),
        "lever.peak_reaction": stiffness * max(abs(x) for x in deviations),
        "lever.peak_acceleration": k**2 * max(abs(x) for x in deviations),
        "lever.final.displacement": d,
        "lever.final.speed": v,
    }


def ten_masses(rtol, duration=0.6):
    """Ten masses in a row, damped, with weight and return springs, from static rest."""
    n, mass, stiffness, psi = 10, 12.0, 1.2e6, 0.3
    rate, preload, gravity = 4.0e3, 350.0, 9.80665
    omega, phase = 300 * 2 * math.pi / 60, math.radians(-30)
    angles = [math.radians(a) for a in (120, 60, 120)]
    m, c = mass / n, n * stiffness
    b = psi * c / (2 * math.pi * math.sqrt(stiffness / mass))

    def law(t):
        u, u1, u2 = cam(omega * t + phase, modified_trapezoid, 0.1, *angles)
        return u, u1 * omega, u2 * omega**2

    def rhs(t, y, mode):
        u, v, _ = law(t)
        x, s = y[:n], y[n:]
        pull = [c * (x[0] - u) + b * (s[0] - v)]
        pull += [c * (x[i] - x[i - 1]) + b * (s[i] - s[i - 1]) for i in range(1, n)]
        force = [-pull[i] + (pull[i + 1] if i + 1 < n else 0.0) - m * gravity for i in range(n)]
        force[-1] -= preload + rate * x[-1]
        return list(s) + [f / m for f in force]

    # static rest: link i carries the weight of masses i..n and the spring
    def static(tip):
        spring, x, total = preload + rate * tip, 0.0, []
        for i in range(n):
            x -= (spring + (n - i) * m * gravity) / c
            total.append(x)
        return total

    low, high = -0.1, 0.1
    for _ in range(200):  # bisection on the tip's displacement
        middle = (low + high) / 2
        low, high = (middle, high) if static(middle)[-1] > middle else (low, middle)
    start = static(low)
    edges = [0, *(angles[0] * f for f in (0.125, 0.375, 0.625, 0.875, 1))]
    edges += [angles[0] + angles[1] + angles[2] * f for f in (0, 0.125, 0.375, 0.625, 0.875, 1)]
    breaks = [(e - phase + 2 * math.pi * k) / omega for e in edges for k in range(-1, 4)]
    motion = simulate(
        rhs, lambda mode: [], start + [0.0] * n, "on", duration, breaks=breaks, max_step=1e-4, rtol=rtol,
        atol=[1e-4 * rtol] * n + [1e-2 * rtol] * n,
    )
    figures = object_figures(
        "frame", motion, duration,
        delta=lambda t, y, k: y[n - 1] - law(t)[0], speed=lambda t, y, k: y[-1],
        acceleration=lambda t, y, k: rhs(t, y, k)[-1],
        reaction=lambda t, y, k: c * (y[0] - law(t)[0]) + b * (y[n] - law(t)[1]),
    )
    figures["frame.final.displacement"], figures["frame.final.speed"] = motion.end[n - 1], motion.end[-1]
    return figures


if __name__ == "__main__":
    write(
        "indexing",
        "Heald frame on a modified-trapezoid cam: residual vibration and soft shock in closed form (40 digits); ten masses "
        "in absolute coordinates, DOP853 at rtol 1e-12, spread against rtol 1e-10. Script: indexing.py.",
        {"residual_vibration": exact(residual()), "soft_shock": exact(soft_shock()), "ten_masses": twice(ten_masses)},
    )
