"""Integration of piecewise smooth equations of motion, for the reference figures.

Independent of the program: absolute coordinates, scipy's DOP853 with tight
tolerances, switches as terminal events, extremes refined on the dense output.
Nothing here knows scenes, objects or position functions; every script beside
this one writes its own equations by hand.
"""

import json
import math
from pathlib import Path

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq, minimize_scalar

HERE = Path(__file__).parent
step_factor = 1.0  # of every greatest step; see `twice`


class Motion:
    """Smooth pieces (mode, dense solution) and the switches between them."""

    def __init__(self):
        self.pieces = []
        self.switches = []  # (time, mode before, mode after, state)

    @property
    def end(self):
        return self.pieces[-1][1].y[:, -1]

    def extremes(self, quantity, points=6):
        """Least and greatest value of quantity(t, y, mode), refined."""
        least, greatest = math.inf, -math.inf
        for mode, solution in self.pieces:
            knots = solution.t
            grid = np.unique(
                np.concatenate(
                    [a + (b - a) * np.linspace(0, 1, points + 1) for a, b in zip(knots[:-1], knots[1:])]
                )
            )
            values = np.array([quantity(t, solution.sol(t), mode) for t in grid])
            least = min(least, refine(quantity, solution, mode, grid, values, +1))
            greatest = max(greatest, -refine(quantity, solution, mode, grid, values, -1))
        return least, greatest

    def peak(self, quantity):
        """Greatest absolute value."""
        least, greatest = self.extremes(quantity)
        return max(-least, greatest)

    def mean_absolute(self, quantity, duration):
        """(1/T) times the integral of |quantity|."""
        nodes, weights = np.polynomial.legendre.leggauss(8)
        total = 0.0
        for mode, solution in self.pieces:
            value = lambda t: quantity(t, solution.sol(t), mode)
            for a, b in zip(solution.t[:-1], solution.t[1:]):
                marks = [a + (b - a) * k / 4 for k in range(5)]
                values = [value(t) for t in marks]
                cuts = [a]
                for lo, hi, vlo, vhi in zip(marks[:-1], marks[1:], values[:-1], values[1:]):
                    if vlo * vhi < 0:
                        cuts.append(brentq(value, lo, hi, xtol=1e-16, rtol=1e-14))
                cuts.append(b)
                for lo, hi in zip(cuts[:-1], cuts[1:]):
                    half = (hi - lo) / 2
                    total += half * abs(
                        sum(w * value((lo + hi) / 2 + half * x) for x, w in zip(nodes, weights))
                    )
        return total / duration

    def open_intervals(self, is_open, duration):
        """[(from, to)] of the maximal stretches in which is_open(mode)."""
        intervals = []
        for mode, solution in self.pieces:
            if is_open(mode):
                a, b = solution.t[0], solution.t[-1]
                if intervals and abs(intervals[-1][1] - a) < 1e-15:
                    intervals[-1][1] = b
                else:
                    intervals.append([a, b])
        return intervals


def refine(quantity, solution, mode, grid, values, sign):
    """Least of sign*quantity near the best grid point."""
    values = sign * values
    best = int(np.argmin(values))
    lo, hi = grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)]
    if hi <= lo:
        return values[best]
    found = minimize_scalar(
        lambda t: sign * quantity(t, solution.sol(t), mode),
        bounds=(lo, hi),
        method="bounded",
        options={"xatol": 1e-9 * (hi - lo)},
    )
    return min(values[best], found.fun)


