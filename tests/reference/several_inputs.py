"""Figures of linkages with several inputs: scenarios/linkages/five_bar,
scenarios/linkages/floating_slider_crank, scenarios/linkages/triple_pendulum and
scenarios/linkages/cam_with_adjusted_lever.

Absolute coordinates of all bodies, Lagrange multipliers for the pairs, the classical
Runge-Kutta method with two steps and Richardson's extrapolation. Needs nothing but Python.
Writes several_inputs.json beside it.
"""

import json
import math
import pathlib


def solve(a, b):
    """Gaussian elimination with partial pivoting."""
    n = len(b)
    a = [row + [r] for row, r in zip(a, b)]
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(a[i][k]))
        a[k], a[p] = a[p], a[k]
        top = a[k]
        for i in range(k + 1, n):
            row = a[i]
            if row[k] != 0.0:
                f = row[k] / top[k]
                for j in range(k, n + 1):
                    row[j] -= f * top[j]
    x = [0.0] * n
    for i in range(n - 1, -1, -1):
        x[i] = (a[i][n] - sum(a[i][j] * x[j] for j in range(i + 1, n))) / a[i][i]
    return x


class Machine:
    """Bodies (mass, moment, centre in the body's frame); coordinates x, y of the centre, angle.

    A cam is a curve of body i, a function of a parameter with its two derivatives, on which a
    point of body j lies: two equations, and the parameter as a coordinate without mass.
    """

    def __init__(self, bodies, pins, guides, forces, cams=()):
        self.bodies, self.pins, self.guides, self.forces = bodies, pins, guides, forces
        self.cams = cams

    def arm(self, q, body, point):
        if body is None:
            return point
        c = self.bodies[body][2]
        x, y = point[0] - c[0], point[1] - c[1]
        s, k = math.sin(q[3 * body + 2]), math.cos(q[3 * body + 2])
        return (k * x - s * y, s * x + k * y)

    def acceleration(self, q, v):
        return self.solved(q, v)[: len(q)]

    def solved(self, q, v):
        """Accelerations, then the multipliers: of pins, guides, cams (a force on body i, x and y)."""
        n = 3 * len(self.bodies) + len(self.cams)
        rows, right = [], []
        for i, p, j, r in self.pins:
            rx, ry = [0.0] * n, [0.0] * n
            gx = gy = 0.0
            for body, point, sign in ((i, p, -1.0), (j, r, 1.0)):
                if body is None:
                    continue
                ax, ay = self.arm(q, body, point)
                w = v[3 * body + 2]
                rx[3 * body] += sign
                rx[3 * body + 2] -= sign * ay
                ry[3 * body + 1] += sign
                ry[3 * body + 2] += sign * ax
                gx += sign * w * w * ax
                gy += sign * w * w * ay
            rows += [rx, ry]
            right += [gx, gy]
        for i, p, direction, j, r in self.guides:
            # Equal angles; no displacement across the direction, which turns with body i.
            turn, across = [0.0] * n, [0.0] * n
            turn[3 * j + 2], turn[3 * i + 2] = 1.0, -1.0
            a = q[3 * i + 2] + direction
            nx, ny = -math.sin(a), math.cos(a)
            tx, ty = math.cos(a), math.sin(a)
            w = v[3 * i + 2]
            pi, pj = self.arm(q, i, p), self.arm(q, j, r)
            dx = q[3 * j] + pj[0] - q[3 * i] - pi[0]
            dy = q[3 * j + 1] + pj[1] - q[3 * i + 1] - pi[1]
            wj = v[3 * j + 2]
            ux = v[3 * j] - wj * pj[1] - v[3 * i] + w * pi[1]
            uy = v[3 * j + 1] + wj * pj[0] - v[3 * i + 1] - w * pi[0]
            across[3 * j], across[3 * j + 1] = nx, ny
            across[3 * j + 2] = -nx * pj[1] + ny * pj[0]
            across[3 * i], across[3 * i + 1] = -nx, -ny
            # d(n)/dt = -w t: the turning of the direction counts for body i.
            across[3 * i + 2] = nx * pi[1] - ny * pi[0] - (tx * dx + ty * dy)
            gamma = nx * wj * wj * pj[0] + ny * wj * wj * pj[1]
            gamma -= nx * w * w * pi[0] + ny * w * w * pi[1]
            gamma += 2.0 * w * (tx * ux + ty * uy) + w * w * (nx * dx + ny * dy)
            rows += [turn, across]
            right += [0.0, gamma]
        for k, (i, j, p, curve) in enumerate(self.cams):
            place, first, second = curve(q[3 * len(self.bodies) + k])
            rate = v[3 * len(self.bodies) + k]
            s, c = math.sin(q[3 * i + 2]), math.cos(q[3 * i + 2])
            turned = lambda x, y: (c * x - s * y, s * x + c * y)
            (ax, ay), (tx, ty) = self.arm(q, i, place), turned(*first)
            (nx, ny), (bx, by) = turned(*second), self.arm(q, j, p)
            w, wj = v[3 * i + 2], v[3 * j + 2]
            rx, ry = [0.0] * n, [0.0] * n
            rx[3 * j], rx[3 * j + 2], rx[3 * i], rx[3 * i + 2] = 1.0, -by, -1.0, ay
            ry[3 * j + 1], ry[3 * j + 2], ry[3 * i + 1], ry[3 * i + 2] = 1.0, bx, -1.0, -ax
            rx[3 * len(self.bodies) + k], ry[3 * len(self.bodies) + k] = -tx, -ty
            # Along the curve: Coriolis' acceleration, and that by its curvature.
            rows += [rx, ry]
            right += [
                wj * wj * bx - w * w * ax - 2 * w * rate * ty + rate * rate * nx,
                wj * wj * by - w * w * ay + 2 * w * rate * tx + rate * rate * ny,
            ]
        m = len(rows)
        a = [[0.0] * (n + m) for _ in range(n + m)]
        b = [0.0] * (n + m)
        for k, (mass, moment, _) in enumerate(self.bodies):
            for c, value in enumerate((mass, mass, moment)):
                a[3 * k + c][3 * k + c] = value
        for k, row in enumerate(rows):
            for c, value in enumerate(row):
                a[n + k][c] = value
                a[c][n + k] = value
            b[n + k] = right[k]
        self.forces(q, v, b)
        return solve(a, b)

    def run(self, q, v, duration, steps):
        h = duration / steps
        add = lambda a, b, f: [x + f * y for x, y in zip(a, b)]
        for _ in range(steps):
            a1 = self.acceleration(q, v)
            v2 = add(v, a1, h / 2)
            a2 = self.acceleration(add(q, v, h / 2), v2)
            v3 = add(v, a2, h / 2)
            a3 = self.acceleration(add(q, v2, h / 2), v3)
            v4 = add(v, a3, h)
            a4 = self.acceleration(add(q, v3, h), v4)
            q = [x + h / 6 * (a + 2 * b + 2 * c + d) for x, a, b, c, d in zip(q, v, v2, v3, v4)]
            v = [x + h / 6 * (a + 2 * b + 2 * c + d) for x, a, b, c, d in zip(v, a1, a2, a3, a4)]
        return q, v

    def extrapolated(self, q, v, duration, steps):
        coarse = self.run(q, v, duration, steps)
        fine = self.run(q, v, duration, 2 * steps)
        best = [[f + (f - c) / 15 for f, c in zip(fs, cs)] for fs, cs in zip(fine, coarse)]
        error = max(abs(f - c) / 15 for fs, cs in zip(fine, coarse) for f, c in zip(fs, cs))
        return best[0], best[1], error


