"""Maps and sweeps shared out: the same values, however it is done and whatever is lost."""

from __future__ import annotations

import concurrent.futures
import multiprocessing
import os
import random
import signal
import subprocess
import sys
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


def test_cells_stream_into_parquet_and_zarr(short: dam.Scene, tmp_path: Path) -> None:
    pytest.importorskip("zarr")
    dataset = pytest.importorskip("pyarrow.dataset")
    import xarray

    x = ("rocker.inertia", -0.05, 1.0, 7)  # some are no mechanism
    known = short.map(x, Y).to_xarray()
    parquet, zarr = tmp_path / "parquet", tmp_path / "map.zarr"
    seen: list[tuple[int, int]] = []

    def look(share: float) -> None:
        # What is finished can be read while others are worked out.
        (folder,) = parquet.iterdir()
        rows = dataset.dataset(folder, format="parquet").count_rows()
        verdicts = xarray.open_zarr(zarr, consolidated=False, chunks=None)["verdict"].to_numpy()
        assert rows == round(share * verdicts.size) == (verdicts >= 0).sum()
        seen.append((rows, verdicts.size))

    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        found = distributed.map(
            short, x, Y, client=pool, folder=parquet, zarr=zarr, seconds=0.02, progress=look
        )
    assert found.identical(known) and len(seen) > 3 and seen[-1] == (35, 35)
    opened = xarray.open_zarr(zarr, consolidated=False, chunks=None)
    assert opened["value"].dims == known["value"].dims and opened.attrs == known.attrs
    assert opened["value"].to_numpy().tobytes() == known["value"].to_numpy().tobytes()
    assert opened["value"].attrs["units"] == known["value"].attrs["units"]
    assert opened["rocker.stiffness"].equals(known["rocker.stiffness"])
    names = opened["verdict"].attrs["flag_meanings"].split()
    told = [names[number] for number in opened["verdict"].to_numpy().ravel()]
    judged = [
        one if isinstance(one, str) else "no_such_mechanism"
        for one in known["judgement"].to_numpy().ravel()
    ]
    assert told == judged and "no_such_mechanism" in told
    # The files of Parquet are one data set, with the parameters of each cell.
    (folder,) = parquet.iterdir()
    rows = dataset.dataset(folder, format="parquet").to_table().sort_by("place").to_pandas()
    for _, row in rows.iterrows():
        cell = known.sel({name: row[name] for name in known["value"].dims})
        assert row["verdict"] == cell["verdict"].item() and row["cause"] == cell["cause"].item()
        numpy.testing.assert_equal(row["value"], cell["value"].item())
    with pytest.raises(FileExistsError), concurrent.futures.ThreadPoolExecutor(1) as pool:
        distributed.map(short, x, Y, client=pool, zarr=zarr)
    # What was kept is in a new group too.
    again = tmp_path / "again.zarr"
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        distributed.map(short, x, Y, client=pool, folder=parquet, zarr=again)
    assert xarray.open_zarr(again, consolidated=False, chunks=None).identical(opened)


def test_a_sweep_keeps_its_rows_with_their_parameters(short: dam.Scene, tmp_path: Path) -> None:
    dataset = pytest.importorskip("pyarrow.dataset")
    table: dict[str, list[float | str]] = {
        "rocker.inertia": [0.05, "80 g m^2", 0.1],
        "rocker.stiffness": [1e6, 2e6, 1e7],
    }
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        found = distributed.sweep(short, table, client=pool, folder=tmp_path, seconds=0.001)
    (folder,) = tmp_path.iterdir()
    rows = dataset.dataset(folder, format="parquet").to_table().sort_by("place").to_pydict()
    assert rows["rocker.inertia"] == ["0.05", '"80 g m^2"', "0.1"]
    assert rows["rocker.stiffness"] == table["rocker.stiffness"]
    assert rows["verdict"] == found["verdict"].to_numpy().tolist()


def test_a_job_array_has_the_same_map(scenarios: Path, tmp_path: Path) -> None:
    """The script for SLURM, its tasks as plain processes."""
    script = Path(__file__).parents[1] / "examples" / "job_array.sh"
    program = tmp_path / "bin" / "dam"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m dam "$@"\n')
    program.chmod(0o755)
    (tmp_path / "scenarios").symlink_to(scenarios)
    own = {"PATH": f"{program.parent}:{os.environ['PATH']}", "PARTS": str(tmp_path / "parts")}
    question = ["scenarios/rocker/two_masses.json", "--set", "run.duration=0.1"]
    question += ["--x", "rocker.inertia=0.05:1:7", "--y", "rocker.stiffness=1e6:1e8:5:log"]

    def run(arguments: list[str], more: dict[str, str]) -> str:
        ran = subprocess.run(
            arguments, cwd=tmp_path, env={**own, **more}, capture_output=True, text=True
        )
        assert ran.returncode == 0, ran.stderr
        return ran.stdout

    # 35 cells by 4 tasks, in any order and one of them twice.
    for task in (2, 0, 3, 1, 0):
        environment = {"SLURM_ARRAY_TASK_ID": str(task), "SLURM_ARRAY_TASK_COUNT": "4"}
        run(["bash", str(script), "35", *question], environment)
    assert len(list((tmp_path / "parts").iterdir())) == 4
    run(["bash", str(script), "merge", *question, "--out", "merged"], {})
    run(["dam", "map", *question, "--out", "alone"], {})
    merged, alone = (
        {file.name: file.read_bytes() for file in (tmp_path / name).iterdir()}
        for name in ("merged", "alone")
    )
    # How long it took is another matter.
    for name in ("timing.json", "provenance.json"):
        assert merged.pop(name) and alone.pop(name)
    assert merged == alone and "report.html" in alone and len(alone) >= 4
    # Without a part the map is not whole, and it says so.
    (tmp_path / "parts" / "part-2").unlink()
    ran = subprocess.run(
        ["bash", str(script), "merge", *question], cwd=tmp_path, env=own, capture_output=True
    )
    assert ran.returncode == 2