def simulate(rhs, guards, start, mode, duration, *, breaks=(), max_step, rtol, atol):
    """Integrates y' = rhs(t, y, mode) from 0 to duration.

    guards(mode) gives [(g(t, y), direction, new mode)]; the run restarts at
    every root of g and at every time of `breaks`.
    """
    motion = Motion()
    max_step *= step_factor
    time, y = 0.0, np.array(start, dtype=float)
    stops = sorted({b for b in breaks if 0 < b < duration} | {duration})
    ladder = max_step * 2.0**-20  # first interval after a switch: a short excursion must not hide in a step
    while time < duration:
        end = next(stop for stop in stops if stop > time)
        if guards(mode) and ladder < max_step:
            end, ladder = min(end, time + ladder), 2 * ladder
        events, targets = [], []
        for function, direction, target in guards(mode):
            event = lambda t, y, function=function: function(t, y)
            event.terminal, event.direction = True, direction
            events.append(event)
            targets.append(target)
        solution = solve_ivp(
            lambda t, y: rhs(t, y, mode),
            (time, end),
            y,
            method="DOP853",
            rtol=rtol,
            atol=atol,
            max_step=max_step,
            dense_output=True,
            events=events or None,
        )
        assert solution.success, solution.message
        assert_none_hidden(solution, events, 1e-6 * max_step)
        motion.pieces.append((mode, solution))
        time, y = solution.t[-1], solution.y[:, -1].copy()
        if solution.status == 1:
            fired = [k for k, roots in enumerate(solution.t_events) if len(roots)]
            before, mode = mode, targets[fired[0]]
            motion.switches.append((time, before, mode, y))
            ladder = max_step * 2.0**-20
    return motion


def assert_none_hidden(solution, events, shortest):
    """No guard may turn and turn back within a step: looks at interior points.

    Steps below `shortest` (right after a switch) show nothing but rounding.
    """
    for a, b in zip(solution.t[:-1], solution.t[1:]):
        if b - a < shortest:
            continue
        inner = [a + (b - a) * k / 5 for k in range(1, 5)]
        for event in events:
            values = [event.direction * event(t, solution.sol(t)) for t in inner]
            ends = [event.direction * event(t, solution.sol(t)) for t in (a, b)]
            rises = any(x < 0 < y for x, y in zip(values[:-1], values[1:]))
            assert not (rises and ends[1] < 0), f"a switch hides in the step at {a}"


def pair_figures(prefix, motion, is_open, duration, approach, force):
    """Counts, times and greatest force of a pair; `is_open(mode)`."""
    openings = [s for s in motion.switches if is_open(s[2]) and not is_open(s[1])]
    closings = [s for s in motion.switches if is_open(s[1]) and not is_open(s[2])]
    intervals = motion.open_intervals(is_open, duration)
    return {
        f"{prefix}.pair.separations": len(openings),
        f"{prefix}.pair.closures": len(closings),
        f"{prefix}.pair.separated_time": sum(b - a for a, b in intervals),
        f"{prefix}.pair.longest_separation": max((b - a for a, b in intervals), default=0.0),
        f"{prefix}.pair.max_approach_speed": max((approach(*s) for s in closings), default=0.0),
        f"{prefix}.pair.max_contact_force": motion.extremes(force)[1],
    }


def object_figures(prefix, motion, duration, *, delta=None, speed, acceleration, reaction=None):
    """Figures of one object from functions of (t, y, mode)."""
    figures = {}
    if delta is not None:
        least, greatest = motion.extremes(delta)
        figures[f"{prefix}.delta_max"] = greatest
        figures[f"{prefix}.delta_min"] = least
        figures[f"{prefix}.sigma"] = motion.mean_absolute(delta, duration)
    figures[f"{prefix}.peak_speed"] = motion.peak(speed)
    figures[f"{prefix}.peak_acceleration"] = motion.peak(acceleration)
    if reaction is not None:
        figures[f"{prefix}.peak_reaction"] = motion.peak(reaction)
    return figures


def twice(compute):
    """compute(rtol) at two tolerances and greatest steps; each figure with its spread."""
    global step_factor
    step_factor = 1.0
    coarse = compute(1e-10)
    step_factor = 0.6
    fine = compute(1e-12)
    assert coarse.keys() == fine.keys()
    return {
        name: {"value": plain(fine[name]), "spread": abs(float(fine[name]) - float(coarse[name]))}
        for name in fine
    }


def exact(figures):
    """Closed-form figures, without spread."""
    return {name: {"value": plain(value), "spread": 0.0} for name, value in figures.items()}


def plain(value):
    """A number that JSON can hold."""
    return int(value) if isinstance(value, (int, np.integer)) else float(value)


def write(name, about, scenes):
    """Writes <name>.json beside the scripts and prints the figures."""
    document = {"about": about, "scenes": scenes}
    (HERE / f"{name}.json").write_text(json.dumps(document, indent=1) + "\n")
    for scene, figures in scenes.items():
        print(scene)
        for figure, entry in figures.items():
            print(f"  {figure:45s} {entry['value']!r:25}  +- {entry['spread']:.1e}")
