"""Reference figures of scenarios/rigid and scenarios/limits: no elastic object at all.

Closed forms (mpmath at 40 digits, roots of polynomials); the pump by its
Lagrange equation.
"""

import math

import mpmath as mp
from laws import slider_crank
from piecewise import exact, simulate, twice, write

mp.mp.dps = 40


def engine_slider():
    """Crosshead of a 1500 rpm slider-crank, r = 45 mm, l = 160 mm, 0.82 kg.

    x = r cos(phi) + sqrt(l^2 - r^2 sin^2(phi)); the greatest acceleration is at
    the outer dead centre, w^2 (r + r^2/l); the greatest speed by maximising.
    """
    r, l, m, w = mp.mpf("0.045"), mp.mpf("0.16"), mp.mpf("0.82"), 50 * mp.pi
    speed = lambda phi: w * (r * mp.sin(phi) + r**2 * mp.sin(phi) * mp.cos(phi) / mp.sqrt(l**2 - (r * mp.sin(phi)) ** 2))
    phi = mp.findroot(lambda p: mp.diff(speed, p), mp.mpf("1.3"))
    peak = w**2 * (r + r**2 / l)
    return {
        "crosshead.peak_speed": speed(phi),
        "crosshead.peak_acceleration": peak,
        "crosshead.peak_reaction": m * peak,
        "crosshead.final.displacement": r + l,
        "crosshead.final.speed": 0,
    }


def rocker_margin(inertia):
    """Rigid rocker under the closing moment 600 N m: N = M + J U'' w^2, least M - J A w^2."""
    amplitude, w, moment = mp.pi / 2, 20 * mp.pi, 600
    peak = amplitude * w**2
    return {
        "rocker.pair.margin": moment - inertia * peak,
        "rocker.pair.max_contact_force": moment + inertia * peak,
        "rocker.peak_reaction": moment + inertia * peak,
        "rocker.peak_acceleration": peak,
        "rocker.peak_speed": amplitude * w,
    }


def pump(rtol, duration=2.0):
    """Motor with linear characteristic, crank and plunger: one degree of freedom.

    d/dt(T') - T'/2... written from Lagrange: with J(phi) = Jm + Jc + m x'(phi)^2,
    J phi'' + J'(phi)/2 phi'^2 = torque(phi') + W(phi) x'(phi) - friction.
    """
    j_motor, j_crank, mass = 0.021, 0.25, 1.9
    crank, rod = 0.03, 0.15
    stall, no_load = 60.0, 2 * math.pi * 12.5
    delivery, viscous = -2200.0, 35.0

    def geometry(phi):
        return slider_crank(phi, crank, rod)

    def acceleration(y, mode):
        _, x1, x2 = geometry(y[0])
        inertia = j_motor + j_crank + mass * x1 * x1
        load = (delivery if mode == "delivery" else 0.0) - viscous * x1 * y[1]
        torque = stall * (1 - y[1] / no_load)
        return (torque + load * x1 - mass * x1 * x2 * y[1] ** 2) / inertia

    def rhs(t, y, mode):
        return [y[1], acceleration(y, mode)]

    # the plunger moves out (x grows) while the crank runs from 180 to 360 degrees
    def guards(mode):
        if mode == "suction":
            return [(lambda t, y: math.sin(y[0]), -1, "delivery")]
        return [(lambda t, y: math.sin(y[0]), +1, "suction")]

    motion = simulate(
        rhs, guards, [0.0, 0.0], "suction", duration, max_step=2e-3, rtol=rtol, atol=[1e-2 * rtol, rtol]
    )

    def plunger(t, y, mode):
        x, x1, x2 = geometry(y[0])
        return x, x1 * y[1], x1 * acceleration(y, mode) + x2 * y[1] ** 2

    def reaction(t, y, mode):  # W - m a: with it the crank is driven
        _, v, a = plunger(t, y, mode)
        return (delivery if mode == "delivery" else 0.0) - viscous * v - mass * a

    return {
        "motor.final.displacement": motion.end[0],
        "motor.final.speed": motion.end[1],
        "motor.peak_speed": motion.peak(lambda t, y, m: y[1]),
        "motor.peak_acceleration": motion.peak(lambda t, y, m: acceleration(y, m)),
        "plunger.final.displacement": geometry(motion.end[0])[0],
        "plunger.final.speed": geometry(motion.end[0])[1] * motion.end[1],
        "plunger.peak_speed": motion.peak(lambda t, y, m: plunger(t, y, m)[1]),
        "plunger.peak_acceleration": motion.peak(lambda t, y, m: plunger(t, y, m)[2]),
        "plunger.peak_reaction": motion.peak(reaction),
    }


