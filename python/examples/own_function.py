"""A position function and a load of one's own."""

from __future__ import annotations

import math

import dam
from dam import kinds, own


def eccentric(phi: float) -> float:
    return 0.02 * (1 - math.cos(phi)) / 2


def brush(displacement: float, speed: float) -> float:
    """Friction of a brush: −10 N·tanh."""
    return -10.0 * math.tanh(speed / 0.05)


scene = dam.Scene(
    "Shaking table",
    {
        "shaft": kinds.Drive(motion=kinds.Motion(speed="300 rpm")),
        "table": kinds.Slider(
            "shaft",
            position=own.position(eccentric),
            inertia="3 kg",
            stiffness="5e6 N/m",
            masses=1,
            loads={"brush": own.load_function(brush, magnitude=10.0)},
        ),
    },
    run=kinds.Run(duration="0.4 s"),
)

run = scene.run()
print(run.verdict)
print(run.figures["table.delta_abs"])
