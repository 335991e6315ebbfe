"""Reference figures of the linkages with cams in scenarios/linkages: eccentric_cam, cam_on_a_coupler,
roller_on_a_fixed_cam. Needs mpmath.

Coordinates are others than those of the program: the eccentric circle is a four-bar in closed form;
pitch curves are given by a parameter as points of the plane and met by Newton's method; statics are
free-body balances of single links; motions follow from energy and a quadrature over the angle.
"""

from mpmath import acos, atan2, cos, diff, findroot, hypot, mp, mpf, pi, quad, sin, sqrt

mp.dps = 30
GRAVITY = mpf("9.80665")


def show(name, value):
    print(name, mp.nstr(value, 17))


def greatest(f, parts=360):
    """The greatest value over a turn: looked for, then refined."""
    near = max((2 * pi * k / parts for k in range(parts)), key=f)
    return f(findroot(lambda q: diff(f, q), near))


def turned(point, angle):
    x, y = point
    return x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)


def meeting(a, b, one, other):
    """Where circles about a and b meet, to the left of the way from a to b."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    apart = hypot(dx, dy)
    along = (one**2 - other**2 + apart**2) / (2 * apart)
    across = sqrt(one**2 - along**2)
    return a[0] + (along * dx - across * dy) / apart, a[1] + (along * dy + across * dx) / apart


def eccentric_cam():
    """A circle about a point beside the axis: crank, coupler (both radii), lever, frame."""
    crank, coupler, lever, frame = map(mpf, ("0.015", "0.06", "0.08", "0.1"))
    moment, couple, speed, duration = mpf("0.002"), mpf("1.5"), 10 * pi, mpf("0.07")
    pin = frame, mpf(0)

    def points(q):
        centre = crank * cos(q), crank * sin(q)
        return centre, meeting(centre, pin, coupler, lever)

    def angle(q):
        _, roller = points(q)
        return atan2(roller[1], roller[0] - frame)

    q = speed * duration
    show("lever.final.displacement", angle(q))
    show("lever.final.speed", speed * diff(angle, q))
    highest = greatest(angle)
    lowest = -greatest(lambda q: -angle(q))
    show("lever.stroke", highest - lowest)
    # Extremes by the triangles with crank and coupler in line.
    reach = lambda r: acos((lever**2 + frame**2 - r**2) / (2 * lever * frame))
    show("lever.stroke (triangles)", reach(coupler + crank) - reach(coupler - crank))

    def force(q):
        """About the lever's pin: moment*a = couple + force*arm."""
        centre, roller = points(q)
        nx, ny = (roller[0] - centre[0]) / coupler, (roller[1] - centre[1]) / coupler
        arm = (roller[0] - frame) * ny - roller[1] * nx
        return (moment * speed**2 * diff(angle, q, 2) - couple) / arm

    show("K.force.greatest", greatest(force))
    show("K.force.least", -greatest(lambda q: -force(q)))
    drive = lambda q: (moment * speed**2 * diff(angle, q, 2) - couple) * diff(angle, q)
    show("drive.greatest", greatest(drive))
    show("drive.least", -greatest(lambda q: -drive(q)))