def measured_cam():
    """A follower on a cam measured every 30 deg: periodic cubic spline, rigid, with a spring.

    U'' is linear between the points, so the acceleration is greatest at one of
    them; the contact force m U'' w^2 + preload + rate U is stationary at the
    roots of a quadratic in each interval, or extreme at a point.
    """
    import numpy as np
    from scipy.interpolate import CubicSpline

    lifts = [0, 0.4, 2.6, 6.8, 10.4, 12.0, 12.2, 12.0, 10.4, 6.8, 2.6, 0.4, 0]
    angles = np.radians(np.arange(0, 361, 30))
    spline = CubicSpline(angles, np.array(lifts) * 1e-3, bc_type="periodic")
    mass, rate, preload, w = 0.8, 6000.0, 90.0, 1200 * 2 * math.pi / 60
    force = lambda phi: mass * w**2 * spline(phi, 2) + preload + rate * spline(phi)
    places = list(angles)
    for a, b, k in zip(angles[:-1], angles[1:], range(12)):
        c3, c2, c1, _ = spline.c[:, k]
        stationary = np.roots([3 * rate * c3, 2 * rate * c2, rate * c1 + 6 * mass * w**2 * c3])
        places += [a + r.real for r in stationary if abs(r.imag) < 1e-12 and 0 < r.real < b - a]
    values = [float(force(place)) for place in places]
    speeds = list(angles)
    for a, b, k in zip(angles[:-1], angles[1:], range(12)):
        c3, c2, _, _ = spline.c[:, k]
        if c3 and 0 < -c2 / (3 * c3) < b - a:
            speeds.append(a - c2 / (3 * c3))
    return {
        "follower.peak_speed": max(abs(float(spline(p, 1))) for p in speeds) * w,
        "follower.peak_acceleration": max(abs(float(spline(p, 2))) for p in angles) * w**2,
        "follower.peak_reaction": max(abs(v) for v in values),
        "follower.pair.margin": min(values),
        "follower.pair.max_contact_force": max(values),
    }


def spiral():
    """A slide on a widening spiral, x = a p + b p^2, while the disc runs up to w in T.

    Acceleration (a + 2 b p) alpha + 2 b w(t)^2: greatest where its derivative
    vanishes during the run-up.
    """
    a, b, speed, rise, end, mass = (mp.mpf(x) for x in ("0.002", "0.0001", "40", "0.5", "1", "3"))
    angle = lambda t: speed * rise * ((t / rise) ** 3 - (t / rise) ** 4 / 2)
    rate = lambda t: mp.diff(angle, t)
    acceleration = lambda t: (a + 2 * b * angle(t)) * mp.diff(angle, t, 2) + 2 * b * rate(t) ** 2
    top = mp.findroot(lambda t: mp.diff(acceleration, t), mp.mpf("0.35"))
    peak = max(acceleration(top), 2 * b * speed**2)
    last = speed * rise / 2 + speed * (end - rise)
    return {
        "slide.peak_speed": (a + 2 * b * last) * speed,
        "slide.peak_acceleration": peak,
        "slide.peak_reaction": mass * peak,
        "slide.final.displacement": a * last + b * last**2,
        "slide.final.speed": (a + 2 * b * last) * speed,
    }


def dead_positions():
    """Times at which the linkage cannot be carried further by its crank."""
    # rod 0.08 m shorter than the crank 0.1 m: sin(phi) = l/r, from phi = 0 at 2 rad/s
    slider = mp.asin(mp.mpf("0.8")) / 2
    # coupler and rocker in line: a^2 + d^2 - 2 a d cos(phi) = (b + c)^2, from 60 deg at 0.5 rad/s
    a, b, c, d = (mp.mpf(x) for x in ("0.2", "0.15", "0.12", "0.1"))
    phi = mp.acos((a**2 + d**2 - (b + c) ** 2) / (2 * a * d))
    lever = (phi - mp.pi / 3) / mp.mpf("0.5")
    return {"short_rod": slider, "four_bar": lever}


if __name__ == "__main__":
    stops = dead_positions()
    write(
        "rigid",
        "Rigid mechanisms: closed forms at 40 digits; the pump from its Lagrange equation, DOP853 at "
        "rtol 1e-12, spread against rtol 1e-10. Script: rigid.py.",
        {
            "engine_slider": exact(engine_slider()),
            "rocker_in_order": exact(rocker_margin(mp.mpf("0.09"))),
            "rocker_beyond_edge": exact(rocker_margin(mp.mpf("0.1"))),
            "measured_cam": exact(measured_cam()),
            "spiral": exact(spiral()),
            "pump": twice(pump),
            "short_rod": exact({"stops": stops["short_rod"]}),
            "four_bar": exact({"stops": stops["four_bar"]}),
        },
    )
