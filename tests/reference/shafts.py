"""Reference figures of scenarios/shafts.

run_up, two_rotors and free_vibration in closed form (mpmath), the others in
absolute coordinates with DOP853.
"""

import math

import mpmath as mp
from piecewise import exact, object_figures, simulate, twice, write

mp.mp.dps = 40


def greatest(function, duration, points=4000):
    """Greatest |function| on [0, duration]: best grid point, refined."""
    step = duration / points
    best = max(range(points + 1), key=lambda k: abs(function(k * step)))
    lo, hi = max(best - 1, 0) * step, min(best + 1, points) * step
    for _ in range(120):  # golden section on a unimodal bracket
        a, b = hi - (hi - lo) * mp.mpf("0.6180339887498949"), lo + (hi - lo) * mp.mpf("0.6180339887498949")
        lo, hi = (lo, b) if abs(function(a)) > abs(function(b)) else (a, hi)
    return abs(function((lo + hi) / 2))


def run_up():
    """A fan wheel behind an undamped shaft; the drive rises to w in T by 3 tau^2 - 2 tau^3.

    d'' + k^2 d = -alpha(t), alpha = (w/T)(6 tau - 6 tau^2): while it rises the
    particular solution is a parabola; afterwards free vibration.
    """
    inertia, stiffness, speed, rise, end = (mp.mpf(x) for x in ("0.4", "15000", "150", "0.08", "0.2"))
    k = mp.sqrt(stiffness / inertia)
    # alpha = p t - q t^2; particular d = -(p t - q t^2)/k^2 - 2 q/k^4
    p, q = 6 * speed / rise**2, 6 * speed / rise**3

    def rising(t):
        steady = -(p * t - q * t**2) / k**2 - 2 * q / k**4
        rate = -(p - 2 * q * t) / k**2
        a, b = 2 * q / k**4, p / k**3  # homogeneous part: d(0) = d'(0) = 0
        return (
            steady + a * mp.cos(k * t) + b * mp.sin(k * t),
            rate - a * k * mp.sin(k * t) + b * k * mp.cos(k * t),
        )

    d1, v1 = rising(rise)

    def state(t):
        if t <= rise:
            return rising(t)
        y = k * (t - rise)
        return d1 * mp.cos(y) + v1 / k * mp.sin(y), v1 * mp.cos(y) - d1 * k * mp.sin(y)

    amplitude = mp.sqrt(d1**2 + (v1 / k) ** 2)  # several periods of free vibration follow
    first = greatest(lambda t: state(t)[0], rise)
    d, v = state(end)
    peak = max(first, amplitude)
    return {
        "fan.delta_max": amplitude,
        "fan.delta_min": -peak,
        "fan.peak_reaction": stiffness * peak,
        "fan.peak_acceleration": stiffness * peak / inertia,
        "fan.peak_speed": speed + amplitude * k,
        "fan.final.displacement": speed * rise / 2 + speed * (end - rise) + d,
        "fan.final.speed": speed + v,
    }


def two_rotors():
    """A constant torque on one of two rotors joined by an undamped shaft, from rest.

    The mean moves with T/(J1 + J2), the twist d = -(T/(J1 k^2))(1 - cos k t).
    """
    j1, j2, c, torque, end = (mp.mpf(x) for x in ("0.05", "0.15", "6000", "30", "0.25"))
    k = mp.sqrt(c / j1 + c / j2)
    twist = torque / (j1 * k**2)
    d, v = -twist * (1 - mp.cos(k * end)), -twist * k * mp.sin(k * end)
    mean, mean_speed = torque * end**2 / 2 / (j1 + j2), torque * end / (j1 + j2)
    share1, share2 = j1 / (j1 + j2), j2 / (j1 + j2)
    turns = mp.floor(k * end / (2 * mp.pi))
    rest = k * end - 2 * mp.pi * turns
    absolute = twist * (k * end - mp.sin(k * end)) / k  # the twist never changes sign
    return {
        "load.delta_max": 0,
        "load.delta_min": -2 * twist,
        "load.sigma": absolute / end,
        "load.peak_reaction": 2 * c * twist,
        "load.peak_acceleration": 2 * c * twist / j2,
        "load.final.displacement": mean + share1 * d,
        "load.final.speed": mean_speed + share1 * v,
        "motor.final.displacement": mean - share2 * d,
        "motor.final.speed": mean_speed - share2 * v,
    }


