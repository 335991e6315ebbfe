"""Planar rigid bodies in absolute coordinates (place of the centre of mass, angle) with
multipliers for their pins and guides: no coordinate of a linkage, no code of dam."""
import math
from extrapolation import solved


class Bodies:
    def __init__(self, gravity=(0.0, 0.0)):
        self.inertia, self.pins, self.guides, self.rails, self.forces = [], [], [], [], []
        self.gravity = gravity

    def body(self, mass, moment):
        self.inertia.append((mass, moment))
        return len(self.inertia) - 1

    def pin(self, a, point_a, b, point_b):
        """Points of two bodies, from their centres of mass; None: of the ground."""
        self.pins.append((a, point_a, b, point_b))

    def guide(self, a, normal, angle=True):
        """The centre of a body moves across no normal; by default it does not turn."""
        self.guides.append((a, normal, angle))

    def rail(self, a, b):
        """The centre of a moves along the x axis of b, and turns with it."""
        self.rails.append((a, b))

    @staticmethod
    def arm(y, body, point):
        """A point's place less its centre's."""
        c, s = math.cos(y[3 * body + 2]), math.sin(y[3 * body + 2])
        return c * point[0] - s * point[1], s * point[0] + c * point[1]

    def place(self, y, body, point):
        """Place and speed of a point."""
        if body is None:
            return point[0], point[1], 0.0, 0.0
        n = 3 * len(self.inertia)
        rx, ry = self.arm(y, body, point)
        w = y[n + 3 * body + 2]
        return (
            y[3 * body] + rx,
            y[3 * body + 1] + ry,
            y[n + 3 * body] - w * ry,
            y[n + 3 * body + 1] + w * rx,
        )

    def slopes(self, t, y):
        n = 3 * len(self.inertia)
        force = [0.0] * n
        for k, (mass, _) in enumerate(self.inertia):
            force[3 * k] = mass * self.gravity[0]
            force[3 * k + 1] = mass * self.gravity[1]

        def push(body, point, fx, fy):
            if body is not None:
                rx, ry = self.arm(y, body, point)
                force[3 * body] += fx
                force[3 * body + 1] += fy
                force[3 * body + 2] += rx * fy - ry * fx

        for act in self.forces:
            act(self, t, y, push, force)
        rows, right = [], []
        for a, pa, b, pb in self.pins:
            rx, ry = self.arm(y, a, pa)
            wa = y[n + 3 * a + 2]
            gx, gy = [0.0] * n, [0.0] * n
            gx[3 * a], gx[3 * a + 2] = 1.0, -ry
            gy[3 * a + 1], gy[3 * a + 2] = 1.0, rx
            x, z = wa * wa * rx, wa * wa * ry
            if b is not None:
                sx, sy = self.arm(y, b, pb)
                wb = y[n + 3 * b + 2]
                gx[3 * b], gx[3 * b + 2] = -1.0, sy
                gy[3 * b + 1], gy[3 * b + 2] = -1.0, -sx
                x, z = x - wb * wb * sx, z - wb * wb * sy
            rows += [gx, gy]
            right += [x, z]
        for a, normal, angle in self.guides:
            g = [0.0] * n
            g[3 * a], g[3 * a + 1] = normal
            rows.append(g)
            right.append(0.0)
            if angle:
                g = [0.0] * n
                g[3 * a + 2] = 1.0
                rows.append(g)
                right.append(0.0)
        for a, b in self.rails:
            c, s = math.cos(y[3 * b + 2]), math.sin(y[3 * b + 2])
            dx, dy = y[3 * a] - y[3 * b], y[3 * a + 1] - y[3 * b + 1]
            vx, vy = y[n + 3 * a] - y[n + 3 * b], y[n + 3 * a + 1] - y[n + 3 * b + 1]
            w = y[n + 3 * b + 2]
            g, turn = [0.0] * n, [0.0] * n
            g[3 * a], g[3 * a + 1] = -s, c
            g[3 * b], g[3 * b + 1], g[3 * b + 2] = s, -c, -(dx * c + dy * s)
            turn[3 * a + 2], turn[3 * b + 2] = 1.0, -1.0
            rows += [g, turn]
            right += [2 * w * (vx * c + vy * s) + w * w * (dy * c - dx * s), 0.0]
        matrix = []
        for k in range(n):
            line = [0.0] * n
            line[k] = self.inertia[k // 3][1 if k % 3 == 2 else 0]
            matrix.append(line + [row[k] for row in rows])
        matrix += [row + [0.0] * len(rows) for row in rows]
        return list(y[n:]) + solved(matrix, force + right)[:n]


def strut(a, pa, b, pb, rate=0.0, free=0.0, damping=0.0):
    """A spring and damper between two points."""

    def act(bodies, _, y, push, __):
        x1, y1, u1, v1 = bodies.place(y, a, pa)
        x2, y2, u2, v2 = bodies.place(y, b, pb)
        dx, dy = x2 - x1, y2 - y1
        length = math.hypot(dx, dy)
        pull = rate * (length - free) + damping * ((u2 - u1) * dx + (v2 - v1) * dy) / length
        fx, fy = pull * dx / length, pull * dy / length
        push(a, pa, fx, fy)
        push(b, pb, -fx, -fy)

    return act


def couple(body, moment):
    """A moment on a body, or a function of its angle and speed."""

    def act(bodies, t, y, _, force):
        n = 3 * len(bodies.inertia)
        k = 3 * body + 2
        force[k] += moment(t, y[k], y[n + k]) if callable(moment) else moment

    return act
