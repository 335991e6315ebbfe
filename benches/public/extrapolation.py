"""Extrapolation of the midpoint rule (Gragg, Bulirsch, Stoer): an integrator of its own,
for digits that share no code with dam. Standard library only."""

# Substeps of the rows of the table.
ROWS = [2, 4, 6, 8, 10, 12, 14, 16]


def midpoint(f, t, y, step, count):
    h = step / count
    before, now = y, [a + h * b for a, b in zip(y, f(t, y))]
    for k in range(1, count):
        slope = f(t + k * h, now)
        before, now = now, [a + 2 * h * b for a, b in zip(before, slope)]
    slope = f(t + step, now)
    return [0.5 * (a + b + h * c) for a, b, c in zip(before, now, slope)]


def advance(f, t, y, step):
    """One step: the best value, and how far it may be off."""
    table = []
    error = float("inf")
    for row, count in enumerate(ROWS):
        line = [midpoint(f, t, y, step, count)]
        for k in range(1, row + 1):
            ratio = (count / ROWS[row - k]) ** 2 - 1
            line.append([a + (a - b) / ratio for a, b in zip(line[k - 1], table[-1][k - 1])])
        if row:
            error = max(abs(a - b) for a, b in zip(line[-1], line[-2]))
        table.append(line)
    return table[-1][-1], error


def integrate(f, y, times, tolerance=1e-13):
    """States at the times, from the first of them on."""
    t, found, step = times[0], [list(y)], 1e-3
    for end in times[1:]:
        while t < end:
            now = min(step, end - t)
            new, error = advance(f, t, y, now)
            if error > tolerance:
                step = now * max(0.2, 0.9 * (tolerance / error) ** (1 / 15))
                continue
            t, y = (end if now == end - t else t + now), new
            step = now * min(3.0, 0.9 * (tolerance / max(error, 1e-300)) ** (1 / 15))
        found.append(list(y))
    return found


def solved(matrix, right):
    """Gauss with pivots."""
    rows = [list(line) + [value] for line, value in zip(matrix, right)]
    n = len(rows)
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            share = rows[i][k] / rows[k][k]
            if share:
                rows[i] = [a - share * b for a, b in zip(rows[i], rows[k])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - sum(rows[k][j] * x[j] for j in range(k + 1, n))) / rows[k][k]
    return x
