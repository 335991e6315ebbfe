"""Reference figures of scenarios/valve_train/valve_lash.json: a valve on its seat, a cam with lash.

Independent of the program, and of any library: absolute coordinate y of the valve (m, positive
open), Runge and Kutta's method of order 4 with a fixed step, switches located by bisection of the
step. Cam and seat press with k*p + b*p', cut off at zero. Prints each figure at two steps; what
the halving of the step changes is the error of the figure.
"""

import math

MASS, STIFFNESS, PSI = 0.3, 3.0e6, 0.5
RATE, PRELOAD = 40e3, 300.0
DAMPING = PSI * math.sqrt(STIFFNESS * MASS) / (2 * math.pi)
SEAT, SEAT_DAMPING = 2.0e7, 1500.0
BELOW, LIFT = -0.2e-3, 10.5e-3
RISE, DWELL, BACK = (math.radians(a) for a in (70, 4, 70))
SPEED, DURATION = 600 * 2 * math.pi / 60, 0.4


def smooth(tau):
    """4-5-6-7: value and slope."""
    value = tau**4 * (35 + tau * (-84 + tau * (70 - 20 * tau)))
    return value, 140 * (tau * (1 - tau)) ** 3


def law(t):
    """U and its rate."""
    phi = math.fmod(SPEED * t, 2 * math.pi)
    whole = LIFT - BELOW
    if phi < RISE:
        value, slope = smooth(phi / RISE)
        return BELOW + whole * value, whole * slope / RISE * SPEED
    if phi < RISE + DWELL:
        return LIFT, 0.0
    if phi < RISE + DWELL + BACK:
        value, slope = smooth(1 - (phi - RISE - DWELL) / BACK)
        return BELOW + whole * value, -whole * slope / BACK * SPEED
    return BELOW, 0.0


def cam(t, y, v):
    """Penetration of the cam and its force."""
    u, rate = law(t)
    return u - y, STIFFNESS * (u - y) + DAMPING * (rate - v)


def seat(y, v):
    """Penetration of the seat and its force."""
    return -y, -SEAT * y - SEAT_DAMPING * v


def touches(t, y, v):
    """(on the cam, on the seat) as the state says."""
    return min(cam(t, y, v)) > 0, min(seat(y, v)) > 0


def forces(t, y, v, mode):
    return (cam(t, y, v)[1] if mode[0] else 0.0, seat(y, v)[1] if mode[1] else 0.0)


def step(t, y, v, h, mode):
    def f(t, y, v):
        on_cam, on_seat = forces(t, y, v, mode)
        return v, (on_cam + on_seat - PRELOAD - RATE * y) / MASS

    a1, b1 = f(t, y, v)
    a2, b2 = f(t + h / 2, y + h / 2 * a1, v + h / 2 * b1)
    a3, b3 = f(t + h / 2, y + h / 2 * a2, v + h / 2 * b2)
    a4, b4 = f(t + h, y + h * a3, v + h * b3)
    return y + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), v + h / 6 * (b1 + 2 * b2 + 2 * b3 + b4)


def simulate(h):
    t, y, v = 0.0, -PRELOAD / (SEAT + RATE), 0.0
    mode = touches(t, y, v)
    assert mode == (False, True)
    found = dict.fromkeys(("closures", "approach", "time", "force"), 0.0)
    pair = dict.fromkeys(("closures", "approach", "force", "separations"), 0.0)
    depth = lift = 0.0
    # Steps end where the cam's formula changes.
    joints = [(a + 2 * math.pi * k) / SPEED for k in range(5) for a in (0, RISE, RISE + DWELL, RISE + DWELL + BACK)]
    joints = sorted(j for j in joints if 0 < j < DURATION) + [DURATION]
    for joint in joints:
        count = math.ceil((joint - t) / h)
        for left in range(count, 0, -1):
            whole = (joint - t) / left
            rest = whole
            while rest > 0:
                part = rest
                y1, v1 = step(t, y, v, part, mode)
                if touches(t + part, y1, v1) != mode:
                    low, high = 0.0, part
                    while high - low > 1e-15:
                        middle = (low + high) / 2
                        ym, vm = step(t, y, v, middle, mode)
                        low, high = (low, middle) if touches(t + middle, ym, vm) != mode else (middle, high)
                    part = high
                    y1, v1 = step(t, y, v, part, mode)
                if mode[1]:
                    found["time"] += part
                t, rest = t + part, rest - part
                y, v = y1, v1
                on_cam, on_seat = forces(t, y, v, mode)
                pair["force"], found["force"] = max(pair["force"], on_cam), max(found["force"], on_seat)
                depth, lift = max(depth, -y), max(lift, y)
                now = touches(t, y, v)
                if now != mode:
                    u, rate = law(t)
                    if now[1] and not mode[1]:
                        found["closures"] += 1
                        found["approach"] = max(found["approach"], -v)
                    if now[0] and not mode[0]:
                        pair["closures"] += 1
                        pair["approach"] = max(pair["approach"], rate - v)
                    if mode[0] and not now[0] and not now[1]:
                        pair["separations"] += 1
                    mode = now
                    on_cam, on_seat = forces(t, y, v, mode)
                    pair["force"], found["force"] = max(pair["force"], on_cam), max(found["force"], on_seat)
    return {
        "valve.seat.stop.closures": found["closures"],
        "valve.seat.stop.contact_time": found["time"],
        "valve.seat.stop.max_approach_speed": found["approach"],
        "valve.seat.stop.max_contact_force": found["force"],
        "valve.seat.stop.max_indentation": depth,
        "valve.pair.closures": pair["closures"],
        "valve.pair.separations": pair["separations"],
        "valve.pair.max_approach_speed": pair["approach"],
        "valve.pair.max_contact_force": pair["force"],
        "greatest lift of the valve": lift,
        "valve.final.displacement": y,
        "valve.final.speed": v,
    }


if __name__ == "__main__":
    coarse, fine = simulate(2e-6), simulate(1e-6)
    for name in fine:
        print(f"{name:36} {fine[name]:.15g}  +- {abs(fine[name] - coarse[name]):.1e}")
