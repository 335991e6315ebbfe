"""Reference figures of scenarios/cams: motion, contact force, pressure angle and curvature of cams.

Needs nothing but Python's own library. Laws of motion from their definitions (the sections of a
stroke from the shapes of their accelerations and two conditions, as in thread_guide.py). The pitch
curve is written in complex numbers: z(phi) = B(phi) exp(-i phi) with the centre of the roller
B(phi) in the machine, z', z'' by the product rule; its curvature is -Im(conj(z') z'')/|z'|^3
(clockwise and convex: positive), the pressure angle that between the normal i z' and the velocity
of the roller. Extremes by dense sampling and golden section.
"""

import cmath
import json
import math
from pathlib import Path

HERE = Path(__file__).parent
PI = math.pi
TAU = 2 * PI


# Laws: (theta, theta', theta'') over 0 ... 1.
def polynomial345(t):
    return (10 * t**3 - 15 * t**4 + 6 * t**5, 30 * t**2 - 60 * t**3 + 30 * t**4, 60 * t - 180 * t**2 + 120 * t**3)


def cycloidal(t):
    w = TAU
    return (t - math.sin(w * t) / w, 1 - math.cos(w * t), w * math.sin(w * t))


def from_pieces(pieces):
    """The law with acceleration pieces (length, a, s, c, w): a + s sin wy + c cos wy, scaled to stroke 1."""

    def run(pieces, until):
        x = v = acc = 0.0
        for length, a, s, c, w in pieces:
            y = min(length, until)
            sin, cos = math.sin(w * y), math.cos(w * y)
            x += v * y + a * y * y / 2 + s * (y / w - sin / w**2) + c * (1 - cos) / w**2
            v += a * y + s * (1 - cos) / w + c * sin / w
            acc = a + s * sin + c * cos
            until -= y
            if until <= 0:
                break
        return x, v, acc

    total = run(pieces, 1.0)[0]
    return lambda t: tuple(part / total for part in run(pieces, t))


def modified_trapezoid():
    w = 4 * PI
    rise = (0.125, 0.0, 1.0, 0.0, w)
    flat = (0.25, 1.0, 0.0, 0.0, 1.0)
    fall = (0.25, 0.0, 0.0, 1.0, w)
    return from_pieces([rise, flat, fall, (0.25, -1.0, 0.0, 0.0, 1.0), (0.125, 0.0, 0.0, -1.0, w)])


def sections(up, out, skewness, uniform):
    """Run-up, uniform section, run-out; `up`, `out`: shares s1, s2 of the modified trapezoid."""

    def run_up(s1, s2, span):
        pieces = []
        if s1 > 0:
            pieces.append((s1 * span, 0.0, 1.0, 0.0, PI / (2 * s1 * span)))
        if 1 - s1 - s2 > 0:
            pieces.append(((1 - s1 - s2) * span, 1.0, 0.0, 0.0, 1.0))
        if s2 > 0:
            pieces.append((s2 * span, 0.0, 0.0, 1.0, PI / (2 * s2 * span)))
        return pieces

    def gained(pieces):
        return sum(l * a + s * (1 - math.cos(w * l)) / w + c * math.sin(w * l) / w for l, a, s, c, w in pieces)

    rise = (1 - uniform) / (1 + skewness)
    first, last = run_up(*up, rise), run_up(*out, skewness * rise)
    ratio = gained(first) / gained(last)
    turned = []
    for l, a, s, c, w in reversed(last):
        sin, cos = math.sin(w * l), math.cos(w * l)
        turned.append((l, -ratio * a, -ratio * (c * sin - s * cos), -ratio * (s * sin + c * cos), w))
    middle = [(uniform, 0.0, 0.0, 0.0, 1.0)] if uniform > 0 else []
    return from_pieces(first + middle + turned)


def motion(stations):
    """s, s', s'' over phi from (from, to, start, stroke, law, backwards)."""

    def at(phi):
        phi = phi % TAU
        for start, end, base, stroke, law, backwards in stations:
            if start <= phi <= end:
                if law is None:
                    return (base, 0.0, 0.0)
                span = end - start
                t = (phi - start) / span
                value, first, second = law(1 - t) if backwards else law(t)
                sign = -1.0 if backwards else 1.0
                return (base + stroke * value, sign * stroke * first / span, stroke * second / span**2)
        raise ValueError(phi)

    return at


