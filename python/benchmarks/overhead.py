"""What Python adds: to a run, over the same run asked in Rust; and to a program, by `import dam`.

    python python/benchmarks/overhead.py               tells both
    python python/benchmarks/overhead.py --hold        and ends with status 1 beyond 30 µs and 50 ms

Least times of many repeats: what else a machine does only ever adds.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time

import dam

SCENE = """{
  "dam": 1, "name": "tiny",
  "objects": {
    "shaft": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
    "lever": { "kind": "rocker", "input": "shaft", "position": { "ratio": 1 },
               "inertia": 0.1, "stiffness": 1e7, "masses": 1 }
  },
  "run": { "duration": 0.001, "samples": 2 }
}"""


def of_a_run(rounds: int, repeats: int) -> tuple[float, float]:
    """Least time of a run (s) from Python, and from Rust, by turns."""
    scene = dam.loads(SCENE)
    here = there = float("inf")
    for _ in range(rounds):
        for _ in range(repeats):
            begun = time.perf_counter()
            scene.run()
            here = min(here, time.perf_counter() - begun)
        there = min(there, scene._core.least_time(repeats))
    return here, there


def of_the_import(repeats: int) -> float:
    """Least time of `import dam` in a fresh interpreter (s)."""
    asked = "import time; a = time.perf_counter(); import dam; print(time.perf_counter() - a)"
    least = float("inf")
    for _ in range(repeats):
        ran = subprocess.run(
            [sys.executable, "-I", "-c", asked], check=True, capture_output=True, text=True
        )
        least = min(least, float(ran.stdout))
    return least


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hold", action="store_true")
    options = parser.parse_args()
    here, there = of_a_run(20, 100)
    more = (here - there) * 1e6
    print(f"a run: {here * 1e6:.1f} µs from Python, {there * 1e6:.1f} µs in Rust: {more:.1f} µs more")
    begun = of_the_import(10) * 1e3
    print(f"import dam: {begun:.1f} ms")
    if options.hold and (more > 30.0 or begun > 50.0):
        raise SystemExit("more than 30 µs, or 50 ms")


if __name__ == "__main__":
    main()
