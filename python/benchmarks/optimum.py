"""The softest spring of a cam: `scene.optimize`, and SciPy's SLSQP with differences of `run()`.

    python python/benchmarks/optimum.py             both, from the same ten starts
    python python/benchmarks/optimum.py --hold      and ends with status 1 unless `dam` finds the known
                                                    optimum from nine of them, in a hundredth of the time

    pip install scipy

A follower of 1 kg on an eccentric of 20 mm at 200 rpm is held by a spring of rate c and preload F. Sought is the
softest spring that keeps the contact force between 0 and 10 N. The motion is harmonic, so that the optimum is known:
both forces are at their limits (tests/reference/design-optimum-tolerance.json, case B). Processor times are those of
one thread; SciPy scales the variables to their ranges, as `dam` does.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

import dam

ROOT = Path(__file__).resolve().parents[2]
SPRING = "follower.loads.spring.spring"
RANGES = {f"{SPRING}.rate": (0.0, 5000.0), f"{SPRING}.preload": (0.0, 100.0)}
LEAST, MOST = "follower.pair.margin", "follower.pair.max_contact_force"


def scene() -> dam.Scene:
    """The scene of the catalogue of scenarios, rigid and at the speed of the reference."""
    own = dam.load(ROOT / "scenarios/cams/eccentric_jump.json")
    own = own.set("follower.masses", 0).set("cam.motion.speed", "200 rpm")
    return own.set("run.duration", 0.6)


def known() -> tuple[float, float]:
    """Rate and preload of the reference."""
    text = (ROOT / "tests/reference/design-optimum-tolerance.json").read_text()
    case = json.loads(text)["cam_spring"]["B_softest_spring"]
    return float(case["stiffness"]), float(case["preload"])


def is_known(values: list[float]) -> bool:
    """Whether values are those of the reference, to one part in a million."""
    each = zip(values, known(), strict=True)
    return all(abs(value - wanted) <= 1e-6 * abs(wanted) for value, wanted in each)


def with_dam(count: int) -> tuple[list[list[float]], int, float]:
    """The starts, how many of them end at the known optimum, the processor time (s)."""
    vary = [f"{path}={low}:{high}" for path, (low, high) in RANGES.items()]
    begun = time.process_time()
    found = scene().optimize(
        vary,
        subject=[f"{LEAST} >= 0", f"{MOST} <= 10 N"],
        minimize=f"{SPRING}.rate",
        starts=count,
        threads=1,
    )
    spent = time.process_time() - begun
    starts = found.document["starts"]
    assert isinstance(starts, list)
    ends = [one["to"] for one in starts if one["to"] is not None]
    return [one["from"] for one in starts], sum(map(is_known, ends)), spent


def with_scipy(starts: list[list[float]]) -> tuple[int, float]:
    """How many starts end at the known optimum, the processor time (s)."""
    import numpy as np
    from scipy.optimize import minimize

    base = scene()
    low, high = (np.array(ends) for ends in zip(*RANGES.values(), strict=True))
    known_forces: dict[bytes, np.ndarray] = {}

    def forces(share: np.ndarray) -> np.ndarray:
        key = share.tobytes()
        if key not in known_forces:
            own = base
            for path, value in zip(RANGES, low + (high - low) * share, strict=True):
                own = own.set(path, float(value))
            figures = own.run().figures
            known_forces[key] = np.array([float(figures[LEAST]), 10.0 - float(figures[MOST])])
        return known_forces[key]

    hits = 0
    begun = time.process_time()
    for start in starts:
        found = minimize(
            lambda share: share[0],
            (np.array(start) - low) / (high - low),
            method="SLSQP",
            bounds=[(0.0, 1.0)] * len(RANGES),
            constraints={"type": "ineq", "fun": forces},
            options={"ftol": 1e-12, "maxiter": 200},
        )
        hits += is_known(list(low + (high - low) * found.x))
    return hits, time.process_time() - begun


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hold", action="store_true")
    options = parser.parse_args()
    starts, hits, spent = with_dam(10)
    print(f"dam optimize:   {hits} of {len(starts)} starts, {spent:.3f} s of processor time")
    others, longer = with_scipy(starts)
    print(f"SLSQP of SciPy: {others} of {len(starts)} starts, {longer:.3f} s, {longer / spent:.1f} times")
    if options.hold and (hits < 9 or longer < 100.0 * spent):
        raise SystemExit("not nine of ten starts, or not a hundredth of the time")


if __name__ == "__main__":
    main()