def vertical_feed(rtol, duration=0.3):
    """Servo motor (torque table), ball screw, nut and vertical slide with weight and friction."""
    rotor, screw, torsion, screw_psi = 0.0042, 0.0018, 9.0e3, 0.3
    lead, slide, nut, nut_psi = 0.010, 120.0, 1.8e8, 0.4
    gravity, friction, width = 9.80665, 250.0, 0.005
    table = [(0.0, 20.0), (200.0, 20.0), (314.0, 9.0), (420.0, 0.0)]
    cutting = [(0.15, 0.0), (0.16, -1500.0), (0.24, -1500.0), (0.25, 0.0)]
    arm = lead / (2 * math.pi)
    screw_b = screw_psi * math.sqrt(torsion * screw) / (2 * math.pi)
    nut_b = nut_psi * math.sqrt(nut * slide) / (2 * math.pi)

    def straight(points, x):
        if x <= points[0][0]:
            return points[0][1]
        for (a, va), (b, vb) in zip(points[:-1], points[1:]):
            if x <= b:
                return va + (vb - va) * (x - a) / (b - a)
        return points[-1][1]

    def inner(y):
        motor, turn, height, w_motor, w_turn, v = y
        twist = torsion * (turn - motor) + screw_b * (w_turn - w_motor)
        thrust = nut * (height - arm * turn) + nut_b * (v - arm * w_turn)
        return twist, thrust

    def rhs(t, y, mode):
        twist, thrust = inner(y)
        load = straight(cutting, t) - slide * gravity - friction * math.tanh(y[5] / width)
        return [
            y[3], y[4], y[5],
            (straight(table, y[3]) + twist) / rotor,
            (arm * thrust - twist) / screw,
            (load - thrust) / slide,
        ]

    # the speed passes the corners of the torque table: pieces by mode
    def guards(mode):
        corners = [w for w, _ in table[1:-1]]
        below = [w for w in corners if w < mode]
        above = [w for w in corners if w > mode]
        watch = []
        if above:
            watch.append((lambda t, y, w=min(above): y[3] - w, +1, (min(above) + 57.0)))
        if below:
            watch.append((lambda t, y, w=max(below): y[3] - w, -1, (max(below) - 57.0)))
        return watch

    weight = -slide * gravity
    turn = weight * arm / torsion
    height = arm * turn + weight / nut
    motion = simulate(
        rhs, guards, [0.0, turn, height, 0.0, 0.0, 0.0], 100.0, duration,
        breaks=[t for t, _ in cutting], max_step=1e-4, rtol=rtol,
        atol=[1e-4 * rtol, 1e-4 * rtol, 1e-7 * rtol, rtol, rtol, 1e-3 * rtol],
    )
    figures = {"motor.final.displacement": motion.end[0], "motor.final.speed": motion.end[3]}
    figures["motor.peak_speed"] = motion.peak(lambda t, y, m: y[3])
    figures |= object_figures(
        "screw", motion, duration,
        delta=lambda t, y, m: y[1] - y[0], speed=lambda t, y, m: y[4],
        acceleration=lambda t, y, m: rhs(t, y, m)[4], reaction=lambda t, y, m: inner(y)[0],
    )
    figures |= object_figures(
        "slide", motion, duration,
        delta=lambda t, y, m: y[2] - arm * y[1], speed=lambda t, y, m: y[5],
        acceleration=lambda t, y, m: rhs(t, y, m)[5], reaction=lambda t, y, m: inner(y)[1],
    )
    figures["slide.final.displacement"], figures["slide.final.speed"] = motion.end[2], motion.end[5]
    return figures


def free_vibration():
    """A turned and released wheel behind a turning shaft: logarithmic decrement psi/2 a cycle.

    d'' + 2 zeta k d' + k^2 d = 0 with b = psi sqrt(cJ)/(2 pi), so zeta = psi/(4 pi).
    """
    inertia, stiffness, psi, start, speed, end = (mp.mpf(x) for x in ("0.02", "8000", "0.25", "0.01", "30", "0.1"))
    k, zeta = mp.sqrt(stiffness / inertia), psi / (4 * mp.pi)
    w, decay = k * mp.sqrt(1 - zeta**2), zeta * k
    d = lambda t: start * mp.exp(-decay * t) * (mp.cos(w * t) + decay / w * mp.sin(w * t))
    v = lambda t: -start * mp.exp(-decay * t) * (k**2 / w) * mp.sin(w * t)
    first = mp.pi / w  # first trough; the greatest is the start itself
    fastest = (mp.pi + mp.atan(w / decay)) / w  # second root of v' = 0: on the way back
    return {
        "wheel.delta_max": start,
        "wheel.delta_min": d(first),
        "wheel.sigma": (mp.quad(lambda t: abs(d(t)), crossings(d, end)) / end),
        "wheel.peak_speed": speed + v(fastest),
        "wheel.peak_acceleration": k**2 * start,
        "wheel.peak_reaction": stiffness * start,
        "wheel.final.displacement": speed * end + d(end),
        "wheel.final.speed": speed + v(end),
    }


def crossings(function, end, points=400):
    """0, the roots of the function, and the end."""
    grid = [end * k / points for k in range(points + 1)]
    roots = [
        mp.findroot(function, (a, b), solver="anderson")
        for a, b in zip(grid, grid[1:]) if function(a) * function(b) < 0
    ]
    return [mp.mpf(0), *roots, end]


