"""What scenes are made of in Python, before it is read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from inspect import signature
from typing import Union

from dam._dam import Own

__all__ = ["Own", "Quantity", "Tree", "Value"]

Quantity = Union[int, float, str]
"""A number in SI units, or a text with its unit: `0.1`, `"50 mm"`, `"600 rpm"`."""

Value = Union[
    None, bool, int, float, str, "Tree", Own, Sequence["Value"], Mapping[str, "Value"]
]
"""What a property may be given."""


class Tree:
    """Named properties; those that are `None` are left out."""

    __slots__ = ("_members",)

    def __init__(self, *members: tuple[str, Value]) -> None:
        self._members: dict[str, Value] = {
            name: value for name, value in members if value is not None
        }

    def _tree_(self) -> dict[str, Value]:
        return self._members

    def __getitem__(self, name: str) -> Value:
        return self._members[name]

    def __getattr__(self, name: str) -> Value:
        """A property by its name, as it was given: `Motion(speed="300 rpm").speed`; `None`: it
        was left out."""
        if name.startswith("_") or name not in signature(type(self).__init__).parameters:
            raise AttributeError(f"{type(self).__name__} has no property {name!r}")
        return self._members.get(name.rstrip("_"))

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and self._members == getattr(other, "_members", None)

    def __hash__(self) -> int:
        return hash((type(self), tuple(self._members)))

    def __repr__(self) -> str:
        inner = (f"{name}={value!r}" for name, value in self._members.items() if name != "kind")
        return f"{type(self).__name__}({', '.join(inner)})"
