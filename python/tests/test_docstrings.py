"""Every public function and class has an example in its docstring, and it runs."""

from __future__ import annotations

import doctest
import importlib
import inspect
import os
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

import dam
from dam import kinds

MODULES = ("answers", "distributed", "errors", "kinds", "own", "prepared", "scene")
EXTRAS = ("pandas", "xarray", "pyarrow", "scipy", "control", "matplotlib", "tqdm", "zarr", "sympy")
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def _public(module: ModuleType) -> Iterator[tuple[str, object]]:
    """Functions, classes and their methods, by their names."""
    for name in module.__all__:
        found = getattr(module, name)
        if not (inspect.isfunction(found) or inspect.isclass(found)):
            continue
        yield name, found
        if inspect.isclass(found):
            for own, method in vars(found).items():
                if inspect.isfunction(method) and not own.startswith("_"):
                    yield f"{name}.{own}", method


PUBLIC = {
    f"{module}.{name}": found
    for module in MODULES
    for name, found in _public(importlib.import_module(f"dam.{module}"))
}


def _own_docstring(found: object) -> str:
    # Not that of a base class.
    return vars(found).get("__doc__") or "" if inspect.isclass(found) else found.__doc__ or ""


def _is_alone(name: str) -> bool:
    """Whether nothing shows it but itself: methods of protocols are shown by their class."""
    return not name.startswith(("distributed.Client.", "distributed.Future.", "scene.Tqdm."))


@pytest.fixture
def folder(scenarios: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where examples may write, and see the scenarios."""
    for extra in EXTRAS:
        pytest.importorskip(extra)
    monkeypatch.setenv("MPLBACKEND", "agg")
    (tmp_path / "scenarios").symlink_to(scenarios)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_all_of_the_package_is_here() -> None:
    assert set(dam.__all__) - {"__version__", *MODULES} <= {
        name.partition(".")[2] for name in PUBLIC
    }
    assert len(PUBLIC) > 180


@pytest.mark.parametrize("name", [name for name in PUBLIC if _is_alone(name)])
def test_a_docstring_has_an_example_that_runs(name: str, folder: Path) -> None:
    docstring = _own_docstring(PUBLIC[name])
    known: dict[str, object] = {"dam": dam, "kinds": kinds}
    test = doctest.DocTestParser().get_doctest(docstring, known, name, None, None)
    assert test.examples, f"{name} has no example"
    told: list[str] = []
    doctest.DocTestRunner(optionflags=FLAGS).run(test, out=told.append)
    assert not told, "".join(told)
    assert os.getcwd() == str(folder)


@pytest.mark.parametrize("name", [name for name in PUBLIC if inspect.isclass(PUBLIC[name])])
def test_properties_are_shown_by_their_class(name: str) -> None:
    found = PUBLIC[name]
    for own, member in vars(found).items():
        if isinstance(member, property) and not own.startswith("_"):
            assert member.__doc__, f"{name}.{own}"
            assert f".{own}" in _own_docstring(found), f"no example shows {name}.{own}"


@pytest.mark.parametrize("module", MODULES)
def test_examples_see_what_is_wrong(module: str) -> None:
    # An example whose output is another one fails: the runner is not silent.
    test = doctest.DocTestParser().get_doctest(">>> 1 + 1\n3\n", {}, module, None, None)
    told: list[str] = []
    assert doctest.DocTestRunner(optionflags=FLAGS).run(test, out=told.append).failed == 1
    assert told
