"""Maps and sweeps shared out: the same values, however it is done and whatever is lost."""

from __future__ import annotations

import concurrent.futures
import multiprocessing
import os
import random
import signal
import threading
import time
from pathlib import Path

import numpy
import pytest

import dam
from dam import distributed

pytest.importorskip("xarray")

X = ("rocker.inertia", 0.05, 1.0, 7)
Y = ("rocker.stiffness", 1e6, 1e8, 5, "log")


@pytest.fixture
def short(rocker: dam.Scene) -> dam.Scene:
    return rocker.set("run.duration", 0.1)


def test_an_executor_has_the_same_map(short: dam.Scene, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    known = short.map(X, Y).to_xarray()
    told: list[float] = []
    way = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=way) as pool:
        found = distributed.map(
            short, X, Y, client=pool, folder=tmp_path, seconds=0.05, progress=told.append
        )
    assert found.identical(known)
    assert found["value"].to_numpy().tobytes() == known["value"].to_numpy().tobytes()
    assert told == sorted(told) and told[-1] == 1.0

    class Nobody:
        def submit(self, *_: object, **__: object) -> distributed.Future:
            raise AssertionError("it is all there")

    again = distributed.map(short, X, Y, client=Nobody(), folder=tmp_path)
    assert again.identical(known)
    # What is lost of it is worked out again, and nothing else.
    files = sorted((tmp_path / found.attrs["hash"]).glob("*.parquet"))
    files[1].unlink()
    with concurrent.futures.ThreadPoolExecutor(1) as pool1:
        asked = []
        submit = pool1.submit
        pool1.submit = lambda *a, **k: asked.append(a[2:]) or submit(*a, **k)  # type: ignore[method-assign, func-returns-value]
        again = distributed.map(short, X, Y, client=pool1, folder=tmp_path)
    assert again.identical(known)
    first, last = files[1].stem.split("-")
    assert {place for one in asked for place in range(*one)} == set(range(int(first), int(last)))


def test_a_curve_and_wrong_questions(short: dam.Scene) -> None:
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        found = distributed.map(short, X, client=pool)
        assert found.identical(short.map(X).to_xarray())
        with pytest.raises(dam.SceneError):
            distributed.map(short, ("rocker.inertja", 1.0, 2.0, 3), client=pool)


def test_a_sweep_is_its_runs(short: dam.Scene) -> None:
    masses: list[float] = [1, 2, -1]
    inertia: list[float] = [0.1, 0.2, 0.1]
    table = {"rocker.masses": masses, "rocker.inertia": inertia}
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        found = distributed.sweep(short, table, client=pool, figures=["rocker.delta_abs"])
        with pytest.raises(ValueError, match="one length"):
            distributed.sweep(short, {"a": [1], "b": []}, client=pool)
    values = found["rocker.delta_abs"].to_numpy()
    for row in range(2):
        scene = short.set("rocker.masses", masses[row])
        run = scene.set("rocker.inertia", inertia[row]).run()
        assert values[row] == run.figures["rocker.delta_abs"]
    assert numpy.isnan(values[2]) and found["verdict"][2] == "refused"
    assert "masses" in str(found["cause"][2].item()) or found["cause"][2].item()


def test_a_dask_worker_may_be_killed(short: dam.Scene) -> None:
    dask = pytest.importorskip("distributed")
    known = short.map(X, Y).to_xarray()
    with (
        dask.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        dask.Client(cluster) as client,
    ):
        assert distributed.map(short, X, Y, client=client, seconds=0.05).identical(known)
        chance = random.Random(1)
        over = threading.Event()

        def kill() -> None:
            for _ in range(3):
                time.sleep(chance.uniform(0.05, 0.4))
                pids = [worker.pid for worker in cluster.workers.values() if worker.pid]
                if pids and not over.is_set():
                    os.kill(chance.choice(pids), signal.SIGKILL)

        killer = threading.Thread(target=kill)
        killer.start()
        # Another name of the same question: nothing is known beforehand.
        fresh = short.set("run.samples", 999)
        found = distributed.map(fresh, X, Y, client=client, seconds=0.05)
        over.set()
        killer.join()
        assert (found["value"].to_numpy() == known["value"].to_numpy()).all()
