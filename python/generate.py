"""Writes dam/kinds.py from the JSON Schema of scenes, which comes from the declarations
that scenes are read by: `python python/generate.py`. With --check nothing is written, and
the exit status tells whether the file is as it would be.
"""

from __future__ import annotations

import json
import keyword
import sys
import textwrap
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
SCHEMA = HERE.parent / "scenarios" / "scene.schema.json"
TARGET = HERE / "dam" / "kinds.py"

HEAD = '''"""Everything that a scene holds, as classes: objects of all kinds, and what their properties
are made of. Written by `python/generate.py` from the declarations that scenes are read by.

A quantity is a number in SI units or a text with its unit. What is left out has the default
that is said. Instead of an object of a class, a mapping with the same names is taken.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, Union

from dam._tree import Own, Quantity, Tree, Value

__all__ = {names}
'''


def pascal(name: str) -> str:
    return "".join(part.capitalize() for part in name.split("_"))


def identifier(name: str) -> str:
    return f"{name}_" if keyword.iskeyword(name) else name


def is_text_with_unit(schema: dict[str, Any]) -> bool:
    return schema.get("type") == "string" and "pattern" in schema


class Classes:
    """The classes, in the order in which they are met."""

    def __init__(self, definitions: dict[str, Any]) -> None:
        self.definitions = definitions
        self.variants: dict[str, dict[str, dict[str, Any]]] = {}
        self.names: dict[str, str] = {}
        self.kinds: list[str] = []

    def type_of(self, schema: dict[str, Any], owner: str, name: str) -> str:
        """The type of a property's value."""
        options = self.options(schema, owner, name)
        return " | ".join(dict.fromkeys(options))

    def options(self, schema: dict[str, Any], owner: str, name: str) -> list[str]:
        if "$ref" in schema:
            target = schema["$ref"].rsplit("/", 1)[1]
            return self.options(self.definitions[target], "", target)
        for key in ("anyOf", "oneOf"):
            if key in schema and "properties" not in schema:
                return self.alternatives(schema[key], owner, name)
        if "const" in schema:
            return [f"Literal[{schema['const']!r}]"]
        if "enum" in schema:
            values = ", ".join(repr(value) for value in schema["enum"])
            return [f"Literal[{values}]"]
        kind = schema.get("type")
        if kind == "object":
            return self.mapping(schema, owner, name)
        if kind == "array":
            if "prefixItems" in schema:
                items = schema["prefixItems"]
            else:
                items = [schema.get("items", {})]
            inner: list[str] = []
            for item in items:
                inner += self.options(item, owner, name)
            return [f"Sequence[{' | '.join(dict.fromkeys(inner)) or 'Value'}]"]
        simple = {"number": "float", "integer": "int", "string": "str", "boolean": "bool"}
        return [simple[kind]] if isinstance(kind, str) else ["Value"]

    def alternatives(self, choices: list[Any], owner: str, name: str) -> list[str]:
        found: list[str] = []
        numbers = any(one.get("type") == "number" for one in choices)
        if numbers and any(is_text_with_unit(one) for one in choices):
            found.append("Quantity")
            choices = [
                one
                for one in choices
                if one.get("type") != "number" and not is_text_with_unit(one)
            ]
        for choice in choices:
            found += self.options(choice, owner, name)
        return found

    def mapping(self, schema: dict[str, Any], owner: str, name: str) -> list[str]:
        if "properties" not in schema:
            inner = schema.get("additionalProperties")
            if isinstance(inner, dict):
                return [f"Mapping[str, {self.type_of(inner, owner, name)}]"]
            return ["Mapping[str, Value]"]
        choices = [self.named(schema, owner, name), "Mapping[str, Value]"]
        if "position" in name or "load" in name:
            choices.append("Own")
        return choices

    def named(self, schema: dict[str, Any], owner: str, name: str) -> str:
        """The class of an object with properties. What turns and what slides, and what
        differs in a few properties only, is one class: scenes say where one does not fit."""
        for prefix in ("turning_", "sliding_", "geared_", "rotor_", "output_"):
            name = name.removeprefix(prefix)
        source = json.dumps(schema, sort_keys=True)
        names = set(schema["properties"])
        title = pascal(name)
        if title in self.variants and not self.fits(title, names):
            title = owner + title
        while title in self.variants and not self.fits(title, names):
            title += "Of"
        known = self.variants.setdefault(title, {})
        if source not in known:
            known[source] = schema
            self.names.setdefault(title, name)
            # Its own parts are met now, so that they have their names.
            for key, value in schema["properties"].items():
                self.type_of(value, title, key)
        return title

    def fits(self, title: str, names: set[str]) -> bool:
        known = set().union(*(one["properties"] for one in self.variants[title].values()))
        return known <= names or names <= known or len(known & names) > len(known ^ names)

    def text(self, title: str) -> str:
        """The class with all that its variants have."""
        variants = list(self.variants[title].values())
        name = self.names[title]
        merged: dict[str, list[dict[str, Any]]] = {}
        for variant in variants:
            for key, value in variant["properties"].items():
                if key not in ("kind", "$schema"):
                    merged.setdefault(key, []).append(value)
        is_kind = variants[0]["properties"].get("kind", {}).get("enum") == [name]
        required = set.intersection(*(set(one.get("required", [])) for one in variants))
        first = [key for key in merged if is_kind and key == "input"]
        later = sorted(
            (key for key in merged if key not in first),
            key=lambda key: is_kind or key not in required,
        )
        lines = [f"class {title}(Tree):"]
        says = self.description(variants[0]) or f"What `{name}` is made of."
        lines += [f'    """{says}', "", "    Parameters", "    ----------"]
        for key in [*first, *later]:
            lines.append(f"    {identifier(key)}")
            lines += textwrap.wrap(
                self.note(merged[key]),
                92,
                initial_indent="        ",
                subsequent_indent="        ",
            )
        lines += ['    """', "", "    __slots__ = ()", "", "    def __init__(", "        self,"]
        for key in [*first, "*", *later]:
            if key == "*":
                lines.append("        *,")
                continue
            hints: list[str] = []
            for value in merged[key]:
                hints += self.options(value, title, key)
            hint = " | ".join(dict.fromkeys(hints))
            if is_kind or key not in required:
                hint += " | None = None"
            lines.append(f"        {identifier(key)}: {hint},")
        if not later:
            lines.remove("        *,")
        lines += ["    ) -> None:", "        super().__init__("]
        if is_kind:
            lines.append(f'            ("kind", "{name}"),')
            self.kinds.append(title)
        lines += [f'            ("{key}", {identifier(key)}),' for key in [*first, *later]]
        lines.append("        )")
        return "\n".join(lines)

    def note(self, variants: list[dict[str, Any]]) -> str:
        """Meaning, units and default; the units of all variants."""
        meanings: dict[str, list[str]] = {}
        for variant in variants:
            meaning, units = self.description(variant), ""
            if meaning.endswith(")") and " (" in meaning:
                meaning, units = meaning[:-1].rsplit(" (", 1)
            known = meanings.setdefault(meaning, [])
            for unit in units.split("; or "):
                if unit and unit not in known:
                    known.append(unit)
        notes = []
        for meaning, all_units in meanings.items():
            more = f" ({'; or '.join(all_units)})" if all_units else ""
            notes.append(meaning + more)
        defaults = [
            json.dumps(one["default"], ensure_ascii=False) for one in variants if "default" in one
        ]
        note = " Or: ".join(notes)
        if defaults:
            note += f" Default: {' or '.join(dict.fromkeys(defaults))}."
        return note

    def description(self, schema: dict[str, Any]) -> str:
        text = schema.get("description", "")
        if not text and "$ref" in schema:
            target = schema["$ref"].rsplit("/", 1)[1]
            text = self.definitions[target].get("description", "")
        return str(text).replace("\\", "\\\\")


def text() -> str:
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    classes = Classes(schema["$defs"])
    for name, definition in schema["$defs"].items():
        if "properties" in definition:
            classes.named(definition, "", name)
    for name in ("run", "steady", "optimize", "tolerance", "identify"):
        classes.named(schema["properties"][name], "scene", name)
    texts = {title: classes.text(title) for title in sorted(classes.variants)}
    kinds = ", ".join(classes.kinds)
    alias = f"AnyKind = Union[{kinds}]\n" + '"""An object of any kind."""\n'
    names = sorted([*texts, "AnyKind"])
    listed = "[\n" + "".join(f'    "{name}",\n' for name in names) + "]"
    body = "\n\n\n".join(texts.values())
    return HEAD.replace("{names}", listed) + "\n\n" + body + "\n\n\n" + alias


def main() -> int:
    made = text()
    if "--check" in sys.argv[1:]:
        known = TARGET.read_text(encoding="utf-8") if TARGET.exists() else ""
        if known != made:
            print(f"{TARGET} is stale: run python {__file__}", file=sys.stderr)
            return 1
        return 0
    TARGET.write_text(made, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
