"""Writes dam/kinds.py from the JSON Schema of scenes, which comes from the declarations
that scenes are read by: `python python/generate.py`. With --check nothing is written, and
the exit status tells whether the file is as it would be.
"""

from __future__ import annotations

import json
import keyword
import re
import sys
import textwrap
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
SCENARIOS = HERE.parent / "scenarios"
CATALOGUE = HERE.parent / "objects"
SCHEMA = HERE.parent / "scenarios" / "scene.schema.json"
TARGET = HERE / "dam" / "kinds.py"

HEAD = '''"""Everything that a scene holds, as classes: objects of all kinds, and what their properties
are made of. Written by `python/generate.py` from the declarations that scenes are read by, with
examples from the scenarios and the catalogue of objects.

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


#: Of classes that no scenario and no object of the catalogue has.
OTHERS: dict[str, dict[str, Any]] = {
    "Cam": {"load": "800 N"},
    "CoupleTable": {"link": "crank", "points": [["0 deg", 0], ["180 deg", "-5 N m"]]},
    "Force": {"constant": "250 N"},
    "Geometry": {
        "section": ["16 mm", "25 mm"],
        "length": "80 mm",
        "density": 7850,
        "modulus": "210 GPa",
    },
    "From": {"line": {"width": "12 mm", "load": "1 kN", "modulus": "206 GPa"}},
    "Harmonic": {"amplitude": "5 N m", "order": 2},
    "Identify": {
        "record": ["released_wheel.csv"],
        "match": ["deflection=wheel.delta"],
        "vary": ["wheel.stiffness=5:12 kN m/rad"],
        "sigma": ["deflection=20 µrad"],
    },
    "LiftCam": {
        "lift": "4 mm", "rise": "90 deg", "dwell": "60 deg", "return": "90 deg", "law": "cycloidal"
    },
    "Line": {"width": "12 mm", "load": "1 kN", "modulus": "206 GPa", "radius": "8 mm"},
    "Linear": {"stall_force": "400 N", "no_load_speed": "1.2 m/s"},
    "LinkageForceTable": {"point": "ram.origin", "points": [["0 deg", 0], ["90 deg", "-2 kN"]]},
    "Optimize": {
        "vary": ["follower.loads.spring.spring.rate=0:5000 N/m"],
        "subject": ["follower.pair.margin >= 0"],
        "minimize": "follower.loads.spring.spring.rate",
    },
    "Point": {"modulus": "206 GPa", "radius": "20 mm", "arm": "0.2 m"},
    "Polynomial": {"start": [0, 1.5], "end": [1, 0]},
    "RunLaw": {"trapezoid": {"s1": 0.25, "s2": 0.25}},
    "Scca": {"b": 0.25, "d": 0.5},
    "SlottedLink": {"crank": "80 mm", "frame": "200 mm"},
    "Tolerance": {
        "tol": ["rocker.inertia=±1 %", "rocker.pair.gap=±0.02 mm uniform"],
        "limit": ["rocker.delta_max <= 0.2 mrad"],
    },
    "Torsion": {"pair": "O", "rate": "20 N m/rad", "free_angle": "30 deg"},
    "Trapezoid": {"s1": 0.25, "s2": 0.25},
}

#: Properties that no example shows.
UNSAID = ("kind", "$schema", "description", "source")


def snake(title: str) -> str:
    return re.sub(r"(?<=.)([A-Z])", r"_\1", title).lower()


def written(value: Any) -> str:
    """A value as Python has it, texts in double quotes."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{written(key)}: {written(one)}" for key, one in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(written, value)) + "]"
    return repr(value)


def laid_out(head: str, value: Any, indent: int) -> list[str]:
    """A named value with a comma behind it, a line a member where it is long."""
    line = f"{' ' * indent}{head}{written(value)},"
    if len(line) <= 84 or not isinstance(value, (dict, list)):
        return [line]
    first, last = "{}" if isinstance(value, dict) else "[]"
    members = value.items() if isinstance(value, dict) else (("", one) for one in value)
    lines = [f"{' ' * indent}{head}{first}"]
    for key, one in members:
        lines += laid_out(f"{written(key)}: " if first == "{" else "", one, indent + 4)
    return [*lines, f"{' ' * indent}{last},"]


class Examples:
    """Values of the classes' schemas in the scenarios."""

    def __init__(self, definitions: dict[str, Any]) -> None:
        self.definitions = definitions
        self.known: dict[str, list[dict[str, Any]]] = {}

    def shortest(self, variants: list[dict[str, Any]], title: str) -> dict[str, Any]:
        """The shortest value of any of these schemas that says something; where no scenario has
        one, one that is made of the schema."""
        found = [
            value
            for schema in variants
            for value in self.known.get(json.dumps(schema, sort_keys=True), [])
            if set(value) - {*UNSAID, "input"}
        ]
        if found:
            return min(found, key=lambda value: (len(written(value)), written(value)))
        if title in OTHERS:
            if not any(self.accepts(schema, OTHERS[title]) for schema in variants):
                raise SystemExit(f"the example of {title} is not one of its schema")
            return OTHERS[title]
        print(f"no scenario has a {title}, nor OTHERS", file=sys.stderr)
        made: dict[str, Any] = self.made(variants[0])
        return made

    def meet(self, schema: dict[str, Any], value: Any) -> None:
        """Goes through a value along its schema."""
        if "$ref" in schema:
            return self.meet(self.target(schema), value)
        for key in ("anyOf", "oneOf"):
            if key in schema and "properties" not in schema:
                for choice in schema[key]:
                    if self.accepts(choice, value):
                        return self.meet(choice, value)
                return None
        for one in schema.get("allOf", []):
            if "then" in one and self.accepts(one["if"], value):
                self.meet(one["then"], value)
        if isinstance(value, dict):
            properties = schema.get("properties", {})
            # The catalogue has members that the schema of a scene's own object does not name.
            if properties and self.accepts(schema, value):
                self.known.setdefault(json.dumps(schema, sort_keys=True), []).append(value)
            others = schema.get("additionalProperties")
            for key, one in value.items():
                if key in properties:
                    self.meet(properties[key], one)
                elif isinstance(others, dict):
                    self.meet(others, one)
        elif isinstance(value, list):
            items = schema.get("prefixItems", [])
            for place, one in enumerate(value):
                self.meet(items[place] if place < len(items) else schema.get("items", {}), one)
        return None

    def target(self, schema: dict[str, Any]) -> dict[str, Any]:
        found: dict[str, Any] = self.definitions[schema["$ref"].rsplit("/", 1)[1]]
        return found

    def accepts(self, schema: dict[str, Any], value: Any) -> bool:
        """Whether a value may be one of this schema: as far as choices need it."""
        if "$ref" in schema:
            return self.accepts(self.target(schema), value)
        for key in ("anyOf", "oneOf"):
            if key in schema and not any(self.accepts(one, value) for one in schema[key]):
                return False
        if not all("if" in one or self.accepts(one, value) for one in schema.get("allOf", [])):
            return False
        if "not" in schema and self.accepts(schema["not"], value):
            return False
        if "const" in schema:
            return bool(value == schema["const"])
        if "enum" in schema:
            return value in schema["enum"]
        kinds = {
            "number": (int, float), "integer": (int,), "string": (str,), "boolean": (bool,),
            "array": (list,), "object": (dict,), "null": (type(None),),
        }
        kind = schema.get("type")
        if isinstance(kind, str) and not isinstance(value, kinds[kind]):
            return False
        if isinstance(value, str):
            return "pattern" not in schema or bool(re.search(schema["pattern"], value))
        if isinstance(value, dict):
            return self.accepts_members(schema, value)
        if isinstance(value, list) and "items" in schema:
            return all(self.accepts(schema["items"], one) for one in value)
        return True

    def accepts_members(self, schema: dict[str, Any], value: dict[str, Any]) -> bool:
        properties = schema.get("properties", {})
        others = schema.get("additionalProperties", True)
        if not set(schema.get("required", [])) <= set(value):
            return False
        for key, one in value.items():
            own = properties.get(key, others)
            if own is False or (isinstance(own, dict) and not self.accepts(own, one)):
                return False
        return True

    def made(self, schema: dict[str, Any]) -> Any:
        """A value with what the schema requires, or else with its first property."""
        if "$ref" in schema:
            return self.made(self.target(schema))
        if "default" in schema or schema.get("examples"):
            return schema["default"] if "default" in schema else schema["examples"][0]
        for key in ("anyOf", "oneOf"):
            if key in schema and "properties" not in schema:
                return self.made(schema[key][0])
        if "const" in schema:
            return schema["const"]
        if "enum" in schema:
            return schema["enum"][0]
        if "properties" in schema:
            properties = schema["properties"]
            wanted = schema.get("required") or [key for key in properties if key != "kind"][:1]
            return {key: self.made(properties[key]) for key in wanted}
        if schema.get("type") == "array":
            items = schema.get("prefixItems") or [schema.get("items", {})] * max(
                schema.get("minItems", 1), 1
            )
            return [self.made(one) for one in items]
        simple = {"number": 1.0, "integer": 1, "boolean": True, "object": {}}
        return simple.get(schema.get("type", ""), "a")


class Classes:
    """The classes, in the order in which they are met."""

    def __init__(self, definitions: dict[str, Any]) -> None:
        self.definitions = definitions
        self.variants: dict[str, dict[str, dict[str, Any]]] = {}
        self.names: dict[str, str] = {}
        self.kinds: list[str] = []
        self.examples = Examples(definitions)

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
        if is_kind:
            self.kinds.append(title)
        lines += self.example(title, self.examples.shortest(variants, title))
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
        lines += [f'            ("{key}", {identifier(key)}),' for key in [*first, *later]]
        lines.append("        )")
        return "\n".join(lines)

    def example(self, title: str, value: dict[str, Any]) -> list[str]:
        """How an object of the class is made, and how a property of it is read."""
        properties = {key: one for key, one in value.items() if key not in UNSAID}
        known = identifier(snake(title))
        is_kind = title in self.kinds
        arguments = []
        for key, one in sorted(properties.items(), key=lambda item: item[0] != "input"):
            is_first = is_kind and key == "input"
            arguments.append(("" if is_first else f"{identifier(key)}=", one))
        inner = ", ".join(f"{head}{written(one)}" for head, one in arguments)
        lines = ["", "    Examples", "    --------", f"    >>> {known} = kinds.{title}({inner})"]
        if len(lines[-1]) > 98:
            lines[-1] = f"    >>> {known} = kinds.{title}("
            for head, one in arguments:
                lines += [f"    ... {line}" for line in laid_out(head, one, 4)]
            lines.append("    ... )")
        simple = [key for key, one in properties.items() if not isinstance(one, (dict, list))]
        if simple:
            key = simple[0]
            lines += [f"    >>> {known}.{identifier(key)}", f"    {properties[key]!r}"]
        return [line.replace("\\", "\\\\") for line in lines]

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
    for file in sorted(SCENARIOS.glob("*/*.json")):
        classes.examples.meet(schema, json.loads(file.read_text(encoding="utf-8")))
    for file in sorted(CATALOGUE.glob("*/*.json")):
        known = json.loads(file.read_text(encoding="utf-8"))
        known.pop("source", None)
        classes.examples.meet(schema["$defs"][known["kind"]], known)
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
