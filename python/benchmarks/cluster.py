"""One map by the program with one and two threads, by `concurrent.futures` and by Dask: the same values bit
for bit, whatever workers are lost, and how long each takes.

    python python/benchmarks/cluster.py                 a map of at least 60 s of processor time
    python python/benchmarks/cluster.py --seconds 4 --kills 2 --repeats 1      a small one

with the package `dam-mechanisms[dask]` installed. The time of two threads over that of two processes of Dask
(a cluster that is already there) is the median of the repeats; a quiet machine with two processors is
needed for it to mean something. What is not the same ends it with status 1.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import csv
import multiprocessing
import os
import random
import resource
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING

import dam
import dam.distributed

if TYPE_CHECKING:
    import distributed
    import xarray

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "scenarios/rocker/two_masses.json"
# Lift-off, order and everything between are in it, so that cells cost differently.
X, Y = "rocker.inertia=0.05:1:{n}", "rocker.stiffness=0.25e7:5e7:{n}"


def processor_time() -> float:
    """Of this process and of those that it has waited for (s)."""
    whose = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    return sum(sum(resource.getrusage(who)[:2]) for who in whose)


class Problem:
    """A map that costs about so many seconds of processor time."""

    def __init__(self, seconds: float, cells: int) -> None:
        self.axes = (X.format(n=cells), Y.format(n=cells))
        self.cycles = 3
        few = (X.format(n=8), Y.format(n=8))
        spent = 0.0
        # Long runs cost in proportion to their length; what is once a cell is left out.
        while spent < seconds / 200:
            self.cycles *= 2
            spent = self.costs(few)
        self.last(self.cycles * 0.1 * seconds / (spent * cells**2 / 64))
        # The few are not like all.
        self.last(self.cycles * 1.25 * seconds / self.costs(self.axes))

    def costs(self, axes: tuple[str, str]) -> float:
        """Processor time of a map."""
        begun = processor_time()
        self._scene().map(*axes, threads=1)
        return processor_time() - begun

    def last(self, cycles: float) -> None:
        """Sets how many turns each run lasts."""
        self.cycles = max(4, round(cycles))
        self.scene = self._scene()

    def _scene(self) -> dam.Scene:
        return dam.load(SCENE).set("run.duration", self.cycles * 0.1)

    def by_program(self, threads: int) -> tuple[list[tuple[float, str, str]], float]:
        """Value, verdict and cause of every cell, and the processor time."""
        program = shutil.which("dam", path=str(Path(sys.executable).parent)) or "dam"
        duration = f"run.duration={self.cycles * 0.1!r}"
        begun = processor_time()
        with tempfile.TemporaryDirectory() as out:
            asked = [program, "map", str(SCENE), "--set", duration, "--out", out, "--quiet"]
            asked += ["--x", self.axes[0], "--y", self.axes[1], "--threads", str(threads)]
            subprocess.run(asked, check=True, stdout=subprocess.DEVNULL)
            with open(Path(out) / "map.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.reader(file))
        value = next(i for i, name in enumerate(rows[0]) if name.startswith("rocker.delta_abs"))
        cells = [(float(row[value]), row[value + 1], row[value + 2]) for row in rows[1:]]
        return cells, processor_time() - begun

    def by(self, client: dam.distributed.Client) -> xarray.Dataset:
        return dam.distributed.map(self.scene, *self.axes, client=client)


def cells_of(found: xarray.Dataset) -> list[tuple[float, str, str]]:
    columns = (found[name].to_numpy().ravel() for name in ("value", "verdict", "cause"))
    return [(float(value), str(verdict), str(cause)) for value, verdict, cause in zip(*columns)]


def same(who: str, found: list[tuple[float, str, str]], known: list[tuple[float, str, str]]) -> None:
    """Ends the program where a cell differs by a bit."""
    pairs = list(zip(found, known, strict=True))
    differ = [
        (one, other)
        for one, other in pairs
        if one[0].hex() != other[0].hex() or one[1:] != other[1:]
    ]
    if differ:
        raise SystemExit(f"{who}: {len(differ)} cells differ, such as {differ[0]}")
    print(f"  {who}: {len(found)} cells, the same bit for bit")


class Killer(threading.Thread):
    """Kills workers at random moments of a span of time."""

    def __init__(self, cluster: distributed.LocalCluster, kills: int, span: float) -> None:
        super().__init__()
        chance = random.Random(20261123)
        self.moments = sorted(chance.uniform(0.02, 0.9) * span for _ in range(kills))
        self.chance, self.cluster, self.killed = chance, cluster, 0
        self.over = threading.Event()

    def run(self) -> None:
        begun = time.monotonic()
        for moment in self.moments:
            if self.over.wait(max(0.0, moment - (time.monotonic() - begun))):
                return
            # One that is just being started again cannot be killed yet.
            while not self._kill_one():
                if self.over.wait(0.05):
                    return

    def _kill_one(self) -> bool:
        pids = [worker.pid for worker in self.cluster.workers.values() if worker.pid]
        try:
            os.kill(self.chance.choice(pids), signal.SIGKILL)
        except (IndexError, ProcessLookupError):
            return False
        self.killed += 1
        return True


def with_dask(problem: Problem, known: list[tuple[float, str, str]], options: argparse.Namespace) -> None:
    import distributed

    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        # The processes have imported what they need before anything is timed.
        client.run(__import__, "dam.distributed")
        ratios = []
        for _ in range(options.repeats):
            begun = time.perf_counter()
            here = problem.scene.map(*problem.axes, threads=2)
            by_threads = time.perf_counter() - begun
            begun = time.perf_counter()
            there = problem.by(client)
            by_processes = time.perf_counter() - begun
            ratios.append(by_threads / by_processes)
            print(
                f"  2 threads {by_threads:.2f} s, 2 processes of Dask {by_processes:.2f} s, "
                f"ratio {ratios[-1]:.3f}"
            )
        same("Scene.map, 2 threads", cells_of(here.to_xarray()), known)
        same("Dask, 2 processes", cells_of(there), known)
        print(f"  time of 2 threads over 2 processes, median of {len(ratios)}: {statistics.median(ratios):.3f}")
        # A map that was over before its last worker was killed says too little.
        for _ in range(5):
            killer = Killer(cluster, options.kills, by_processes)
            killer.start()
            there = problem.by(client)
            killer.over.set()
            killer.join()
            same(f"Dask, {killer.killed} workers killed", cells_of(there), known)
            if killer.killed == options.kills:
                return
        raise SystemExit(f"the map was over after {killer.killed} of {options.kills} kills")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=60.0, help="processor time of the map")
    parser.add_argument("--cells", type=int, default=60, help="cells along each axis")
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    problem = Problem(options.seconds, options.cells)
    known, spent = problem.by_program(1)
    # What it costs was measured on a few cells: it may turn out to be too little.
    while spent < options.seconds:
        problem.last(1.2 * problem.cycles * options.seconds / spent)
        known, spent = problem.by_program(1)
    print(f"{options.cells} x {options.cells} cells of {problem.cycles} turns each")
    print(f"  the program, 1 thread: {spent:.1f} s of processor time")
    same("the program, 2 threads", problem.by_program(2)[0], known)
    way = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=way) as pool:
        same("concurrent.futures, 2 processes", cells_of(problem.by(pool)), known)
    with_dask(problem, known, options)


if __name__ == "__main__":
    main()
