"""The same mechanisms in `dam`, in Exudyn and with SciPy's `solve_ivp`: time and error side by side.

    python python/benchmarks/peers.py                  all three, as far as they are installed
    python python/benchmarks/peers.py --quick          one setting each, and errors are held to bounds
    python python/benchmarks/peers.py --install WHEEL  also from `pip install` to the first answer, each in
                                                       an empty environment; WHEEL: that of `dam`

    pip install exudyn scipy

Three problems, with digits that none of these programs computed (their sources are in `TRUTH`):

- a slider-crank under a constant torque for 0.3 s: where is the slide?
- an elastic rocker that leaves its cam and strikes it 75 times in 0.5 s: how far does it lift off?
- a planar four-bar that falls and swings for 5 s: at which angle is it?

Every program has the problem as its users would write it: a scene; rigid bodies, joints and connectors;
equations with multipliers, and events for the contact. Exudyn's contact and load are its symbolic user functions,
which it evaluates without Python. What is timed is from the model ready to the answer there, of `dam` from the
scene on, which is decoded in every run; the least of several repeats.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import math
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCENES = {
    "slider-crank": ROOT / "benches/public/slider_crank/scene.json",
    "rocker": ROOT / "scenarios/rocker/one_mass.json",
    "four-bar": ROOT / "benches/public/four_bar/scene.json",
}


def _public(case: str, figure: str, at: float) -> float:
    told = json.loads((ROOT / f"benches/public/{case}/case.json").read_text(encoding="utf-8"))
    return next(
        float(each["truth"])
        for each in told["figures"]
        if each["figure"] == figure and each["at"] == at
    )


def _rocker() -> float:
    told = json.loads((ROOT / "tests/reference/elastic-rocker.json").read_text(encoding="utf-8"))
    return float(told["cases"]["one_mass_damped"]["outputs"]["delta_max_rad"])


# Figure of `dam`, its true value (m or rad), the scale that errors are told by, and the source.
TRUTH = {
    "slider-crank": (
        "sc.x.final.displacement",
        _public("slider_crank", "sc.x.final.displacement", 0.3),
        0.4,
        "benches/public/slider_crank/independent.py: two angles and the slide, extrapolation",
    ),
    "rocker": (
        "rocker.delta_max",
        _rocker(),
        0.0075,
        "tests/reference/elastic-rocker.json: event-exact, 80-bit arithmetic",
    ),
    "four-bar": (
        "free.final.displacement",
        _public("four_bar", "free.final.displacement", 5),
        4.0,
        "benches/public/four_bar/independent.py: three angles, extrapolation",
    ),
}
# Errors that the finest setting of `--quick` must keep.
BOUNDS = {"dam": 1e-8, "Exudyn": 2e-3, "SciPy": 1e-6}

# A setting is not repeated beyond this time (s).
LONG = 5.0

Solved = tuple[float, float]
"""Time (s) and value."""


# ---- dam ---------------------------------------------------------------------------------------


def by_dam(problem: str, tolerance: float) -> Solved:
    import dam

    scene = dam.load(SCENES[problem]).set("run.tolerance", tolerance)
    figure = TRUTH[problem][0]
    begin = time.perf_counter()
    value = float(scene.run().figures[figure])
    return time.perf_counter() - begin, value


# ---- SciPy -------------------------------------------------------------------------------------


def by_scipy(problem: str, tolerance: float) -> Solved:
    import scipy.integrate  # noqa: F401  (not what is timed)

    solve = {"slider-crank": _scipy_crank, "rocker": _scipy_rocker, "four-bar": _scipy_bar}
    begin = time.perf_counter()
    value = solve[problem](tolerance)
    return time.perf_counter() - begin, value


def _scipy_crank(tolerance: float) -> float:
    import numpy as np
    from scipy.integrate import solve_ivp

    crank, rod, m, slide, torque = 0.1, 0.3, 0.2, 0.4, 0.1
    half = rod / 2

    def slopes(_: float, y: np.ndarray) -> np.ndarray:
        a, b, _, va, vb, _ = y
        sa, ca, sb, cb = math.sin(a), math.cos(a), math.sin(b), math.cos(b)
        cross, swirl = m * crank * half * (ca * cb + sa * sb), m * crank * half * (sa * cb - ca * sb)
        matrix = np.zeros((5, 5))
        matrix[0, :2] = m * crank**2 * (1 / 12 + 1 / 4 + 1), cross
        matrix[1, :2] = cross, m * rod**2 / 12 + m * half**2
        matrix[2, 2] = slide
        g = np.array([[-crank * sa, -rod * sb, -1.0], [crank * ca, rod * cb, 0.0]])
        matrix[3:, :3], matrix[:3, 3:] = g, g.T
        right = np.array(
            [
                torque - swirl * vb**2,
                swirl * va**2,
                0.0,
                crank * ca * va**2 + rod * cb * vb**2,
                crank * sa * va**2 + rod * sb * vb**2,
            ]
        )
        return np.concatenate([y[3:], np.linalg.solve(matrix, right)[:3]])

    start = [0.0, 0.0, crank + rod, 0.0, 0.0, 0.0]
    run = solve_ivp(slopes, (0.0, 0.3), start, "DOP853", rtol=tolerance, atol=tolerance * 1e-2)
    return float(run.y[2, -1])


def _scipy_bar(tolerance: float) -> float:
    import numpy as np
    from scipy.integrate import solve_ivp

    gravity, damping = 9.80665, 0.1
    bodies = (
        ((0.4, 0.0), (0.2, 0.0), 7.7, 0.10427083333333337),
        ((0.1, 1.1), (0.05, 0.55), 21.26231995808548, 2.1660988457299584),
        ((0.65, 0.1), (0.325, 0.05), 12.659710946542187, 0.4589145218121544),
    )
    first, second, third = bodies

    def turned(v: tuple[float, float], c: float, s: float) -> tuple[float, float]:
        return c * v[0] - s * v[1], s * v[0] + c * v[1]

    def dot(u: tuple[float, float], v: tuple[float, float]) -> float:
        return u[0] * v[0] + u[1] * v[1]

    def slopes(_: float, y: np.ndarray) -> np.ndarray:
        p, q, r, vp, vq, vr = y
        turns = [(math.cos(x), math.sin(x)) for x in (p, q, r)]
        (a, b, d) = (turned(body[0], *turn) for body, turn in zip(bodies, turns))
        (c1, c2, c4) = (turned(body[1], *turn) for body, turn in zip(bodies, turns))
        m1, m2, m4 = first[2], second[2], third[2]
        swirl = m2 * (a[0] * c2[1] - a[1] * c2[0])
        matrix = np.zeros((5, 5))
        matrix[0, 0] = first[3] + m1 * dot(c1, c1) + m2 * dot(a, a)
        matrix[0, 1] = matrix[1, 0] = m2 * dot(a, c2)
        matrix[1, 1] = second[3] + m2 * dot(c2, c2)
        matrix[2, 2] = third[3] + m4 * dot(c4, c4)
        g = np.array([[-a[1], -b[1], d[1]], [a[0], b[0], -d[0]]])
        matrix[3:, :3], matrix[:3, 3:] = g, g.T
        terms = ((a, vp, 1.0), (b, vq, 1.0), (d, vr, -1.0))
        right = np.array(
            [
                swirl * vq**2 - gravity * (m1 * c1[0] + m2 * a[0]) - damping * vp,
                -swirl * vp**2 - gravity * m2 * c2[0],
                -gravity * m4 * c4[0],
                sum(v * v * sign * u[0] for u, v, sign in terms),
                sum(v * v * sign * u[1] for u, v, sign in terms),
            ]
        )
        return np.concatenate([y[3:], np.linalg.solve(matrix, right)[:3]])

    run = solve_ivp(
        slopes, (0.0, 5.0), [0.0] * 6, "DOP853", rtol=tolerance, atol=tolerance * 1e-2
    )
    return float(run.y[0, -1])


J, C, PSI, CLOSING, AMPLITUDE = 0.1, 1e7, 0.4, 600.0, math.pi / 2
B = PSI * math.sqrt(C * J) / (2 * math.pi)
OMEGA = 2 * math.pi * 10.0


def _scipy_rocker(tolerance: float) -> float:
    """In the deviation x from the law: J x'' = −M − J U″ − F, one phase of the contact after the
    other."""
    from scipy.integrate import solve_ivp

    def load(t: float) -> float:
        return -CLOSING / J + AMPLITUDE * OMEGA**2 * math.sin(OMEGA * t)

    def engaged(t: float, y: Sequence[float]) -> list[float]:
        return [y[1], load(t) - (C * y[0] + B * y[1]) / J]

    def free(t: float, y: Sequence[float]) -> list[float]:
        return [y[1], load(t)]

    def opens(_: float, y: Sequence[float]) -> float:
        return C * y[0] + B * y[1]

    def closes(_: float, y: Sequence[float]) -> float:
        return max(C * y[0], C * y[0] + B * y[1])

    def highest(_: float, y: Sequence[float]) -> float:
        return y[1]

    for event, direction in ((opens, 1.0), (closes, -1.0)):
        setattr(event, "terminal", True)
        setattr(event, "direction", direction)
    setattr(highest, "direction", -1.0)

    t, y, pressed, best = 0.0, [-CLOSING / C, 0.0], True, -1.0
    while t < 0.5:
        run = solve_ivp(
            engaged if pressed else free,
            (t, 0.5),
            y,
            "DOP853",
            events=[opens if pressed else closes, highest],
            rtol=tolerance,
            atol=[tolerance * 1e-3, tolerance],
        )
        best = max([best, *(float(state[0]) for state in run.y_events[1])])
        t, y, pressed = float(run.t[-1]), [float(value) for value in run.y[:, -1]], not pressed
    return best


# ---- Exudyn ------------------------------------------------------------------------------------


def by_exudyn(problem: str, steps: float) -> Solved:
    build = {"slider-crank": _exudyn_crank, "rocker": _exudyn_rocker, "four-bar": _exudyn_bar}
    return build[problem](round(steps))


def _exudyn_settings(steps: int, end: float):
    import exudyn as exu

    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = steps
    settings.timeIntegration.endTime = end
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = end / steps
    return settings


def _exudyn_body(mbs, mass, inertia, place, centre):
    """A body whose first point is at `place`, its centre from there at `centre`: node, body, and
    a marker for every point from the first one."""
    from exudyn import itemInterface as items

    x, y = place[0] + centre[0], place[1] + centre[1]
    node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[x, y, 0]))
    body = mbs.AddObject(items.ObjectRigidBody2D(mass=mass, inertia=inertia, nodeNumber=node))

    def marker(point):
        local = [point[0] - centre[0], point[1] - centre[1], 0]
        return mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=local))

    return node, body, marker


def _exudyn_solve(mbs, settings) -> float:
    import exudyn as exu

    mbs.Assemble()
    begin = time.perf_counter()
    # Of the second order, without damping of its own.
    mbs.SolveDynamic(settings, solverType=exu.DynamicSolverType.TrapezoidalIndex2)
    return time.perf_counter() - begin


def _exudyn_crank(steps: int) -> Solved:
    import exudyn as exu
    from exudyn import itemInterface as items

    system = exu.SystemContainer()
    mbs = system.AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    base = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=ground, localPosition=[0, 0, 0]))
    _, _, crank = _exudyn_body(mbs, 0.2, 0.2 * 0.1**2 / 12, (0, 0), (0.05, 0))
    _, _, rod = _exudyn_body(mbs, 0.2, 0.2 * 0.3**2 / 12, (0.1, 0), (0.15, 0))
    node, _, slide = _exudyn_body(mbs, 0.4, 1e-3, (0.4, 0), (0, 0))
    ends = [(base, crank((0, 0))), (crank((0.1, 0)), rod((0, 0))), (rod((0.3, 0)), slide((0, 0)))]
    for pair in ends:
        mbs.AddObject(items.RevoluteJoint2D(markerNumbers=list(pair)))
    held = mbs.AddNode(items.NodePointGround())
    held = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=held, coordinate=0))
    for coordinate in (1, 2):
        guided = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate))
        mbs.AddObject(items.CoordinateConstraint(markerNumbers=[held, guided]))
    mbs.AddLoad(items.LoadTorqueVector(markerNumber=crank((0.05, 0)), loadVector=[0, 0, 0.1]))
    spent = _exudyn_solve(mbs, _exudyn_settings(steps, 0.3))
    return spent, float(mbs.GetNodeOutput(node, exu.OutputVariableType.Position)[0])


def _exudyn_bar(steps: int) -> Solved:
    import exudyn as exu
    from exudyn import itemInterface as items

    system = exu.SystemContainer()
    mbs = system.AddSystem()
    ground = mbs.AddObject(items.ObjectGround())

    def fixed(x: float, y: float):
        return mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=ground, localPosition=[x, y, 0]))

    masses = (7.7, 21.26231995808548, 12.659710946542187)
    node, body, one = _exudyn_body(mbs, masses[0], 0.10427083333333337, (0, 0), (0.2, 0))
    _, other, two = _exudyn_body(mbs, masses[1], 2.1660988457299584, (0.4, 0), (0.05, 0.55))
    _, last, four = _exudyn_body(mbs, masses[2], 0.4589145218121544, (-0.15, 1), (0.325, 0.05))
    ends = [
        (fixed(0, 0), one((0, 0))),
        (one((0.4, 0)), two((0, 0))),
        (two((0.1, 1.1)), four((0.65, 0.1))),
        (fixed(-0.15, 1), four((0, 0))),
    ]
    for pair in ends:
        mbs.AddObject(items.RevoluteJoint2D(markerNumbers=list(pair)))
    for number, mass in zip((body, other, last), masses):
        whole = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=number))
        weight = [0, -9.80665, 0]
        mbs.AddLoad(items.LoadMassProportional(markerNumber=whole, loadVector=weight))
    held = mbs.AddNode(items.NodePointGround())
    held = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=held, coordinate=0))
    angle = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=2))
    mbs.AddObject(
        items.CoordinateSpringDamper(markerNumbers=[held, angle], stiffness=0, damping=0.1)
    )
    spent = _exudyn_solve(mbs, _exudyn_settings(steps, 5.0))
    return spent, float(mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates)[2])


def _exudyn_rocker(steps: int) -> Solved:
    """In the deviation from the law, as with SciPy; the contact without events."""
    import exudyn as exu
    from exudyn import itemInterface as items
    from exudyn.utilities import CreateSymbolicUserFunction

    symbolic = exu.symbolic
    system = exu.SystemContainer()
    mbs = system.AddSystem()
    node = mbs.AddNode(
        items.Node1D(referenceCoordinates=[0], initialCoordinates=[-CLOSING / C])
    )
    mbs.AddObject(items.Mass1D(mass=J, nodeNumber=node))
    held = mbs.AddNode(items.NodePointGround())
    held = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=held, coordinate=0))
    moved = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0))

    def force(mbs, t, item, u, v, k, d, preset):
        nothing = symbolic.Real(0.0)
        return symbolic.IfThenElse(u < 0.0, symbolic.min(k * u + d * v, nothing), nothing)

    def load(mbs, t, value):
        return J * AMPLITUDE * OMEGA**2 * symbolic.sin(OMEGA * t) - value

    contact = mbs.AddObject(
        items.CoordinateSpringDamper(markerNumbers=[held, moved], stiffness=C, damping=B)
    )
    pressed = mbs.AddLoad(items.LoadCoordinate(markerNumber=moved, load=CLOSING))
    name = "springForceUserFunction"
    function = CreateSymbolicUserFunction(mbs, force, name, contact)
    mbs.SetObjectParameter(contact, name, function)
    function_of_load = CreateSymbolicUserFunction(mbs, load, "loadUserFunction", pressed)
    mbs.SetLoadParameter(pressed, "loadUserFunction", function_of_load)
    kind = exu.OutputVariableType.Coordinates
    sensor = mbs.AddSensor(
        items.SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=kind)
    )
    spent = _exudyn_solve(mbs, _exudyn_settings(steps, 0.5))
    return spent, float(mbs.GetSensorStoredData(sensor)[:, 1].max())


# ---- side by side ------------------------------------------------------------------------------

# Program, module, what solves, what its settings are called, settings from coarse to fine.
PROGRAMS: dict[str, tuple[str, Callable[[str, float], Solved], str, dict[str, list[float]]]] = {
    "dam": (
        "dam",
        by_dam,
        "tolerance",
        {problem: [1e-6, 1e-9, 1e-12] for problem in SCENES},
    ),
    "Exudyn": (
        "exudyn",
        by_exudyn,
        "steps",
        {
            "slider-crank": [100, 500, 2500, 12500],
            "rocker": [5000, 20000, 80000],
            "four-bar": [500, 2500, 12500, 62500],
        },
    ),
    "SciPy": (
        "scipy",
        by_scipy,
        "rtol",
        {problem: [1e-5, 1e-8, 1e-11] for problem in SCENES},
    ),
}


def measured(program: str, problem: str, setting: float, repeats: int) -> tuple[float, float]:
    """Least time (s) and error, relative to the scale of the problem."""
    solve = PROGRAMS[program][1]
    runs: list[Solved] = []
    begin = time.perf_counter()
    while len(runs) < repeats and (not runs or time.perf_counter() - begin < LONG):
        runs.append(solve(problem, setting))
    _, truth, scale, _ = TRUTH[problem]
    return min(spent for spent, _ in runs), abs(runs[-1][1] - truth) / scale


def compare(quick: bool) -> list[str]:
    """Prints the tables; what is out of its bound with `quick`."""
    faults = []
    for problem, (figure, truth, _, source) in TRUTH.items():
        print(f"\n{problem}: {figure} = {truth!r}\n  by {source}")
        print(f"  {'program':<8} {'setting':>16} {'time':>12} {'error':>9}")
        for program, (module, _, name, ladder) in PROGRAMS.items():
            if importlib.util.find_spec(module) is None:
                print(f"  {program:<8} not installed")
                continue
            settings = ladder[problem][1:2] if quick else ladder[problem]
            for setting in settings:
                spent, error = measured(program, problem, setting, 1 if quick else 5)
                said = f"{name} {setting:g}"
                print(f"  {program:<8} {said:>16} {spent * 1e3:>9.3f} ms {error:>9.1e}")
                if quick and not error <= BOUNDS[program]:
                    faults.append(f"{program} is {error:.1e} off in {problem}")
    return faults


def first_answers(wheel: str | None) -> None:
    """From `pip install` to the first answer, each in an empty environment."""
    print("\nfrom pip install to the first answer (slider-crank), in an empty environment")
    for program, (module, _, _, ladder) in PROGRAMS.items():
        requirement = wheel if program == "dam" else module
        if requirement is None:
            continue
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-m", "venv", folder], check=True)
            python = f"{folder}/bin/python"
            install = [python, "-m", "pip", "install", "-q", "--no-cache-dir", requirement]
            setting = ladder["slider-crank"][1]
            asked = [python, "-I", __file__, "--one", program, "slider-crank", str(setting)]
            begin = time.perf_counter()
            subprocess.run(install, check=True, stderr=subprocess.DEVNULL)
            installed = time.perf_counter()
            answer = subprocess.run(asked, check=True, capture_output=True, text=True)
            done = time.perf_counter()
        print(
            f"  {program:<8} {done - begin:6.1f} s ({installed - begin:.1f} s of pip), "
            f"answer {answer.stdout.strip()}"
        )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--install", metavar="WHEEL")
    parser.add_argument("--one", nargs=3, metavar=("PROGRAM", "PROBLEM", "SETTING"))
    options = parser.parse_args()
    if options.one:
        program, problem, setting = options.one
        print(repr(PROGRAMS[program][1](problem, float(setting))[1]))
        return
    faults = compare(options.quick)
    if options.install:
        first_answers(options.install)
    if faults:
        raise SystemExit("\n".join(faults))


if __name__ == "__main__":
    main()
