"""A rocker on its cam, made in code: how many masses are enough, and where it lifts off."""

from __future__ import annotations

import dam
from dam import kinds

scene = dam.Scene(
    "Rocker of a cam mechanism",
    {
        "shaft": kinds.Drive(motion=kinds.Motion(speed="10 rev/s")),
        "rocker": kinds.Rocker(
            "shaft",
            position=kinds.Position(sine=kinds.Sine(amplitude="90 deg")),
            inertia=0.1,
            stiffness=1e7,
            damping_capacity=0.4,
            masses=2,
            pair=kinds.Pair(closure="force"),
            loads={"closing": kinds.Load(constant="-600 N m")},
        ),
    },
    run="0.5 s",
)

run = scene.run()
delta = run.figures["rocker.delta_max"]
print(run)
print(f"greatest δ: {float(delta):.5f} {delta.unit}, {run.figures['rocker.pair.separations']:.0f} openings")

compared = scene.compare("rocker.masses", [1, 2, 5])
for value in compared.record["rocker.delta_max"]:
    print(f"{value:.5f}")

found = scene.set("run.duration", 0.1).map(
    ("rocker.inertia", 0.05, 0.2, 4), figure="rocker.pair.separations"
)
for inertia, verdict in zip(found.x, found.verdicts):
    print(f"{inertia:.2f} kg m²: {verdict}")
