"""Reference figures of scenarios/indexing/thread_guide.json: a thread guide with uniform sections.

One undamped mass behind a cam: d'' + k^2 d = -U''(t), solved in closed form over the pieces of U''
(constants and sines), each joined to the next. The law's pieces come from its definition alone:
the shapes of the acceleration of run-up and run-out, and their sizes from two conditions, equal
speeds at the uniform section and the whole stroke, by adding up exact integrals of the pieces.
Needs nothing but Python's own library.
"""

import json
import math
from pathlib import Path

HERE = Path(__file__).parent


def run_up(s1, s2, span):
    """Pieces (length, a, s, c, w) of a run-up's acceleration a + s sin wy + c cos wy, peak 1."""
    pieces = []
    if s1 > 0:
        pieces.append((s1 * span, 0.0, 1.0, 0.0, math.pi / (2 * s1 * span)))
    if 1 - s1 - s2 > 0:
        pieces.append(((1 - s1 - s2) * span, 1.0, 0.0, 0.0, 1.0))
    if s2 > 0:
        pieces.append((s2 * span, 0.0, 0.0, 1.0, math.pi / (2 * s2 * span)))
    return pieces


def reversed_pieces(pieces, sign):
    """The same diagram run backwards in time, times a sign."""
    turned = []
    for length, a, s, c, w in reversed(pieces):
        # s sin w(L - y) + c cos w(L - y) in sines and cosines of wy
        sin, cos = math.sin(w * length), math.cos(w * length)
        turned.append((length, sign * a, sign * (c * sin - s * cos), sign * (s * sin + c * cos), w))
    return turned


def integrate(pieces, x, v):
    """Position and speed at the end of pieces of acceleration, exactly."""
    for length, a, s, c, w in pieces:
        sin, cos = math.sin(w * length), math.cos(w * length)
        # x'' = a + s sin wy + c cos wy
        x += v * length + a * length**2 / 2 + s * (length / w - sin / w**2) + c * (1 - cos) / w**2
        v += a * length + s * (1 - cos) / w + c * sin / w
    return x, v


def sections(up, out, skewness, uniform, stroke, span):
    """Pieces of the acceleration of a stroke of run-up, uniform section and run-out."""
    rise = span * (1 - uniform) / (1 + skewness)
    fall = skewness * rise
    first, last = run_up(*up, rise), reversed_pieces(run_up(*out, fall), -1.0)
    gained_x, gained_v = integrate(first, 0.0, 0.0)
    lost_x, lost_v = integrate(last, 0.0, 0.0)
    # Sizes A, B: A gained_v + B lost_v = 0 (rest at the end) and the stroke:
    # A gained_x + A gained_v (uniform span + fall) + B lost_x = stroke.
    ratio = -gained_v / lost_v
    size = stroke / (gained_x + gained_v * (uniform * span + fall) + ratio * lost_x)
    scaled = lambda pieces, k: [(l, k * a, k * s, k * c, w) for l, a, s, c, w in pieces]
    middle = [(uniform * span, 0.0, 0.0, 0.0, 1.0)] if uniform > 0 else []
    pieces = scaled(first, size) + middle + scaled(last, ratio * size)
    x, v = integrate(pieces, 0.0, 0.0)
    assert abs(x - stroke) < 1e-15 and abs(v) < 1e-13, (x, v)
    return pieces


def thread_guide():
    mass, stiffness, stroke, end = 0.6, 9.0e4, 0.15, 0.29
    omega = 200 * 2 * math.pi / 60
    wait, rise, dwell, back = (math.radians(angle) / omega for angle in (30, 150, 20, 140))
    k = math.sqrt(stiffness / mass)
    up = sections((0.125, 0.5), (0.0, 1.0), 1.4, 0.3, stroke, rise)
    # The return runs its law backwards: modified sine halves, half of the time uniform.
    down = reversed_pieces(sections((0.25, 0.75), (0.25, 0.75), 1.0, 0.5, stroke, back), 1.0)
    rest = end - wait - rise - dwell - back
    assert rest > 0
    still = lambda length: [(length, 0.0, 0.0, 0.0, 1.0)]
    d, v, found = 0.0, 0.0, [0.0]
    for length, a, s, c, w in up + still(dwell) + down + still(rest):

        def state(y, d=d, v=v, a=a, s=s, c=c, w=w):
            n = k * k - w * w
            particular = -(a / k**2 + (s * math.sin(w * y) + c * math.cos(w * y)) / n)
            rate = -(s * math.cos(w * y) - c * math.sin(w * y)) * w / n
            d0, v0 = d + a / k**2 + c / n, v + s * w / n
            return (
                particular + d0 * math.cos(k * y) + v0 / k * math.sin(k * y),
                rate + v0 * math.cos(k * y) - d0 * k * math.sin(k * y),
            )

        steps = 2000
        speeds = [state(length * j / steps)[1] for j in range(steps + 1)]
        for j in range(steps):
            if speeds[j] * speeds[j + 1] < 0:
                low, high = length * j / steps, length * (j + 1) / steps
                for _ in range(80):
                    middle = (low + high) / 2
                    if speeds[j] * state(middle)[1] > 0:
                        low = middle
                    else:
                        high = middle
                found.append(state(low)[0])
        d, v = state(length)
        found.append(d)
    return {
        "guide.delta_max": max(found),
        "guide.delta_min": min(found),
        "guide.peak_reaction": stiffness * max(abs(x) for x in found),
        "guide.peak_acceleration": k**2 * max(abs(x) for x in found),
        "guide.final.displacement": d,
        "guide.final.speed": v,
    }


if __name__ == "__main__":
    figures = thread_guide()
    scene = {name: {"value": value, "spread": 0.0} for name, value in figures.items()}
    document = {"about": __doc__.strip().splitlines()[0], "scenes": {"thread_guide": scene}}
    (HERE / "thread_guide.json").write_text(json.dumps(document, indent=1) + "\n")
    for name, value in figures.items():
        print(f"{name:32s} {value!r}")