def greatest(f, edges):
    """Greatest value of f over the pieces between edges, and where."""
    best = (-math.inf, 0.0)
    for a, b in zip(edges, edges[1:]):
        inner = 1e-12 * (b - a)
        places = [a + inner + (b - a - 2 * inner) * k / 2000 for k in range(2001)]
        values = [f(x) for x in places]
        k = max(range(2001), key=lambda k: values[k])
        best = max(best, (values[k], places[k]))
        low, high = places[max(k - 1, 0)], places[min(k + 1, 2000)]
        ratio = (math.sqrt(5) - 1) / 2
        for _ in range(80):
            x, y = high - ratio * (high - low), low + ratio * (high - low)
            if f(x) >= f(y):
                high = y
            else:
                low = x
        best = max(best, (f((low + high) / 2), (low + high) / 2))
    return best


def translating(s, s0, offset):
    """z', z'' and velocity of the roller over phi: B = offset + i (s0 + s)."""

    def at(phi):
        value, first, second = s(phi)
        b, b1, b2 = offset + 1j * (s0 + value), 1j * first, 1j * second
        turn = cmath.exp(-1j * phi)
        return (b1 - 1j * b) * turn, (b2 - 2j * b1 - b) * turn, 1j * turn

    return at


def turning(s, start, distance, arm):
    """The same for an arm about (distance, 0), swinging against the cam: B = d - l exp(-i psi)."""

    def at(phi):
        value, first, second = s(phi)
        e = cmath.exp(-1j * (start + value))
        b = distance - arm * e
        b1 = 1j * arm * first * e
        b2 = (1j * second + first**2) * arm * e
        turn = cmath.exp(-1j * phi)
        return (b1 - 1j * b) * turn, (b2 - 2j * b1 - b) * turn, 1j * e * turn

    return at


def geometry(curve, edges):
    """Greatest and least pressure angle, greatest curvature."""

    def pressure(phi):
        z1, _, out = curve(phi)
        # From the normal i z' to the velocity, positive where the velocity has a share along z'.
        return cmath.phase(1j * z1 / out)

    def curvature(phi):
        z1, z2, _ = curve(phi)
        return -(z1.conjugate() * z2).imag / abs(z1) ** 3

    high, low = greatest(pressure, edges), greatest(lambda phi: -pressure(phi), edges)
    sharp = greatest(curvature, edges)
    return {
        "pressure_greatest": high[0],
        "pressure_least": -low[0],
        "pitch_convex": 1 / sharp[0],
    }


def eccentric_jump():
    """m u'' + b u' + (c + k) u = -m U'' - P - k U, U = e (1 - cos wt): the steady solution."""
    m, e, k, p, c, w = 1.0, 0.02, 10.0, 0.2, 1e6, 52 * TAU / 60
    b = 0.5 * math.sqrt(c * m) / TAU
    mean = c * (p + k * e) / (c + k)
    swing = abs(complex(c, b * w) * e * (k - m * w * w) / complex(c + k - m * w * w, b * w))
    return {
        "figures": {
            "follower.pair.max_contact_force": mean + swing,
            "follower.pair.separations": 0,
            "follower.pair.in_working_order": 1,
        },
        "cam": {
            # w^2 = (2 k e + P)/(m e)
            "lets_go": math.sqrt((2 * k * e + p) / (m * e)),
            "lets_go_rpm": math.sqrt((2 * k * e + p) / (m * e)) * 60 / TAU,
            "profile_convex": 0.03 + e,
            "needed_width": 2 * e,
            "margin": p + 2 * k * e - m * e * w * w,
        },
    }


def yarn_traverse():
    """0.4 kg, 60 mm there and back in half a turn each, half of the stroke uniform, 300 rpm."""
    stroke, w, mass, pull = 0.06, 300 * TAU / 60, 0.4, 3.0
    law = sections((0.25, 0.25), (0.25, 0.25), 1.0, 1 / 3)
    s = motion([(0, PI, 0, stroke, law, False), (PI, TAU, 0, stroke, law, True)])
    # The example of the text: Pi'max -25 %, Pi''max +12.5 % against no uniform section.
    speed = 0.75 * 2 * stroke / PI * w
    acceleration = 1.125 * 2 * 4 * PI / (PI + 2) * stroke / PI**2 * w * w
    edges = [PI * k / 12 for k in range(25)]
    assert abs(greatest(lambda x: s(x)[1], edges)[0] * w - speed) < 1e-12 * speed
    assert abs(greatest(lambda x: s(x)[2], edges)[0] * w * w - acceleration) < 1e-12 * acceleration
    cam = geometry(translating(s, 0.055, 0.0), edges)
    torque = greatest(lambda x: (mass * s(x)[2] * w * w + pull) * s(x)[1], edges)[0]
    return {
        "figures": {
            "guide.peak_speed": speed,
            "guide.peak_acceleration": acceleration,
            "guide.peak_reaction": mass * acceleration + pull,
        },
        "cam": {**cam, "torque": torque},
    }


