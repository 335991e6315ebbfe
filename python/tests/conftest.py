"""Where the scenes are, and small ones made in code."""

from __future__ import annotations

from pathlib import Path

import pytest

import dam
from dam import kinds

SCENARIOS = Path(__file__).parents[2] / "scenarios"


@pytest.fixture(scope="session")
def scenarios() -> Path:
    return SCENARIOS


@pytest.fixture
def rocker(scenarios: Path) -> dam.Scene:
    return dam.load(scenarios / "rocker" / "two_masses.json")


@pytest.fixture
def table() -> dam.Scene:
    """A shaking table on an eccentric, of which U = e·(1 − cos φ) has a closed form."""
    return dam.Scene(
        "Shaking table",
        {
            "shaft": kinds.Drive(motion=kinds.Motion(speed="300 rpm")),
            "table": kinds.Slider(
                "shaft",
                position=kinds.Position(
                    sine=kinds.Sine(amplitude="10 mm", phase="-90 deg", offset="10 mm")
                ),
                inertia="3 kg",
                stiffness="5e6 N/m",
                damping_capacity=0.2,
                masses=1,
            ),
        },
        run=kinds.Run(duration="1 s"),
    )
