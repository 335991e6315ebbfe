"""Every study but runs: what it finds is what is known otherwise."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy
import pytest

import dam
from dam import answers, kinds


def test_a_map_is_runs_at_its_points(rocker: dam.Scene) -> None:
    scene = rocker.set("run.duration", 0.1)
    x = ("rocker.inertia", 0.05, 1.0, 3)
    y = ("rocker.stiffness", 1e6, 1e8, 2, "log")
    found = scene.map(x, y, figure="rocker.delta_max", threads=2)
    assert found.shape == (2, 3) and found.figure == "rocker.delta_max" and found.unit == "rad"
    assert found.x == pytest.approx([0.05, 0.525, 1.0])
    assert found.y == pytest.approx([1e6, 1e8])
    alone = scene.set("rocker.inertia", 0.05).set("rocker.stiffness", 1e6).run()
    assert found.values[0, 0] == pytest.approx(alone.figures["rocker.delta_max"], rel=1e-9)
    assert found.verdicts[:2] == ["not_judged", "lift_off_not_judged"]
    assert len(found.causes) == 6
    # The verdict of a cell is that of the run at its values.
    assert found.judgements[:2] == ["not_judged", "not_judged"]
    assert found.judgements[0] == alone.judgement and found.rigid is None
    one = scene.map(x, y, figure="rocker.delta_max", threads=1)
    assert (one.values == found.values).all() and one.hash == found.hash
    assert "svg" in found.page() and "rocker" in found.text()


def test_a_map_as_a_data_set(rocker: dam.Scene) -> None:
    pytest.importorskip("xarray")
    scene = rocker.set("run.duration", 0.05)
    both = scene.map("rocker.inertia=0.05:0.1:2", "rocker.stiffness=1e6:1e7:3").to_xarray()
    assert both["value"].dims == ("rocker.stiffness", "rocker.inertia")
    assert both["verdict"].shape == (3, 2) and both["value"].attrs["units"] == "rad"
    curve = scene.map("rocker.inertia=0.05:0.1:2").to_xarray()
    assert curve["value"].dims == ("rocker.inertia",) and curve["cause"].shape == (2,)
    assert list(curve["judgement"].to_numpy()) == ["not_judged", "not_judged"]


def test_a_budget_that_is_spent_is_not_judged(rocker: dam.Scene) -> None:
    scene = rocker.set("run.max_switches", 5)
    found = scene.map("rocker.inertia=0.1:0.11:2")
    assert found.verdicts == ["not_finished"] * 2
    assert found.judgements == ["not_judged"] * 2
    run = scene.set("rocker.inertia", 0.1).run()
    assert run.judgement == "not_judged" and run.verdict is not None
    assert run.verdict.sort == "unfinished"
    refused = scene.map("rocker.inertia=-0.05:0.05:2")
    assert refused.judgements[0] is None


def test_results_without_elasticity_are_labelled(scenarios: Path) -> None:
    follower = dam.load(scenarios / "cams" / "eccentric_jump.json")
    spring = dam.load(scenarios / "joint_friction" / "stick_slip.json")
    crank = dam.load(scenarios / "kinetostatics" / "slider_crank.json")
    cell = follower.map("follower.stiffness=1e6:2e6:2", figure="cam.follower.base_radius")
    labelled = [
        (follower.cam(reserve=0.0), "follower", "not_judged"),
        (spring.kinematics(), "spring", "not_judged"),
        (spring.forces(), "spring", "not_judged"),
        (cell, "follower", None),
    ]
    for found, id, judgement in labelled:
        label = found.rigid
        assert label is not None and label["without"] == [id]
        assert label["included_by"] in (["dam run"], ["dam run", "dam cam --lift-off"])
        assert found.judgement == judgement
        assert f"without the elasticity of {id}" in " ".join(found.text().split())
    for whole in (crank.kinematics(), crank.forces()):
        assert whole.rigid is None and whole.judgement == "in_working_order"
        assert "In working order." in whole.text()
    steady = dam.load(scenarios / "steady" / "press_motor.json").steady()
    assert steady.judgement == "in_working_order" and steady.rigid is None
    assert isinstance(steady.document["rigid_motion"], dict)


def test_progress_rises_to_one(rocker: dam.Scene) -> None:
    told: list[float] = []
    rocker.map("rocker.inertia=0.05:1:12", progress=told.append)
    assert told == sorted(told) and told[-1] == 1.0
    assert all(0.0 < share <= 1.0 for share in told)


def test_tqdm_is_told(rocker: dam.Scene) -> None:
    tqdm = pytest.importorskip("tqdm")
    with tqdm.tqdm(total=1.0, disable=False, file=open("/dev/null", "w")) as bar:
        rocker.run(progress=bar)
        assert bar.n == pytest.approx(1.0)


def test_what_progress_raises_ends_the_computation(rocker: dam.Scene) -> None:
    def fail(share: float) -> None:
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        rocker.set("run.duration", 50.0).set("run.method", "dop853").run(progress=fail)


def test_a_comparison_has_a_row_a_run(rocker: dam.Scene) -> None:
    scene = rocker.set("run.duration", 0.1)
    found = scene.compare("rocker.masses", [1, 2, 5])
    delta = found.record["rocker.delta_abs"]
    assert len(delta) == 3
    for masses, value in zip((1, 2, 5), delta):
        run = scene.set("rocker.masses", masses).run()
        assert value == run.figures["rocker.delta_abs"]
    assert "masses of rocker" in found.page()
    with pytest.raises(dam.SceneError):
        scene.compare("rocker.masses", [])


def test_methods_are_measured(rocker: dam.Scene) -> None:
    scene = rocker.set("run.duration", 0.02)
    found = scene.methods(
        methods=["exact", "dop853"], tolerances=[1e-4, 1e-8], repeats=1, accuracy=1e-3
    )
    assert found.recommended in ("exact", "dop853")
    assert len(found.record["error"]) >= 2
    assert "Error against time" in found.page()
    with pytest.raises(dam.SceneError, match="no method `euler`"):
        scene.methods(methods=["euler"])


def test_a_linkage_moves_and_carries(scenarios: Path) -> None:
    scene = dam.load(scenarios / "linkages" / "slider_crank_spring.json")
    moved = scene.kinematics(positions=72)
    assert len(moved.record) == 73
    assert moved.record.index is not None
    carried = scene.forces(positions=72, speed=30.0)
    assert len(carried.record) in (72, 73)
    assert "Driving moment" in carried.text()
    with pytest.raises(TypeError):
        scene.kinematics(turn=True, time=1.0)
    with pytest.raises(dam.SceneError):
        scene.kinematics("nothing")


def test_a_steady_motion_closes(scenarios: Path) -> None:
    found = dam.load(scenarios / "steady" / "engine.json").steady()
    speed = found.record["omega"]
    assert speed[0] == pytest.approx(speed[-1], rel=1e-9)
    assert "fluctuates" in repr(found)


def test_linear_equations_answer_as_python_control_does(scenarios: Path) -> None:
    control = pytest.importorskip("control")
    scene = dam.load(scenarios / "rocker" / "two_masses.json")
    found = scene.linearise()
    system = found.to_control()
    assert isinstance(system, control.StateSpace)
    assert (system.A == found.matrix("A")).all() and (system.D == found.matrix("D")).all()
    frequencies = [10.0, 500.0, 1500.0, 2100.0, 4000.0]
    response = scene.response(frequencies, inputs=["rocker.law", "rocker.load"])
    inputs, outputs = found.names("inputs"), found.names("outputs")
    answer: Any = response.document
    for pair in answer["pairs"]:
        column, row = inputs.index(pair["input"]["name"]), outputs.index(pair["output"]["name"])
        for place, frequency in enumerate(frequencies):
            s = 2j * math.pi * frequency
            own = system(s)[row]
            orders = range(3) if pair["input"]["name"].endswith(".law") else range(1)
            theirs = sum(own[column + order] * s**order for order in orders)
            ours = complex(pair["re"][place], pair["im"][place])
            # What cancels between the law and the deviation is of the size of the law.
            terms = sum(abs(own[column + order] * s**order) for order in orders)
            assert abs(ours - theirs) <= 1e-12 * terms
    with pytest.raises(dam.SceneError, match="rocker.delta"):
        scene.response(outputs="rocker.delt")


def test_orders_of_a_sine_are_one(scenarios: Path) -> None:
    found = dam.load(scenarios / "rocker" / "two_masses.json").orders(points=2, highest=5)
    answer: Any = found.document
    (tree,) = answer["trees"]
    assert [order["present"] for order in tree["orders"]] == [True] + [False] * 4
    assert tree["orders"][0]["amplitude"] == pytest.approx(math.pi / 2, rel=1e-14)


def test_a_cam_has_its_profile(scenarios: Path) -> None:
    scene = dam.load(scenarios / "cams" / "flat_tappet.json")
    found = scene.cam(speed="3000 rpm", reserve="50 N")
    phi = found.record["phi"]
    assert phi[-1] == pytest.approx(math.tau)
    assert found.dxf.startswith("  0") or "SECTION" in found.dxf
    assert found.svg.lstrip().startswith("<svg")
    followed = scene.law("valve", samples=90)
    assert len(followed.record["phi"]) >= 91
    with pytest.raises(dam.SceneError, match="tolerance"):
        scene.cam(tolerance=-1.0)


def test_an_elastic_follower_lifts_off(scenarios: Path) -> None:
    scene = dam.load(scenarios / "cams" / "eccentric_jump.json")
    assert scene.cam().lift_off is None
    found = scene.cam(lift_off=True)
    # The closed form of the scenario's table: 52.30 rpm.
    assert found.lift_off == pytest.approx(52.30 * math.tau / 60, rel=2e-3)
    assert "lift-off, elastic" in found.text()


def test_methods_beside_models_and_over_a_parameter(rocker: dam.Scene) -> None:
    closed = rocker.set("rocker.loads.closing.constant", -1000).set("run.duration", 0.02)
    found = closed.methods(methods=["exact", "dop853"], repeats=1, models=True, tolerances=[1e-6])
    models = found.document["models"]
    assert isinstance(models, dict) and models["asked"] == 0.01
    error, levels = models["error"], models["levels"]
    # One mode is enough, and rigid would not be.
    assert isinstance(error, float) and error < 0.01 and isinstance(levels, dict)
    assert levels["rocker"] == {"count": 1, "level": "modes"}
    assert found.recommended in ("exact", "dop853")
    over = closed.methods(
        methods=["exact"], repeats=1, tolerances=[1e-6], x="rocker.stiffness=1e6:1e8:3:log"
    )
    slices = over.document["slices"]
    assert isinstance(slices, list) and len(slices) == 3
    assert over.recommended is None
    with pytest.raises(dam.SceneError, match="models"):
        closed.methods(models=True, x="rocker.stiffness=1e6:1e8:3:log")


def test_several_panels_are_several_maps(rocker: dam.Scene) -> None:
    scene = rocker.set("run.duration", 0.02)
    axes = ("rocker.inertia=0.05:0.2:3", "rocker.stiffness=1e6:1e7:2")
    found = scene.map(*axes, panels="rocker.masses=1,2")
    assert found.shape == (2, 2, 3) and len(found.panels) == 2
    data = found.to_xarray()
    for panel, masses in enumerate((1, 2)):
        alone = scene.set("rocker.masses", masses).map(*axes)
        assert (found.values[panel] == alone.values).all()
        assert (data["value"][panel].to_numpy() == alone.values).all()
        assert (found.y == alone.y).all() and (found.x == alone.x).all()
    assert alone.panels == [] and alone.shape == (2, 3)
    with pytest.raises(dam.SceneError):
        scene.map(*axes, panels=["rocker.masses=1,2; run.duration=1"])


def test_a_law_has_its_constants() -> None:
    found = dam.law("3-4-5", samples=200)
    tau, theta = found.record["tau"], found.record["theta"]
    assert theta == pytest.approx(10 * tau**3 - 15 * tau**4 + 6 * tau**5, abs=1e-12)
    with pytest.raises(dam.SceneError):
        dam.law("4-5")
    with pytest.raises(ValueError):
        dam.law("3-4-5", samples=0)


def test_laws_are_compared_in_a_scene(scenarios: Path) -> None:
    scene = dam.load(scenarios / "cams" / "flat_tappet.json")
    at = "valve.position.cam.law"
    found = scene.compare_laws(at, ["3-4-5", "modified_sine"], by="driver_torque")
    laws = found.document["laws"]
    assert found.document["by"] == "driver_torque" and isinstance(laws, list)
    # The run of the scene with the law in place has the same figure.
    for law, name in zip(laws, ["3-4-5", "modified_sine"], strict=True):
        assert isinstance(law, dict) and isinstance(law["response"], dict)
        force = scene.set(at, name).run().figures["valve.pair.max_contact_force"]
        assert law["response"]["contact_force"] == pytest.approx(force, rel=1e-9)
    assert "modified sine" in found.text()
    with pytest.raises(dam.SceneError, match="between 2 and"):
        scene.compare_laws(at, ["3-4-5"])
    with pytest.raises(dam.SceneError, match="ranked by"):
        scene.compare_laws(at, by="beauty")  # type: ignore[arg-type]


def test_a_stroke_is_worked_out() -> None:
    found = dam.stroke("sine", stroke="50 mm", span="120 deg", uniform_stroke=0.3, samples=90)
    figures = found.document["figures"]
    assert isinstance(figures, dict)
    # Between two sines the mean speed of run-up and run-out is half the greatest:
    # 35 mm take 70 mm of uniform speed, 15 mm themselves.
    assert figures["peak_speed"] == pytest.approx(0.085 / math.radians(120))
    with pytest.raises(dam.SceneError):
        dam.stroke("sine", stroke="50 mm")
    with pytest.raises(ValueError, match="exclude"):
        dam.stroke("sine", stroke="1", span="1", uniform_stroke=0, skewness=1, least_torque=1)


def test_the_best_value_meets_its_condition(scenarios: Path) -> None:
    scene = dam.load(scenarios / "rocker/two_masses.json")
    found = scene.find(
        "rocker.inertia=0.05:0.4",
        subject="rocker.delta_abs <= 20 mrad",
        maximize="rocker.inertia",
    )
    assert found.answered and found.value is not None
    inside, beyond = (
        float(scene.set("rocker.inertia", found.value * part).run().figures["rocker.delta_abs"])
        for part in (1.0, 1.0 + 1e-6)
    )
    assert inside <= 0.02 < beyond
    assert found.ranges == [(0.05, found.value)]
    with pytest.raises(TypeError):
        scene.find("rocker.inertia=0.05:0.4", maximize="a", minimize="b")
    with pytest.raises(dam.SceneError):
        scene.find("rocker.inertia=0.05:0.4", subject="rocker.delta <= 1")


def test_derivatives_go_through_contacts(scenarios: Path) -> None:
    scene = dam.load(scenarios / "rocker" / "two_masses.json")
    found = scene.gradient("rocker.inertia", ["rocker.delta_max", "rocker.pair.closures"])
    assert found.answered
    # Of tests/reference/design-gradients.json.
    slope = found.derivative("rocker.delta_max", "rocker.inertia")
    assert slope == pytest.approx(4.4863653894093365, rel=1e-8)
    assert found.verdict_of("rocker.pair.closures", "rocker.inertia") == "not applicable"
    with pytest.raises(dam.SceneError, match="counts"):
        scene.gradient("rocker.masses")


def test_tolerances_are_those_of_a_slider_crank(scenarios: Path) -> None:
    scene = dam.load(scenarios / "kinetostatics/slider_crank.json")
    crank, rod = (f"mechanism.links.{name}[0]" for name in ("crank.points.A", "rod.points.C"))
    stroke = "kinematics.mechanism.slide.stroke"
    found = scene.tolerance(
        {crank: "±0.05 mm", rod: "±0.1 mm uniform"},
        limits=f"{stroke} <= 120.05 mm",
        samples=100,
    )
    assert found.answered
    # The stroke is twice the crank.
    assert found.worst_case(stroke) == pytest.approx((0.1199, 0.1201), rel=1e-12)
    assert found.sigma(stroke) == pytest.approx(1e-4 / 3, rel=1e-9)
    assert found.effect(stroke, crank)["derivative"] == pytest.approx(2.0, rel=1e-9)
    # 1.5 standard deviations.
    assert found.share == pytest.approx(0.93319, abs=0.03)
    assert found.interval is not None and found.interval[0] < 0.93319 < found.interval[1]
    samples = found.record
    assert len(samples[stroke]) == 100
    assert samples[stroke] == pytest.approx(2.0 * samples[crank], rel=1e-12)
    again = scene.tolerance(
        [f"{crank}=±0.05 mm", f"{rod}=±0.1 mm uniform"], stroke, samples=100, threads=1
    )
    assert (again.record[stroke] == samples[stroke]).all()
    with pytest.raises(dam.SceneError, match="one limit"):
        scene.tolerance({crank: "0.05 mm"}, stroke)


def test_a_scene_holds_the_question_of_its_tolerances(scenarios: Path) -> None:
    tree = json.loads((scenarios / "kinetostatics/slider_crank.json").read_text(encoding="utf-8"))
    crank = "mechanism.links.crank.points.A[0]"
    stroke = "kinematics.mechanism.slide.stroke"
    block = kinds.Tolerance(tol=[f"{crank}=±0.05 mm"], figures=[stroke], samples=16)
    scene = dam.Scene("press", tree["objects"], tree["run"], tolerance=block)
    found = scene.tolerance()
    assert found.worst_case(stroke) == pytest.approx((0.1199, 0.1201), rel=1e-12)
    assert len(found.record[stroke]) == 16
    assert len(scene.tolerance(samples=32).record[stroke]) == 32


def test_a_scene_holds_the_question_of_its_records(scenarios: Path, tmp_path: Path) -> None:
    tree = json.loads((scenarios / "shafts/free_vibration.json").read_text(encoding="utf-8"))
    tree["identify"] = {
        "record": ["released_wheel.csv"],
        "match": ["deflection=wheel.delta"],
        "vary": ["wheel.stiffness=5000:12000", "wheel.damping_capacity=0:1"],
        "starts": 2,
    }
    del tree["$schema"]
    path = tmp_path / "wheel.json"
    path.write_text(json.dumps(tree), encoding="utf-8")
    record = (scenarios / "shafts/released_wheel.csv").read_text(encoding="utf-8")
    (tmp_path / "released_wheel.csv").write_text(record, encoding="utf-8")
    own = dam.load(path).identify()
    stiffness = own.estimates["wheel.stiffness"]
    assert own.answered and stiffness is not None
    assert stiffness[0] == pytest.approx(8250, rel=1e-3)
    # Without the second number the damping of the scene does not explain the record.
    one = dam.load(path).identify(vary="wheel.stiffness=5000:12000")
    assert list(one.estimates) == ["wheel.stiffness"]


def test_requirements_are_judged(scenarios: Path) -> None:
    scene = dam.load(scenarios / "steady/engine.json")
    found = scene.verify()
    assert found.hold
    assert {one["study"] for one in found} == {"steady"}
    assert found.junit.count("<testcase ") == len(list(found))
    assert not scene.set("crank.motor.inertia", "0.03 kg m^2").verify().hold


def test_a_reduced_scene_keeps_its_figures(scenarios: Path) -> None:
    scene = dam.load(scenarios / "rocker" / "ten_masses_closed.json")
    found = scene.set("run.accuracy", "1 %").reduce()
    assert isinstance(found, answers.Reduction) and found.holds
    delta = scene.run().figures["rocker.delta_abs"]
    left = found.scene.run().figures["rocker.delta_abs"]
    assert left == pytest.approx(delta, rel=0.02)


def test_every_answer_has_all_its_forms(rocker: dam.Scene) -> None:
    for found in (rocker.run(), dam.law("harmonic"), rocker.compare("rocker.masses", [1, 2])):
        assert isinstance(found.document, dict) and found.document["dam"] == 1
        assert isinstance(found.text(60), str) and isinstance(found.warnings, list)
        assert "<html" in found.page()
        for name in found.record:
            assert isinstance(found.record[name], numpy.ndarray)


def test_the_softest_spring_is_held_by_both_forces(scenarios: Path) -> None:
    # Of tests/reference/design-optimum-tolerance.json, case B.
    scene = dam.load(scenarios / "cams/eccentric_jump.json")
    scene = scene.set("follower.masses", 0).set("cam.motion.speed", "200 rpm")
    spring = "follower.loads.spring.spring"
    limits = ["follower.pair.margin >= 0 N", "follower.pair.max_contact_force <= 10 N"]
    found = scene.optimize(
        [f"{spring}.rate=0:5000 N/m", f"{spring}.preload=0:100 N"],
        subject=limits,
        minimize=f"{spring}.rate",
        starts=3,
    )
    assert found.answered and found.values is not None
    assert found.values[f"{spring}.rate"] == pytest.approx(188.649084492860383, rel=1e-6)
    assert found.values[f"{spring}.preload"] == pytest.approx(1.22701831014279234, rel=1e-6)
    assert [found.multipliers[one] for one in limits] == pytest.approx([25.0, -25.0], rel=1e-5)
    assert found.scene_text is not None and '"rate"' in found.scene_text
    with pytest.raises(TypeError):
        scene.optimize(f"{spring}.rate=0:5000", minimize="a", maximize="b")
    with pytest.raises(dam.SceneError, match="minimize"):
        scene.optimize(f"{spring}.rate=0:5000")
    with pytest.raises(dam.SceneError, match="LOW:HIGH"):
        scene.optimize(f"{spring}.rate=5000:0", minimize=f"{spring}.rate")


def test_numbers_come_back_from_a_record(scenarios: Path) -> None:
    scene = dam.load(scenarios / "rocker" / "one_mass.json").set("run.duration", 0.02)
    record = scene.run().record
    columns = {"t [s]": record["time"].tolist(), "x [rad]": record["rocker.delta"].tolist()}
    found = scene.identify(columns, {"x": "rocker.delta"}, "rocker.inertia=0.05:0.3", starts=2)
    estimate = found.estimates["rocker.inertia"]
    assert found.answered and estimate is not None
    assert estimate[0] == pytest.approx(0.1, rel=1e-8) and estimate[1] < 1e-8
    assert found.scene_text is not None and len(found.record) == len(record)
    with_settings = scene.identify(
        [(columns, {"rocker.masses": 1})], {"x": "rocker.delta"}, "rocker.inertia=0.05:0.3", starts=1
    )
    assert with_settings.estimates["rocker.inertia"] == pytest.approx(estimate, rel=1e-6, abs=1e-9)
    wheel = dam.load(scenarios / "shafts" / "free_vibration.json")
    both = wheel.identify(
        scenarios / "shafts" / "released_wheel.csv",
        {"deflection": "wheel.delta"},
        ["wheel.stiffness=5000:12000", "wheel.inertia=0.01:0.03"],
        starts=2,
    )
    assert not both.answered and set(both.estimates.values()) == {None}
    with pytest.raises(ValueError, match="equally long"):
        scene.identify({"t [s]": [0.0], "x [rad]": []}, {"x": "rocker.delta"}, "rocker.inertia=0:1")
    with pytest.raises(dam.SceneError, match="no column"):
        scene.identify(columns, {"y": "rocker.delta"}, "rocker.inertia=0.05:0.3")