def cam_on_a_coupler():
    """A four-bar; its coupler carries a cam of three lobes on which a slide stands by its weight."""
    crank, rod, rocker = mpf("0.05"), mpf("0.2"), mpf("0.15")
    pin = mpf("0.18"), mpf(0)
    centre, prime, lobe = (mpf("0.15"), mpf("0.02")), mpf("0.1"), mpf("0.004")
    guide, slide, wheel = mpf("0.1"), mpf(2), mpf("0.4")
    rod_mass, rod_moment, rod_centre = mpf("0.6"), mpf("0.003"), (mpf("0.1"), mpf("0.01"))

    def coupler(q):
        a = crank * cos(q), crank * sin(q)
        b = meeting(a, pin, rod, rocker)
        return a, atan2(b[1] - a[1], b[0] - a[0])

    def placed(q, point):
        a, angle = coupler(q)
        x, y = turned(point, angle)
        return a[0] + x, a[1] + y

    def pitch(q, t):
        """The point of the pitch curve with the parameter t."""
        radius = prime + lobe * sin(3 * t)
        return placed(q, (centre[0] + radius * cos(t), centre[1] + radius * sin(t)))

    def parameter(q):
        """Where the pitch curve crosses the guide, above."""
        _, angle = coupler(q)
        x, _ = placed(q, centre)
        near = acos((guide - x) / prime) - angle
        return findroot(lambda t: pitch(q, t)[0] - guide, near)

    def height(q):
        return pitch(q, parameter(q))[1]

    def along(q, t):
        """Direction of the tangent in the plane."""
        dx = diff(lambda s: pitch(q, s)[0], t)
        dy = diff(lambda s: pitch(q, s)[1], t)
        return dx / hypot(dx, dy), dy / hypot(dx, dy)

    def inertia(q):
        vx, vy = (diff(lambda q: placed(q, rod_centre)[axis], q) for axis in (0, 1))
        turning = diff(lambda q: coupler(q)[1], q)
        own = rod_mass * (vx**2 + vy**2) + rod_moment * turning**2
        return wheel + own + slide * diff(height, q) ** 2

    def potential(q):
        return GRAVITY * (slide * height(q) + rod_mass * placed(q, rod_centre)[1])

    speed = 2 * pi

    def force(q):
        """The slide alone, along its guide: its normal has the component -tangent_x upwards."""
        ux, _ = along(q, parameter(q))
        return slide * (GRAVITY + speed**2 * diff(height, q, 2)) / abs(ux)

    mp.dps = 22
    show("slide.stroke", greatest(height) + greatest(lambda q: -height(q)))
    show("K.force.greatest", greatest(force))
    show("K.force.least", -greatest(lambda q: -force(q)))
    # At constant speed: virtual power.
    drive = lambda q: diff(potential, q) + speed**2 * diff(inertia, q) / 2
    show("drive.greatest", greatest(drive))
    # For the program's own tests.
    show("K.force at 1 rad", force(mpf(1)))
    show("drive at 1 rad", drive(mpf(1)))

    start = speed
    energy = inertia(mpf(0)) * start**2 / 2 + potential(mpf(0))
    torque = 2
    rate = lambda q: sqrt(2 * (energy + torque * q - potential(q)) / inertia(q))
    end = mpf(6)
    mp.dps = 20
    time = quad(lambda q: 1 / rate(q), [end * k / 10 for k in range(11)])
    # The scene ends after 0.8 s: Newton's method on the angle from there.
    duration = mpf("0.8")
    for _ in range(4):
        step = (duration - time) * rate(end)
        time += quad(lambda q: 1 / rate(q), [end, end + step])
        end += step
    show("motor.final.displacement", end)
    show("motor.final.speed", rate(end))
    show("slide.final.displacement", height(end))
    show("slide.final.speed", rate(end) * diff(height, end))


def roller_on_a_fixed_cam():
    """A lever on a driven arm; its roller runs round an oval that stands still, held by a couple."""
    arm, lever = mpf("0.05"), mpf("0.08")
    prime, oval = mpf("0.09"), mpf("0.006")
    moment, couple, speed, duration = mpf("0.0005"), mpf("0.8"), 4 * pi, mpf("0.3")

    def pitch(t):
        radius = prime + oval * sin(2 * t)
        return radius * cos(t), radius * sin(t)

    def pin(q):
        return arm * cos(q), arm * sin(q)

    def parameter(q):
        """The point of the curve at the lever's distance from the pin, ahead of the arm."""
        near = acos((arm**2 + prime**2 - lever**2) / (2 * arm * prime)) + q
        x, y = pin(q)
        far = lambda t: (pitch(t)[0] - x) ** 2 + (pitch(t)[1] - y) ** 2 - lever**2
        return findroot(far, near)

    def angle(q):
        """Of the lever, over whole turns: from that of the arm on."""
        x, y = pin(q)
        px, py = pitch(parameter(q))
        dx, dy = turned((px - x, py - y), -q)
        return q + atan2(dy, dx)

    q = speed * duration
    show("lever.final.displacement", angle(q))
    show("lever.final.speed", speed * diff(angle, q))
    show("lever.final.acceleration", speed**2 * diff(angle, q, 2))

    def force(q):
        t = parameter(q)
        dx, dy = diff(lambda t: pitch(t)[0], t), diff(lambda t: pitch(t)[1], t)
        nx, ny = dy / hypot(dx, dy), -dx / hypot(dx, dy)
        x, y = pin(q)
        px, py = pitch(t)
        lever_arm = (px - x) * ny - (py - y) * nx
        return (moment * speed**2 * diff(angle, q, 2) - couple) / lever_arm

    show("K.force.greatest", greatest(force))
    show("K.force.least", -greatest(lambda q: -force(q)))


if __name__ == "__main__":
    for figures in (eccentric_cam, cam_on_a_coupler, roller_on_a_fixed_cam):
        mp.dps = 30
        print(f"# {figures.__name__}")
        figures()
