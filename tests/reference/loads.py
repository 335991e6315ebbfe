#!/usr/bin/env python3
"""Figures of scenarios/loads: closed forms, and absolute coordinates with Runge and Kutta's method at
fixed steps, refined by Richardson's extrapolation. Prints what the scenes expect."""

from math import cos, pi, sin, sqrt


def shaken_lever():
    """J phi'' + c phi = F sin(w t) from rest."""
    inertia, stiffness, force, w = 0.02, 800.0, 12.0, 2 * pi * 25
    w0 = sqrt(stiffness / inertia)
    scale = force / inertia / (w0 * w0 - w * w)

    def angle(t):
        return scale * (sin(w * t) - w / w0 * sin(w0 * t))

    def speed(t):
        return scale * w * (cos(w * t) - cos(w0 * t))

    end = 0.13
    # Extremes where both cosines are alike: w t = 2 pi k +- w0 t.
    times = [2 * pi * k / (w0 + s * w) for k in range(1, 20) for s in (-1, 1)]
    times = [t for t in times if 0 < t < end] + [end]
    print("lever.delta_max", max(angle(t) for t in times))
    print("lever.delta_min", min(angle(t) for t in times))
    print("lever.final.displacement", angle(end))
    print("lever.final.speed", speed(end))


def stepped_torque():
    """Pieces of constant acceleration, cut at times and at angles."""
    inertia, end = 0.1, 1.2

    def torque(t, angle):
        own = 2 * int(4 * t) + 1 if t < 0.8 else -5
        return own + (-3 if abs(angle - 8) < 1 else 0)

    time, angle, speed = 0.0, 0.0, 0.0
    cuts = [0.25, 0.5, 0.75, 0.8, end]
    greatest = 0.0
    for cut in cuts:
        while time < cut - 1e-15:
            a = torque(time + 1e-12, angle + 1e-9 * (1 if speed >= 0 else -1)) / inertia
            step = cut - time
            for edge in (7.0, 9.0):
                # angle + speed s + a s^2/2 = edge, the least s above rounding.
                root = speed * speed - 2 * a * (angle - edge)
                if root < 0:
                    continue
                for sign in (-1, 1):
                    s = (-speed + sign * sqrt(root)) / a
                    if 1e-10 < s < step:
                        step = s
            angle += step * (speed + 0.5 * a * step)
            speed += a * step
            time += step
            greatest = max(greatest, speed)
    print("motor.peak_speed", greatest)
    print("motor.final.displacement", angle)
    print("motor.final.speed", speed)


def relaxation():
    """A weight on a rotor, moved by a motor whose torque is an expression of its own motion:
    phi'' = 2 (1 - phi^2) phi' - phi, van der Pol's oscillator, from phi = 2 at rest."""

    def rate(y):
        return (y[1], 2 * (1 - y[0] * y[0]) * y[1] - y[0])

    def run(count):
        h, y = 10.0 / count, (2.0, 0.0)
        for _ in range(count):
            k1 = rate(y)
            k2 = rate((y[0] + h / 2 * k1[0], y[1] + h / 2 * k1[1]))
            k3 = rate((y[0] + h / 2 * k2[0], y[1] + h / 2 * k2[1]))
            k4 = rate((y[0] + h * k3[0], y[1] + h * k3[1]))
            y = tuple(y[i] + h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]) for i in (0, 1))
        return y

    coarse, fine = run(20000), run(40000)
    for i, name in enumerate(("displacement", "speed")):
        print("rotor.final." + name, fine[i] + (fine[i] - coarse[i]) / 15)


def four_stroke():
    """Crosshead at constant speed under a pressure over two turns: W = (p - p0) A, reaction m x'' - W."""
    r, l, mass, speed, area, ambient = 0.045, 0.16, 0.82, 1500 * 2 * pi / 60, -0.005, 1e5
    points = [(0, 20), (30, 35), (120, 4), (180, 1.2), (540, 1), (660, 6), (720, 20)]

    def force(turned):
        degrees = turned % 720
        for (a, p), (b, q) in zip(points, points[1:]):
            if degrees <= b:
                return (1e5 * (p + (q - p) * (degrees - a) / (b - a)) - ambient) * area

    def acceleration(phi):
        # x = r cos phi + sqrt(l^2 - r^2 sin^2 phi), differentiated twice.
        root = sqrt(l * l - (r * sin(phi)) ** 2)
        second = -r * cos(phi) - r * r * cos(2 * phi) / root - (r * r * sin(phi) * cos(phi)) ** 2 / root**3
        return speed * speed * second

    def reaction(degrees):
        return mass * acceleration(degrees * pi / 180) - force(degrees)

    best = max(range(720000), key=lambda k: abs(reaction(k / 1000)))
    low, high = (best - 1) / 1000, (best + 1) / 1000
    for _ in range(100):
        a, b = (2 * low + high) / 3, (low + 2 * high) / 3
        low, high = (a, high) if abs(reaction(a)) < abs(reaction(b)) else (low, b)
    print("crosshead.peak_reaction", abs(reaction(low)))


def written_feed():
    """x'' + k^2 d = -a(t), a = A sin(2 pi t/T) up to T, then free: deviation of an undamped slide
    behind a cycloid of 40 mm in 0.2 s."""
    k, lift, rise, end = 100.0, 0.04, 0.2, 0.25
    n = 2 * pi / rise
    a = lift * n / rise

    def rising(t):
        scale = -a / (k * k - n * n)
        return (
            scale * (sin(n * t) - n / k * sin(k * t)),
            scale * n * (cos(n * t) - cos(k * t)),
        )

    d, v = rising(rise)
    left = end - rise
    print("slide.final.delta", d * cos(k * left) + v / k * sin(k * left))
    print("slide.final.displacement", lift + d * cos(k * left) + v / k * sin(k * left))
    print("slide.final.speed", v * cos(k * left) - d * k * sin(k * left))
    times = [2 * pi * j / (k + s * n) for j in range(1, 40) for s in (-1, 1)]
    times = [t for t in times if 0 < t < rise]
    free = sqrt(d * d + (v / k) ** 2)
    print("free amplitude", free)
    print("slide.delta_max", max([rising(t)[0] for t in times] + [free]))
    print("slide.delta_min", min([rising(t)[0] for t in times] + [-free]))


def ram_over_machine_angle():
    """Energy of a flywheel between dead centres; the window of the machine angle 480 to 660 deg is 120 to 165
    deg of the crank."""
    crank, rod, wheel, gear, ram, ratio, start, force = 0.1, 0.4, 50.0, 0.8, 30.0, 0.25, 20.0, 20e3

    def place(phi):
        return crank * cos(phi) + sqrt(rod * rod - (crank * sin(phi)) ** 2)

    def rate(phi):
        root = sqrt(rod * rod - (crank * sin(phi)) ** 2)
        return -crank * sin(phi) - crank * crank * sin(phi) * cos(phi) / root

    inertia = wheel + gear * ratio * ratio
    energy = inertia * start * start
    begin, end = 2 * pi / 3, 11 * pi / 12
    # The ram is slower and slower beyond the start of the window.
    there = sqrt(energy / (inertia + ram * (rate(begin) * ratio) ** 2))
    print("ram.peak_speed from 120 deg to 165 deg of gear", abs(rate(begin)) * ratio * there)
    print("main.final.speed", sqrt((energy + 2 * force * (place(end) - place(begin))) / inertia))


if __name__ == "__main__":
    four_stroke()
    written_feed()
    shaken_lever()
    stepped_torque()
    relaxation()
    ram_over_machine_angle()
