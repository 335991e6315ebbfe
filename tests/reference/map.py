"""Greatest deviation of the two-mass rocker at some points of the map over inertia and stiffness.

Independent of the program: between two switches the motion z = (q, q', sin, cos, 1) obeys
z' = A z with constant A. It is advanced by exp(A h) over fixed steps far shorter than the
shortest period; a step over which the pair condition changes is cut by bisection with
exp(A s) anew, and so is a step over which the speed of the last mass passes through zero
downwards. Nothing is bounded or predicted: what the steps do not see is not found, so that
every cell is computed with two step lengths, and the difference is its spread. Needs nothing
but Python; exp is its Taylor series after scaling, squared back.
"""

import json
import math
from pathlib import Path

AMPLITUDE, OMEGA, MOMENT, PSI, DURATION = math.pi / 2, 20 * math.pi, 600.0, 0.4, 0.5


def product(a, b):
    columns = list(zip(*b))
    return [[math.fsum(x * y for x, y in zip(row, column)) for column in columns] for row in a]


def apply(a, z):
    return [sum(x * y for x, y in zip(row, z)) for row in a]


def expm(A, s):
    size = len(A)
    norm = max(sum(abs(x) for x in row) for row in A) * s
    halvings = max(0, math.ceil(math.log2(norm / 0.25))) if norm > 0.25 else 0
    scaled = [[x * s / 2**halvings for x in row] for row in A]
    one = [[float(i == j) for j in range(size)] for i in range(size)]
    total, term = one, one
    for order in range(1, 14):
        term = [[x / order for x in row] for row in product(term, scaled)]
        total = [[x + y for x, y in zip(p, q)] for p, q in zip(total, term)]
    for _ in range(halvings):
        total = product(total, total)
    return total


def flow(A, s, z):
    """exp(A s) z for short s by its series: exact to rounding, and cheap."""
    total, term = list(z), list(z)
    for order in range(1, 40):
        term = [x * s / order for x in apply(A, term)]
        total = [x + y for x, y in zip(total, term)]
        if all(abs(x) <= 1e-19 * abs(y) for x, y in zip(term, total)):
            break
    return total


class Cell:
    def __init__(self, inertia, stiffness):
        self.J = [inertia / 8, 7 * inertia / 8]
        self.c = 2 * stiffness
        self.b = PSI * self.c / (2 * math.pi * math.sqrt(stiffness / inertia))
        self.rate = math.sqrt(2 * self.c / self.J[0])
        self.A = {True: self.matrix(self.c, self.b), False: self.matrix(0.0, 0.0)}

    def matrix(self, c1, b1):
        """Of z = (q1, q2, v1, v2, sin, cos, 1); q is the deviation from the law, v its rate over
        `rate`: entries of one size, so that squaring costs no digits."""
        c, b, w = self.c, self.b, self.rate
        j1, j2 = (J * w for J in self.J)
        law = AMPLITUDE * OMEGA**2 / w  # the law's acceleration, taken over
        return [
            [0, 0, w, 0, 0, 0, 0],
            [0, 0, 0, w, 0, 0, 0],
            [(-c1 - c) / j1, c / j1, (-b1 - b) / j1 * w, b / j1 * w, law, 0, 0],
            [c / j2, -c / j2, b / j2 * w, -b / j2 * w, law, 0, -MOMENT / j2],
            [0, 0, 0, 0, 0, OMEGA, 0],
            [0, 0, 0, 0, -OMEGA, 0, 0],
            [0] * 7,
        ]

    def guard(self, z):
        """Negative while the pair is engaged."""
        return self.c * z[0] + self.b * self.rate * max(z[2], 0.0)

    def run(self, step):
        steps = math.ceil(DURATION / step)
        step = DURATION / steps
        whole = {mode: expm(A, step) for mode, A in self.A.items()}
        # Static balance: every link carries the moment; speeds are those of the law.
        z = [-MOMENT / self.c, -2 * MOMENT / self.c, 0.0, 0.0, 0.0, 1.0, 1.0]
        mode, greatest, switches = True, z[1], 0
        for _ in range(steps):
            left, after = step, apply(whole[mode], z)
            while True:
                if (self.guard(after) < 0) == mode:
                    break
                cut = self.bisect(z, left, mode, lambda y: (self.guard(y) < 0) == mode)
                before, z = z, flow(self.A[mode], cut, z)
                greatest = max(greatest, self.peak(before, z, cut, mode))
                mode, left, switches = not mode, left - cut, switches + 1
                after = flow(self.A[mode], left, z)
            greatest = max(greatest, self.peak(z, after, left, mode))
            z = after
        return greatest, switches

    def peak(self, z, after, length, mode):
        if z[3] > 0 > after[3]:
            top = self.bisect(z, length, mode, lambda y: y[3] > 0)
            return flow(self.A[mode], top, z)[1]
        return max(z[1], after[1])

    def bisect(self, z, length, mode, holds):
        """Just after the first instant found at which `holds` no longer does."""
        low, high = 0.0, length
        for _ in range(60):
            middle = 0.5 * (low + high)
            if holds(flow(self.A[mode], middle, z)):
                low = middle
            else:
                high = middle
            if high - low <= 1e-17:
                break
        return high


def main():
    cells = []
    for inertia, stiffness in [
        (0.05, 2.5e6), (0.1, 2.5e6), (0.25, 2.5e6), (0.4, 2.5e6), (0.6, 2.5e6), (0.95, 2.5e6),
        (0.3, 5e6), (0.8, 5e6), (0.1, 1e7), (0.4, 1e7), (0.7, 1e7), (0.1, 2e7),
    ]:
        cell = Cell(inertia, stiffness)
        coarse, count = cell.run(1.0 / cell.rate)
        fine, same = cell.run(0.55 / cell.rate)
        assert count == same, (inertia, stiffness, count, same)
        entry = {
            "inertia": inertia, "stiffness": stiffness, "delta_max": float(fine),
            "switches": int(same), "spread": abs(float(fine - coarse)),
        }
        cells.append(entry)
        print(entry, flush=True)
        write(cells)


def write(cells):
    document = {
        "about": "Two-mass rocker, law of 90 deg at 10 Hz, closing moment 600 N m, damping capacity "
                 "0.4, static start, 0.5 s: greatest deviation; by map.py",
        "cells": cells,
    }
    path = Path(__file__).with_suffix(".json")
    path.write_text(json.dumps(document, indent=1) + "\n")


main()