def flat_tappet():
    """100 g, lift 9 mm in 70 + 70 deg, run-up 17.5 deg, cosine nose; 25 N/mm, 160 N, 3000 rpm."""
    lift, span, w, mass, rate, preload, base = 0.009, 70 * PI / 180, 3000 * TAU / 60, 0.1, 25e3, 160.0, 0.017
    law = sections((0.25, 0.25), (0.0, 1.0), 3.0, 0.0)
    s = motion(
        [(0, span, 0, lift, law, False), (span, 2 * span, 0, lift, law, True), (2 * span, TAU, 0, 0, None, False)]
    )
    quarter = span / 4
    edges = [0, quarter / 4, 3 * quarter / 4, quarter, span, 2 * span - quarter]
    edges += [2 * span - 3 * quarter / 4, 2 * span - quarter / 4, 2 * span, TAU]
    force = lambda x: mass * s(x)[2] * w * w + preload + rate * s(x)[0]
    least = -greatest(lambda x: -force(x), edges)[0]
    radius = lambda x: base + s(x)[0] + s(x)[2]
    return {
        "figures": {
            "valve.peak_speed": greatest(lambda x: s(x)[1], edges)[0] * w,
            "valve.peak_acceleration": greatest(lambda x: abs(s(x)[2]), edges)[0] * w * w,
            "valve.pair.max_contact_force": greatest(force, edges)[0],
            "valve.pair.margin": least,
        },
        "cam": {
            "profile_convex": -greatest(lambda x: -radius(x), edges)[0],
            "needed_width": 2 * greatest(lambda x: abs(s(x)[1]), edges)[0],
            "margin": least,
            "lets_go": 1
            / math.sqrt(greatest(lambda x: -mass * s(x)[2] / (preload + rate * s(x)[0]), edges)[0]),
        },
    }


def indexing_dwells():
    """J 2e-3 kg m^2, 10 and 12 deg of index in 60 deg each, back in 90 deg; 8 N m/rad, 3 N m, 400 rpm."""
    w, inertia, rate, preload = 400 * TAU / 60, 2e-3, 8.0, 3.0
    degree = PI / 180
    back = modified_trapezoid()
    s = motion(
        [
            (0, 60 * degree, 0, 10 * degree, polynomial345, False),
            (60 * degree, 120 * degree, 10 * degree, 0, None, False),
            (120 * degree, 180 * degree, 10 * degree, 12 * degree, cycloidal, False),
            (180 * degree, 240 * degree, 22 * degree, 0, None, False),
            (240 * degree, 330 * degree, 0, 22 * degree, back, True),
            (330 * degree, TAU, 0, 0, None, False),
        ]
    )
    edges = [0, 60, 120, 180, 240] + [240 + 90 * k / 8 for k in (1, 3, 5, 7)] + [330, 360]
    edges = [edge * degree for edge in edges]
    force = lambda x: inertia * s(x)[2] * w * w + preload + rate * s(x)[0]
    distance, arm, prime, roller = 0.09, 0.07, 0.038, 0.008
    start = math.acos((distance**2 + arm**2 - prime**2) / (2 * distance * arm))
    cam = geometry(turning(s, start, distance, arm), edges)
    return {
        "figures": {
            "table.peak_speed": greatest(lambda x: abs(s(x)[1]), edges)[0] * w,
            "table.peak_acceleration": greatest(lambda x: abs(s(x)[2]), edges)[0] * w * w,
            "table.pair.max_contact_force": greatest(force, edges)[0],
            "table.pair.margin": -greatest(lambda x: -force(x), edges)[0],
        },
        "cam": {
            **cam,
            "profile_convex": cam["pitch_convex"] - roller,
            "torque": greatest(lambda x: force(x) * s(x)[1], edges)[0],
            "lets_go": 1
            / math.sqrt(greatest(lambda x: -inertia * s(x)[2] / (preload + rate * s(x)[0]), edges)[0]),
        },
    }


if __name__ == "__main__":
    found = {
        "note": "By tests/reference/cams.py: closed forms in double precision, extremes by golden section; 1e-10 relative.",
        "eccentric_jump": eccentric_jump(),
        "yarn_traverse": yarn_traverse(),
        "flat_tappet": flat_tappet(),
        "indexing_dwells": indexing_dwells(),
    }
    (HERE / "cams.json").write_text(json.dumps(found, indent=2) + "\n")
