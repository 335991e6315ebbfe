"""Figures of scenarios/linkages/toggle_press: an elastic tool behind the ram of a toggle press.

Loop closure by circles and lines, velocities from rigid bars, the tool in its absolute
coordinate: m x'' = -c (x - U) - b (x' - U') + W(U), by the classical Runge-Kutta method.
Needs nothing but Python. Writes the entry `toggle_press` of linkages.json.
"""

import json
import math
import pathlib

CRANK, ROD, UPPER, LOWER, SIDE, HEIGHT = 0.05, 0.2, 0.2, 0.2, 0.25, 0.18
SPEED = 150 * 2 * math.pi / 60
MASS, STIFFNESS, CAPACITY = 20.0, 4e7, 0.2
DAMPING = CAPACITY * math.sqrt(STIFFNESS * MASS) / (2 * math.pi)
POINTS = [(0.19, 0.0), (0.22, -40000.0)]
DURATION = 0.8


def ram(t):
    """Displacement of the ram downwards and its speed."""
    q = SPEED * t
    ax, ay = CRANK * math.cos(q), CRANK * math.sin(q)
    vax, vay = -SPEED * ay, SPEED * ax
    dx, dy = SIDE - ax, HEIGHT - ay
    d2 = dx * dx + dy * dy
    d = math.sqrt(d2)
    along = (ROD * ROD - UPPER * UPPER + d2) / (2 * d)
    off = math.sqrt(ROD * ROD - along * along)
    # Of the two crossings of the circles the one below the line from A to P.
    kx = ax + (along * dx + off * dy) / d
    ky = ay + (along * dy - off * dx) / d
    rx, ry = kx - ax, ky - ay
    ux, uy = kx - SIDE, ky - HEIGHT
    # (K - A).(vK - vA) = 0, (K - P).vK = 0
    right = rx * vax + ry * vay
    det = rx * uy - ry * ux
    vkx, vky = right * uy / det, -right * ux / det
    px = SIDE - kx
    depth = math.sqrt(LOWER * LOWER - px * px)
    # y of the ram = ky - depth; its speed from the lower bar.
    vy = vky + px * vkx / depth * -1.0
    return depth - ky, -vy


def load(u):
    (a, fa), (b, fb) = POINTS
    if u <= a:
        return fa
    if u >= b:
        return fb
    return fa + (fb - fa) * (u - a) / (b - a)


def acceleration(x, v, at):
    u, du = at
    return (-STIFFNESS * (x - u) - DAMPING * (v - du) + load(u)) / MASS


def run(steps):
    h = DURATION / steps
    here = ram(0.0)
    x, v = here
    top, bottom = 0.0, 0.0
    for i in range(steps):
        middle, end = ram((i + 0.5) * h), ram((i + 1) * h)
        k1, l1 = v, acceleration(x, v, here)
        k2 = v + 0.5 * h * l1
        l2 = acceleration(x + 0.5 * h * k1, k2, middle)
        k3 = v + 0.5 * h * l2
        l3 = acceleration(x + 0.5 * h * k2, k3, middle)
        k4 = v + h * l3
        l4 = acceleration(x + h * k3, k4, end)
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        v += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)
        here = end
        delta = x - here[0]
        top, bottom = max(top, delta), min(bottom, delta)
    return {
        "tool.delta_max": top,
        "tool.delta_min": bottom,
        "tool.final.displacement": x,
        "tool.final.speed": v,
        "press.ram.final.displacement": here[0],
        "press.ram.final.speed": here[1],
    }


def main():
    coarse, fine = run(200_000), run(400_000)
    path = pathlib.Path(__file__).with_name("linkages.json")
    data = json.loads(path.read_text()) if path.exists() else {}
    data["toggle_press"] = {
        key: {"value": value, "spread": abs(value - coarse[key])} for key, value in fine.items()
    }
    path.write_text(json.dumps(data, indent=2, ensure_ascii=False) + "\n")
    for key, value in data["toggle_press"].items():
        print(key, value)


main()
