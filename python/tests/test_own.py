"""Python functions in scenes."""

from __future__ import annotations

import math

import pytest

import dam
from dam import kinds, own


def on_shaft(duration: float = 1.0, **properties: object) -> dam.Scene:
    made: dict[str, object] = {
        "kind": "slider",
        "input": "shaft",
        "inertia": "3 kg",
        "stiffness": "5e6 N/m",
        "damping_capacity": 0.2,
        "masses": 1,
        **properties,
    }
    return dam.Scene(
        "Shaking table",
        {"shaft": kinds.Drive(motion={"speed": "300 rpm"}), "table": made},  # type: ignore[dict-item]
        run=duration,
    )


def eccentric(phi: float) -> float:
    return 0.01 * (1 - math.cos(phi))


def test_a_position_function_is_that_of_the_library(table: dam.Scene) -> None:
    asked = 0

    def counted(phi: float) -> float:
        nonlocal asked
        asked += 1
        return eccentric(phi)

    made = own.position(counted, first=lambda phi: 0.01 * math.sin(phi))
    before = asked
    assert made.values is not None and made.values < 1000
    run = on_shaft(position=made).run()
    # Never asked again.
    assert asked == before
    known = table.run()
    for name in ("delta_abs", "peak_acceleration", "peak_reaction"):
        address = f"table.{name}"
        assert run.figures[address] == pytest.approx(known.figures[address], rel=1e-7)


def test_breaks_are_named() -> None:
    with pytest.raises(dam.SceneError, match="not smooth near φ = 3.14"):
        own.position(lambda phi: abs(math.sin(phi)), breaks=[0.0])
    assert own.position(lambda phi: abs(math.sin(phi)), breaks=[0.0, math.pi])
    with pytest.raises(dam.SceneError, match="breaks lie"):
        own.position(math.sin, breaks=[7.0])
    with pytest.raises(dam.SceneError, match="period"):
        own.position(math.sin, period=math.nan)


def test_a_derivative_that_is_wrong_is_told() -> None:
    assert own.position(math.sin, first=math.cos, second=lambda phi: -math.sin(phi))
    with pytest.raises(dam.SceneError, match=r"U′\(.*\) is said to be"):
        own.position(math.sin, first=math.sin)


def test_what_a_function_raises_is_raised() -> None:
    def fail(*_: float) -> float:
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        own.position(fail)
    load = own.load_function(fail, magnitude=10.0)
    scene = on_shaft(0.1, position={"sine": {"amplitude": 0.01}}, loads={"mine": load})
    with pytest.raises(LookupError, match="mine"):
        scene.run()
    # And the next question is answered.
    assert on_shaft(0.1, position={"sine": {"amplitude": 0.01}}).run().is_trusted


def test_a_load_is_that_of_the_library() -> None:
    position = {"sine": {"amplitude": 0.01}}
    # A spring and a damper.
    mine = own.load_function(lambda x, v: -2000.0 * x - 50.0 * v, magnitude=50.0)
    run = on_shaft(0.5, position=position, loads={"mine": mine}).run()
    loads = {"spring": {"spring": {"rate": 2000.0}}, "damper": {"viscous": 50.0}}
    known = on_shaft(0.5, position=position, loads=loads)
    found, expected = run.figures["table.delta_abs"], known.run().figures["table.delta_abs"]
    assert found == pytest.approx(expected, rel=1e-4)
    with_slopes = own.load_function(
        lambda x, v: -2000.0 * x - 50.0 * v, magnitude=50.0, slopes=lambda x, v: (-2000.0, -50.0)
    )
    run = on_shaft(0.5, position=position, loads={"mine": with_slopes}).run()
    assert run.figures["table.delta_abs"] == pytest.approx(expected, rel=1e-4)
    with pytest.raises(ValueError, match="magnitude"):
        own.load_function(lambda x, v: 0.0, magnitude=-1.0)


def test_a_law_is_that_of_the_library() -> None:
    law = own.motion_law(lambda tau: tau**3 * (10 - 15 * tau + 6 * tau**2))
    cam = {"lift": "10 mm", "rise": "90 deg", "dwell": "90 deg", "return": "90 deg"}
    mine = on_shaft(0.4, position={"cam": {**cam, "law": law}}).run()
    known = on_shaft(0.4, position={"cam": {**cam, "law": "3-4-5"}}).run()
    found = mine.figures["table.peak_speed"]
    assert found == pytest.approx(known.figures["table.peak_speed"], rel=1e-4)
    with pytest.raises(dam.SceneError, match="θ"):
        own.motion_law(lambda tau: 0.5 * tau)
    with pytest.raises(dam.SceneError, match="strays"):
        own.motion_law(lambda tau: 0.0 if tau < 0.5 else 1.0)


def test_a_kind_of_ones_own() -> None:
    def pump(identifier: str, properties: object) -> own.Expansion:
        assert isinstance(properties, dict)
        return {
            f"{identifier}_gear": {
                "kind": "shaft",
                "input": properties["input"],
                "position": {"ratio": {"ratio": properties["ratio"]}},
                "inertia": 0.01,
                "masses": 0,
            },
            identifier: {
                "kind": "slider",
                "input": f"{identifier}_gear",
                "position": {"sine": {"amplitude": properties["stroke"]}},
                "inertia": 1.0,
                "masses": 0,
            },
        }

    text = """{"dam": 1, "name": "Pump", "run": {"duration": 0.2}, "objects": {
        "shaft": {"kind": "drive", "motion": {"speed": "300 rpm"}},
        "pump": {"kind": "pump", "input": "shaft", "ratio": 0.5, "stroke": 0.02}}}"""
    scene = own.expand(text, {"pump": pump})
    run = scene.run()
    assert run.figures["pump.peak_speed"] == pytest.approx(0.02 * 5 * math.pi, rel=1e-3)
    with pytest.raises(dam.SceneError, match="already"):
        own.expand(text, {"pump": lambda name, _: {"shaft": {}}})
