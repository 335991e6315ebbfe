"""Reference figures of the linkages with couplings in scenarios/linkages: closed forms.

geared_five_bar, cardan_gears, rack_feed, planetary_gear, differential_gear. Needs mpmath.
"""

from mpmath import acos, atan2, cos, diff, exp, expm, findroot, hypot, matrix, mp, mpf, pi, sin, sqrt

mp.dps = 40


def show(name, value):
    print(name, mp.nstr(value, 17))


def greatest(f, parts=720):
    """The greatest value over a turn: looked for, then refined."""
    near = max((2 * pi * k / parts for k in range(parts)), key=f)
    return f(findroot(lambda q: diff(f, q), near))


def meeting(a, b, one, other):
    """Where circles about a and b meet, to the left of the way from a to b."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    apart = hypot(dx, dy)
    along = (one**2 - other**2 + apart**2) / (2 * apart)
    across = sqrt(one**2 - along**2)
    return a[0] + (along * dx - across * dy) / apart, a[1] + (along * dy + across * dx) / apart


def geared_five_bar():
    """Norton's proportions; the second crank turns twice as fast, 30 degrees ahead."""
    crank, rod, coupler, second, ground = map(mpf, ("0.01", "0.07", "0.09", "0.04", "0.06"))
    speed, duration = 2 * pi, mpf(1) / 6

    def pins(q):
        other = 2 * q + pi / 6
        b = ground + second * cos(other), second * sin(other)
        return (crank * cos(q), crank * sin(q)), b

    def ends(q):
        a, b = pins(q)
        return a, b, meeting(a, b, rod, coupler)

    q = speed * duration
    a, b, c = ends(q)
    angle = atan2(c[1] - a[1], c[0] - a[0])
    show("rod [deg]", angle * 180 / pi)
    show("coupler [deg]", atan2(c[1] - b[1], c[0] - b[0]) * 180 / pi)
    show("rod.final.displacement", angle)
    show("x.final.displacement", c[0])
    show("y.final.displacement", c[1])
    show("x.final.speed", speed * diff(lambda q: ends(q)[2][0], q))
    apart = lambda q: hypot(pins(q)[1][0] - pins(q)[0][0], pins(q)[1][1] - pins(q)[0][1])
    # The couplers are folded there.
    folded = lambda q: apart(q) - (coupler - rod)
    show("limits.upper", findroot(folded, (mpf("1"), mpf("1.2")), solver="anderson"))
    show("limits.lower", findroot(folded, (mpf("-5"), mpf("-4.9")), solver="anderson"))


def cardan_gears():
    """The mass sits on the straight line; of the planet the moments about its axis balance."""
    arm, mass, force, speed, duration = mpf("0.05"), 6, mpf(-900), 10 * pi, mpf("0.43")
    q = speed * duration
    show("tool.final.displacement", 2 * arm * cos(q))
    show("tool.peak_speed", 2 * arm * speed)
    show("tool.stroke", 4 * arm)
    along = lambda q: force + mass * 2 * arm * speed**2 * cos(q)
    # About the planet's axis: (force and inertia)*arm*sin q + (teeth)*arm = 0.
    teeth = lambda q: -along(q) * sin(q)
    show("mesh.force.greatest", greatest(teeth))
    show("mesh.force.least", -greatest(lambda q: -teeth(q)))
    drive = lambda q: along(q) * 2 * arm * sin(q)
    show("drive.greatest", greatest(drive))
    show("drive.least", -greatest(lambda q: -drive(q)))


def rack_feed():
    """A four-bar; the rack follows the rocker's angle."""
    crank, rod, rocker, radius, mass = map(mpf, ("0.04", "0.2", "0.09", "0.06", "4"))
    d, force, speed, duration = (mpf("0.19"), mpf("0.06")), mpf(-25), 4 * pi, mpf("0.71")
    ground = hypot(*d)

    def angle(q):
        a = crank * cos(q), crank * sin(q)
        b = meeting(a, d, rod, rocker)
        return atan2(b[1] - d[1], b[0] - d[0])

    q = speed * duration
    show("rack.final.displacement", radius * angle(q) - mpf("0.12"))
    show("rack.final.speed", radius * speed * diff(angle, q))
    at = lambda reach: acos((rocker**2 + ground**2 - reach**2) / (2 * rocker * ground))
    show("rack.stroke", radius * (at(rod + crank) - at(rod - crank)))
    teeth = lambda q: mass * radius * speed**2 * diff(angle, q, 2) - force
    show("mesh.force.greatest", greatest(teeth))
    show("mesh.force.least", -greatest(lambda q: -teeth(q)))


def planetary_gear():
    """J d(omega)/dt = M0 (1 - omega/omega0), everything reduced to the sun."""
    sun, planet, ring = 24, 18, 60
    carrier = mpf(sun) / (sun + ring)
    turning = carrier - (1 - carrier) * sun / planet
    inertia = mpf("0.02") + mpf("0.003") + mpf("0.0012") * turning**2
    inertia += carrier**2 * (mpf("0.05") + mpf("2.4") * mpf("0.063") ** 2)
    stall, idle, time = 12, 150, mpf("0.4")
    constant = inertia * idle / stall
    speed = idle * (1 - exp(-time / constant))
    angle = idle * (time - constant * (1 - exp(-time / constant)))
    show("motor.final.speed", speed)
    show("gear.carrier.final.speed", carrier * speed)
    show("gear.carrier.final.displacement", carrier * angle)
    show("gear.planet.final.displacement", turning * angle)


def differential_gear():
    """M dw/dt = T - D w on the speeds of sun and ring: M constant, T and D those of both motors."""
    sun, planet, ring = map(mpf, (24, 18, 60))
    carrier = matrix([sun / (sun + ring), ring / (sun + ring)])
    turning = carrier - (matrix([1, 0]) - carrier) * sun / planet
    masses = matrix([[mpf("0.023"), 0], [0, mpf("0.13")]])
    masses += carrier * carrier.T * (mpf("0.05") + mpf("2.4") * mpf("0.063") ** 2)
    masses += turning * turning.T * mpf("0.0012")
    stall, idle, time = matrix([12, -8]), matrix([150, -40]), mpf("0.4")
    inverse = masses**-1
    rates = inverse * matrix([[stall[0] / idle[0], 0], [0, stall[1] / idle[1]]])
    decay = expm(-rates * time)
    speed = idle - decay * idle
    angle = idle * time - rates**-1 * (idle - decay * idle)
    show("gear.sun.final.speed", speed[0])
    show("gear.ring.final.speed", speed[1])
    show("gear.carrier.final.speed", (carrier.T * speed)[0])
    show("gear.carrier.final.displacement", (carrier.T * angle)[0])
    show("gear.planet.final.displacement", (turning.T * angle)[0])


if __name__ == "__main__":
    for figures in (geared_five_bar, cardan_gears, rack_feed, planetary_gear, differential_gear):
        print(f"# {figures.__name__}")
        figures()