def bar(mass, length):
    return (mass, mass * length * length / 12, (length / 2, 0.0))


def place(x, y, angle, length):
    """The coordinates of a bar that begins at a point."""
    return [x + length / 2 * math.cos(angle), y + length / 2 * math.sin(angle), angle]


G = 9.80665


def five_bar():
    """Two motors with linear characteristics on the cranks of a five-bar."""
    la, lb, rod, apart = 0.2, 0.15, 0.7, 0.6
    left, right = 1.1, 0.6
    ax, ay = la * math.cos(left), la * math.sin(left)
    bx, by = apart + lb * math.cos(right), lb * math.sin(right)
    d = math.hypot(bx - ax, by - ay)
    h = math.sqrt(rod * rod - d * d / 4)
    # To the left of the line from A to B.
    cx = (ax + bx) / 2 - h * (by - ay) / d
    cy = (ay + by) / 2 + h * (bx - ax) / d
    motors = {0: (0.02, 6.0, 9.0), 3: (0.03, -8.0, -7.0)}
    bodies = [bar(1.1, la), bar(0.9, rod), bar(0.8, rod), bar(1.3, lb)]
    for body, (inertia, _, _) in motors.items():
        mass, moment, centre = bodies[body]
        bodies[body] = (mass, moment + inertia, centre)

    def forces(q, v, b):
        for k, (mass, _, _) in enumerate(bodies):
            b[3 * k + 1] -= mass * G
        for body, (_, stall, speed) in motors.items():
            b[3 * body + 2] += stall * (1 - v[3 * body + 2] / speed)

    pins = [
        (None, (0, 0), 0, (0, 0)),
        (0, (la, 0), 1, (0, 0)),
        (1, (rod, 0), 2, (rod, 0)),
        (3, (lb, 0), 2, (0, 0)),
        (None, (apart, 0), 3, (0, 0)),
    ]
    # The ground's points stand in the equations as they are.
    machine = Machine(bodies, pins, [], forces)
    q = place(0, 0, left, la) + place(ax, ay, math.atan2(cy - ay, cx - ax), rod)
    q += place(bx, by, math.atan2(cy - by, cx - bx), rod) + place(apart, 0, right, lb)
    q, v, error = machine.extrapolated(q, [0.0] * 12, 1.0, 8000)
    at = lambda k, l: q[k] + l / 2 * (math.cos, math.sin)[k % 3](q[3 * (k // 3) + 2])
    return {
        "left": q[2],
        "left_speed": v[2],
        "right": q[11],
        "right_speed": v[11],
        "x": at(3, rod),
        "y": at(4, rod),
        "error": error,
    }


def floating_slider_crank():
    """EXUDYN's sliderCrankFloatingTest: frame of 2 kg and 1 kg m2 on springs and dampers."""
    l1, l2, m = 0.1, 0.3, 0.2
    slide = (0.4, 1e-9, (0.0, 0.0))
    bodies = [(2.0, 1.0, (0.0, 0.0)), bar(m, l1), bar(m, l2), slide]

    def forces(q, v, b):
        for k in range(3):
            b[k] -= 5000 * q[k] + 50 * v[k]
        b[5] += 0.1

    pins = [(0, (0, 0), 1, (0, 0)), (1, (l1, 0), 2, (0, 0)), (2, (l2, 0), 3, (0, 0))]
    guides = [(0, (0, 0), 0.0, 3, (0, 0))]
    machine = Machine(bodies, pins, guides, forces)
    q = [0.0] * 3 + place(0, 0, 0, l1) + place(l1, 0, 0, l2) + [l1 + l2, 0, 0]
    q, v, error = machine.extrapolated(q, [0.0] * 12, 0.3, 4000)
    return {
        "slider": q[9],
        "slider_speed": v[9],
        "frame_x": q[0],
        "frame_angle": q[2],
        "crank": q[5] - q[2],
        "error": error,
    }


def triple_pendulum():
    """Three bars of half a metre, released from rest."""
    l = 0.5
    masses = (1.0, 1.1, 1.2)
    bodies = [bar(mass, l) for mass in masses]
    angles = (0.3, 0.4, 0.3)

    def forces(q, v, b):
        for k, mass in enumerate(masses):
            b[3 * k + 1] -= mass * G

    pins = [(None, (0, 0), 0, (0, 0)), (0, (l, 0), 1, (0, 0)), (1, (l, 0), 2, (0, 0))]
    machine = Machine(bodies, pins, [], forces)
    q, x, y = [], 0.0, 0.0
    for angle in angles:
        q += place(x, y, angle, l)
        x, y = x + l * math.cos(angle), y + l * math.sin(angle)
    q, v, error = machine.extrapolated(q, [0.0] * 9, 1.0, 8000)
    return {
        "first": q[2],
        "second": q[5] - q[2],
        "third": q[8] - q[5],
        "first_speed": v[2],
        "x": q[6] + l / 2 * math.cos(q[8]),
        "y": q[7] + l / 2 * math.sin(q[8]),
        "error": error,
    }


def cam_with_adjusted_lever():
    """A cam of two lobes on one motor, a lever with its roller on an arm that another motor turns."""
    arm, lever, apart = 0.02, 0.08, 0.11
    prime, lobe = 0.052, 0.005
    left, right, speed = 0.5, 2.0, 20.0
    motors = {0: (0.002, 4.0, 30.0), 1: (0.004, 2.0, 3.0)}
    bodies = [
        (0.5, 0.0008 + 0.002, (0.0, 0.0)),
        (0.2, 0.00002 + 0.004, (arm / 2, 0.0)),
        (0.3, 0.0003, (lever / 2, 0.002)),
    ]

    def curve(t):
        r, r1, r2 = prime + lobe * math.sin(2 * t), 2 * lobe * math.cos(2 * t), -4 * lobe * math.sin(2 * t)
        s, c = math.sin(t), math.cos(t)
        return (
            (r * c, r * s),
            (r1 * c - r * s, r1 * s + r * c),
            (r2 * c - 2 * r1 * s - r * c, r2 * s + 2 * r1 * c - r * s),
        )

    def forces(q, v, b):
        for k, (mass, _, _) in enumerate(bodies):
            b[3 * k + 1] -= mass * G
        for body, (_, stall, idle) in motors.items():
            b[3 * body + 2] += stall * (1 - v[3 * body + 2] / idle)
        b[8] += 1.5

    pins = [
        (None, (0, 0), 0, (0, 0)),
        (None, (apart, 0), 1, (0, 0)),
        (1, (arm, 0), 2, (0, 0)),
    ]
    cams = [(0, 2, (lever, 0.0), curve)]
    machine = Machine(bodies, pins, [], forces, cams)
    # The lever's pin, and where the curve is at the lever's length from it, above: by bisection.
    bx, by = apart + arm * math.cos(right), arm * math.sin(right)

    def point(t):
        x, y = curve(t)[0]
        s, c = math.sin(left), math.cos(left)
        return c * x - s * y, s * x + c * y

    def beyond(t):
        x, y = point(t)
        return math.hypot(x - bx, y - by) - lever

    low, high = 0.2 - left, 2.6 - left
    assert beyond(low) < 0 < beyond(high)
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if beyond(middle) < 0 else (low, middle)
    rx, ry = point(low)
    angle = math.atan2(ry - by, rx - bx)
    s, c = math.sin(angle), math.cos(angle)
    q = [0.0, 0.0, left, apart + arm / 2 * math.cos(right), arm / 2 * math.sin(right), right]
    q += [bx + lever / 2 * c - 0.002 * s, by + lever / 2 * s + 0.002 * c, angle, low]
    # The cam turns, the arm stands still: the lever by the same equations, without right sides.
    t = turning(machine, q, speed)
    v = [0.0, 0.0, speed, 0.0, 0.0, 0.0, -(lever / 2 * s + 0.002 * c) * t[0]]
    v += [(lever / 2 * c - 0.002 * s) * t[0], t[0], t[1]]
    start = machine.solved(q, v)
    pressing = math.hypot(*start[-2:])
    end, rate, error = machine.extrapolated(q, v, 0.3, 3000)
    return {
        "lever_at_start": angle,
        "lever_speed_at_start": t[0],
        "cam_acceleration_at_start": start[2],
        "arm_acceleration_at_start": start[5],
        "lever_acceleration_at_start": start[8],
        "force_at_start": pressing,
        "cam": end[2],
        "cam_speed": rate[2],
        "arm": end[5],
        "arm_speed": rate[5],
        "lever": end[8],
        "lever_speed": rate[8],
        "error": error,
    }


def turning(machine, q, speed):
    """Angular velocity of the lever and rate of the parameter while the cam turns and the arm rests."""
    i, j, p, curve = machine.cams[0]
    place, first, _ = curve(q[-1])
    s, c = math.sin(q[2]), math.cos(q[2])
    tx, ty = c * first[0] - s * first[1], s * first[0] + c * first[1]
    ax, ay = c * place[0] - s * place[1], s * place[0] + c * place[1]
    s, c = math.sin(q[8]), math.cos(q[8])
    bx, by = c * p[0] - s * p[1], s * p[0] + c * p[1]
    return solve([[-by, -tx], [bx, -ty]], [-ay * speed, ax * speed])


def main():
    found = {
        "source": "several_inputs.py: absolute coordinates, multipliers, Runge-Kutta",
        "exudyn": 0.29678917107,
        "five_bar": five_bar(),
        "floating_slider_crank": floating_slider_crank(),
        "triple_pendulum": triple_pendulum(),
        "cam_with_adjusted_lever": cam_with_adjusted_lever(),
    }
    path = pathlib.Path(__file__).with_suffix(".json")
    path.write_text(json.dumps(found, indent=2) + "\n")
    print(json.dumps(found, indent=2))


if __name__ == "__main__":
    main()