def fan_on_line(rtol, duration=0.3):
    """Asynchronous motor, tubular shaft of four equal masses, fan fixed to its end."""
    rotor, breakdown, slip_b, synchronous = 0.028, 138.0, 0.181, 50 * math.pi
    polar = math.pi * (0.06**4 - 0.05**4) / 32
    n, psi = 4, 0.1
    whole_j, whole_c = 7850 * polar * 0.8, 80e9 * polar / 0.8
    j, c = whole_j / n, whole_c * n
    b = psi * c / (2 * math.pi * math.sqrt(whole_c / whole_j))
    fan, drag = 0.35, 0.25

    def links(y):
        x, s = y[: n + 1], y[n + 1 :]
        return [c * (x[i + 1] - x[i]) + b * (s[i + 1] - s[i]) for i in range(n)]

    def rhs(t, y, mode):
        pull, s = links(y), y[n + 1 :]
        slip = 1 - s[0] / synchronous
        torque = 2 * breakdown * slip * slip_b / (slip**2 + slip_b**2)
        a = [(torque + pull[0]) / rotor]
        a += [(pull[i + 1] - pull[i]) / j for i in range(n - 1)]
        a += [(-drag * s[n] - pull[n - 1]) / (j + fan)]
        return [*s, *a]

    motion = simulate(
        rhs, lambda mode: [], [0.0] * (2 * n + 2), "on", duration, max_step=4e-5, rtol=rtol,
        atol=[1e-5 * rtol] * (n + 1) + [1e-2 * rtol] * (n + 1),
    )
    figures = {"motor.final.displacement": motion.end[0], "motor.final.speed": motion.end[n + 1]}
    figures |= object_figures(
        "tube", motion, duration,
        delta=lambda t, y, m: y[n] - y[0], speed=lambda t, y, m: y[-1],
        acceleration=lambda t, y, m: rhs(t, y, m)[-1], reaction=lambda t, y, m: links(y)[0],
    )
    figures["fan.peak_reaction"] = motion.peak(lambda t, y, m: -drag * y[-1] - fan * rhs(t, y, m)[-1])
    figures["fan.final.displacement"], figures["fan.final.speed"] = motion.end[n], motion.end[-1]
    return figures


def slewing(rtol, duration=0.9):
    """A boom behind a slewing gear whose angle is given as a table over time.

    Cubic spline; end slopes of the polynomials through the four points nearest
    each end; beyond the table the drive turns on with its last speed.
    """
    import numpy as np
    from scipy.interpolate import CubicSpline

    times = np.array([0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7])
    angles = np.array([0, 0.05, 0.25, 0.6, 1.0, 1.35, 1.55, 1.6])
    first = np.polyfit(times[:4], angles[:4], 3)
    last = np.polyfit(times[-4:], angles[-4:], 3)
    slopes = float(np.polyval(np.polyder(first), 0)), float(np.polyval(np.polyder(last), 0.7))
    spline = CubicSpline(times, angles, bc_type=((1, slopes[0]), (1, slopes[1])))
    inertia, stiffness, psi = 2.5, 2.0e4, 0.2
    b = psi * math.sqrt(inertia * stiffness) / (2 * math.pi)

    def law(t):
        if t >= 0.7:
            return 1.6 + slopes[1] * (t - 0.7), slopes[1]
        return float(spline(t)), float(spline(t, 1))

    def link(t, y):
        u, v = law(t)
        return stiffness * (y[0] - u) + b * (y[1] - v)

    rhs = lambda t, y, mode: [y[1], -link(t, y) / inertia]
    motion = simulate(
        rhs, lambda mode: [], [0.0, slopes[0]], "on", duration, breaks=[float(t) for t in times],
        max_step=1e-3, rtol=rtol, atol=[1e-3 * rtol, rtol],
    )
    figures = object_figures(
        "boom", motion, duration,
        delta=lambda t, y, m: y[0] - law(t)[0], speed=lambda t, y, m: y[1],
        acceleration=lambda t, y, m: rhs(t, y, m)[1], reaction=lambda t, y, m: link(t, y),
    )
    figures["boom.final.displacement"], figures["boom.final.speed"] = motion.end
    return figures


if __name__ == "__main__":
    write(
        "shafts",
        "Shafts: closed forms at 40 digits (run_up, two_rotors, free_vibration); the others in absolute coordinates, "
        "DOP853 at rtol 1e-12, spread against rtol 1e-10. Script: shafts.py.",
        {
            "run_up": exact(run_up()),
            "two_rotors": exact(two_rotors()),
            "free_vibration": exact(free_vibration()),
            "vertical_feed": twice(vertical_feed),
            "fan_on_line": twice(fan_on_line),
            "slewing": twice(slewing),
        },
    )
