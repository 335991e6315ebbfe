"""Equations for SymPy are those that runs solve."""

from __future__ import annotations

import math
from typing import Any

import numpy
import pytest

import dam

sympy: Any = pytest.importorskip("sympy")

TURN = 10 * math.pi  # rad/s, of 300 rpm


def test_accelerations_are_those_of_a_run(table: dam.Scene) -> None:
    equations = table.linearise().to_sympy()
    (motion,) = equations.motion
    t = equations.time
    record = table.run().record
    time, delta = record["time"], record["table.delta"]
    # U = e·(1 − cos φ).
    law = 0.01 * (1 - sympy.cos(sympy.Float(TURN) * t))
    deviation, rate = sympy.symbols("x v")
    q = motion.lhs.expr
    right = motion.rhs.subs({sympy.Function("table_law", real=True)(t): law}).doit()
    right = right.subs({sympy.Function("table_load", real=True)(t): 0})
    right = right.subs(sympy.Derivative(q, t), rate).subs(q, deviation)
    assert right.free_symbols == {t, deviation, rate}
    speed = record["table.speed"] - 0.01 * TURN * numpy.sin(TURN * time)
    computed = sympy.lambdify([t, deviation, rate], right, "numpy")(time, delta, speed)
    found = record["table.acceleration"] - 0.01 * TURN**2 * numpy.cos(TURN * time)
    scale = abs(record["table.acceleration"]).max()
    assert scale > 5.0
    numpy.testing.assert_allclose(computed, found, rtol=0, atol=1e-7 * scale)


def test_a_chain_moves_as_its_run(table: dam.Scene) -> None:
    integrate = pytest.importorskip("scipy.integrate")
    scene = table.set("table.masses", 3).set("run.start", "on_law").set("run.duration", 0.1)
    equations = scene.linearise().to_sympy()
    t = equations.time
    qs = [one.lhs.expr for one in equations.motion]
    assert [str(q.func) for q in qs] == [f"table_mass_{place}_deviation" for place in (1, 2, 3)]
    law = 0.01 * (1 - sympy.cos(sympy.Float(TURN) * t))
    states = sympy.symbols("x1:4 v1:4")
    rights = []
    for one in equations.motion:
        right = one.rhs.subs({sympy.Function("table_law", real=True)(t): law}).doit()
        right = right.subs({sympy.Function("table_load", real=True)(t): 0})
        for place, q in enumerate(qs):
            right = right.subs(sympy.Derivative(q, t), states[3 + place])
        rights.append(right.subs(dict(zip(qs, states[:3]))))
    compute = sympy.lambdify([t, *states], [*states[3:], *rights], "math")
    run = scene.run().record
    solved = integrate.solve_ivp(
        lambda time, state: compute(time, *state),
        (0.0, 0.1),
        numpy.zeros(6),
        t_eval=run["time"],
        rtol=1e-9,
        atol=1e-13,
        method="DOP853",
    )
    delta = run["table.delta"]
    assert abs(delta).max() > 1e-6
    numpy.testing.assert_allclose(solved.y[2], delta, rtol=0, atol=1e-5 * abs(delta).max())


def test_outputs_are_those_of_the_state_space(rocker: dam.Scene) -> None:
    linear = rocker.linearise()
    equations = linear.to_sympy()
    # No digit of a matrix is lost.
    numbers = {float(one) for eq in equations.motion for one in eq.rhs.atoms(sympy.Float)}
    matrices = [linear.matrix(name)[2:] for name in "AB"]
    known = {float(one) for matrix in matrices for one in matrix.ravel()}
    assert numbers <= known | {-one for one in known}
    assert [str(one.lhs.func) for one in equations.outputs] == [
        name.replace(".", "_") for name in linear.names("outputs")
    ]
    by_name = {str(one.lhs.func): one.rhs for one in equations.outputs}
    last = sympy.Function("rocker_mass_2_deviation", real=True)(equations.time)
    assert by_name["rocker_delta"] == last


def test_a_machine_behind_a_motor_has_equations(scenarios: Any) -> None:
    linear = dam.load(scenarios / "shafts" / "fan_on_line.json").linearise()
    equations = linear.to_sympy()
    orders = [one.lhs.args[1][1] for one in equations.motion]
    # Each second derivative stands for two states.
    assert sum(int(order) for order in orders) == len(linear.names("states"))
