"""Pages of reference, made from what the program declares: its schema of scenes, results, units, codes
of messages and help.

    python docs/reference.py --dam target/release/dam [--out docs/site/reference]

Examples are parts of scenes in scenarios/, which the program checks first. A thing without an example, or a
scene that is refused, is an error.
"""

from __future__ import annotations

import argparse
import json
import math
import re
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
Schema = dict[str, Any]

# Pages of nested things: title, and the definitions of the schema (with a heading) that they show.
PARTS: dict[str, tuple[str, dict[str, str]]] = {
    "position": ("Position functions", {"position": "Position function U(φ)", "planned_motion": "Motion between two stations of a plan"}),
    "laws": ("Laws of motion", {"law": "Law of a rise or return", "run_law": "Law of a run-up or run-out"}),
    "loads": ("Loads", {"load": "Load of an object", "rotor_load": "Load of the rotor of a motor", "output_load": "Load of an output or input of a linkage"}),
    "stops": ("Stops", {"stop": "One-sided stop"}),
    "cam": ("Geometry of cams", {"disc_cam": "Disc cam of a follower"}),
    "linkage-parts": (
        "Parts of a linkage",
        {
            "linkage_link": "Link",
            "linkage_pair": "Joint",
            "linkage_coupling": "Gear, belt, rack or cam (coupling)",
            "linkage_force": "Force",
            "linkage_input": "Input of several",
            "linkage_output": "Output",
            "linkage_assembly": "Assembly mode",
        },
    ),
    "tables": ("Tables in files", {"table_file": "File of a table"}),
    "differential-inputs": ("Inputs of a differential", {"differential_input": "Input"}),
}
# Definitions that differ from another one only in what they leave out.
SAME = {
    "turning_position": "position",
    "geared_position": "position",
    "turning_load": "load",
    "sliding_load": "load",
    "turning_stop": "stop",
    "sliding_stop": "stop",
    "turning_cam": "disc_cam",
}
# Definitions that share forms: an example of one is an example of the others.
ALIKE = [["law", "planned_motion", "run_law"], ["load", "rotor_load", "output_load"]]
# Parts of a scene beside its objects.
WHOLE = {
    "parameters": ("Parameters", "`parameters` names numbers that the whole scene may use."),
    "run": ("The run", "`run` states how long and by which method a scene is run."),
    "steady": ("Steady motion", "`steady` states what `dam steady` is to find."),
    "expect": ("Expectations", "`expect` lists values that results must have. Addresses of results are on the page [Results](results.md)."),
}
# The quantity at the end of a description.
TAKES = re.compile(r"\s*\(((?:a pure number|[^()]*? in [^()]*(?:\([^()]*\)[^()]*)*))\)$")


def told(program: str, *arguments: str) -> str:
    """What the program prints."""
    ran = subprocess.run([program, *arguments], capture_output=True, text=True, check=False, cwd=ROOT)
    if ran.returncode != 0:
        raise SystemExit(f"dam {' '.join(arguments)}: {ran.stderr}")
    return ran.stdout


def cell(text: str) -> str:
    """Text in a cell of a table."""
    return text.replace("|", "\\|").replace("\n", " ").strip()


def code(value: Any) -> str:
    """A value as JSON, as code."""
    return f"`{json.dumps(value, ensure_ascii=False)}`"


def table(heads: list[str], rows: list[list[str]]) -> str:
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join("| " + " | ".join(cell(text) for text in line) + " |" for line in lines) + "\n"


@dataclass
class Row:
    """A property as a table shows it."""

    name: str
    meaning: str
    takes: str
    default: str
    required: bool
    example: str = ""


@dataclass
class Example:
    """Part of a scene, and where it stands."""

    value: Any
    scene: str
    path: str

    def size(self) -> int:
        return len(json.dumps(self.value))


@dataclass
class Declared:
    """What the program declares, with examples of scenes."""

    schema: Schema
    # By the path of a property: `rocker.pair.gap`, `load.spring.rate`.
    examples: dict[str, Example] = field(default_factory=dict)

    @property
    def definitions(self) -> dict[str, Schema]:
        return self.schema["$defs"]

    def kinds(self) -> list[str]:
        return [name for name, own in self.definitions.items() if "kind" in own.get("properties", {})]


def branches(schema: Schema) -> Iterator[Schema]:
    """A schema and its alternatives."""
    yield schema
    for other in schema.get("anyOf", []):
        yield from branches(other)


def described(schema: Schema) -> tuple[str, str]:
    """Meaning of a property, and the quantity with its units."""
    text = schema.get("description", "")
    found = TAKES.search(text)
    if found:
        return text[: found.start()], found[1]
    return text, ""


def bounds(schema: Schema) -> str:
    """Bounds of a number or of a list."""
    said = []
    for one in branches(schema):
        for keyword, sign in [("minimum", "≥"), ("exclusiveMinimum", ">"), ("maximum", "≤"), ("exclusiveMaximum", "<")]:
            if keyword in one:
                said.append(f"{sign} {one[keyword]:g}")
        if one.get("not") == {"const": 0}:
            said.append("≠ 0")
        least, most = one.get("minItems"), one.get("maxItems")
        if least is not None and least == most:
            said.append(f"{least} entries")
        elif least:
            said.append(f"at least {least} entries")
    return ", ".join(dict.fromkeys(said))


def page_of(definition: str) -> str:
    """Where a definition is shown."""
    definition = SAME.get(definition, definition)
    for page, (_, shown) in PARTS.items():
        if definition in shown:
            return f"[{shown[definition]}]({page}.md#{definition.replace('_', '-')})"
    return f"[`{definition}`]({definition.replace('_', '-')}.md)"


def kinds_of_value(schema: Schema) -> list[str]:
    """Types that a value may have, in words."""
    said: list[str] = []
    for one in branches(schema):
        if "$ref" in one:
            said.append(page_of(one["$ref"].rpartition("/")[2]))
        elif "enum" in one:
            said += [code(value) for value in one["enum"]]
        elif "const" in one:
            said.append(code(one["const"]))
        elif one.get("type") == "array":
            inner = one.get("items") or (one.get("prefixItems") or [{}])[0]
            said.append(f"list of {takes(inner) or 'entries'}")
        elif one.get("type") == "object":
            inner = one.get("additionalProperties")
            of = takes(inner) if isinstance(inner, dict) else ""
            said.append(f"by name: {of}" if of else "object")
        elif one.get("type") == "boolean":
            said.append("true or false")
        elif one.get("type") == "integer":
            said.append("whole number")
        elif one.get("type") == "number":
            said.append("number")
        elif one.get("type") == "string" and "pattern" not in one:
            said.append("text")
    return list(dict.fromkeys(said))


def takes(schema: Schema) -> str:
    """What a property takes: quantity with units, or types, and bounds."""
    _, quantity = described(schema)
    types = kinds_of_value(schema)
    if quantity:
        types = [quantity] + [one for one in types if one != "number" and not one.startswith("object")]
    text = "; or ".join(types)
    limits = bounds(schema)
    return f"{text}, {limits}" if limits and limits not in text else text


def inner(schema: Schema) -> Iterator[tuple[str, Schema]]:
    """Objects within a value, each with what leads to it."""
    for one in branches(schema):
        if "$ref" in one:
            continue
        if "properties" in one:
            yield "", one
        for entry in [one.get("items"), *(one.get("prefixItems") or [])]:
            if isinstance(entry, dict):
                yield from ((f"[]{tail}", found) for tail, found in inner(entry))
        entry = one.get("additionalProperties")
        if isinstance(entry, dict):
            yield from ((f".NAME{tail}", found) for tail, found in inner(entry))


def rows(schema: Schema, declared: Declared, owner: str, prefix: str = "") -> Iterator[Row]:
    """The properties of an object and of all that is written within it."""
    required = set(schema.get("required", [])) | set(schema.get("then", {}).get("required", []))
    for name, own in schema["properties"].items():
        meaning, _ = described(own)
        path = f"{prefix}{name}"
        example = declared.examples.get(f"{owner}.{path}")
        short = example is not None and example.size() <= 60
        yield Row(
            name=path,
            meaning=meaning,
            takes=takes(own),
            default=code(own["default"]) if "default" in own else "",
            required=name in required,
            example=code(example.value) if example and short else "",
        )
        seen = set()
        for tail, found in inner(own):
            for row in rows(found, declared, owner, f"{path}{tail}."):
                if row.name not in seen:
                    seen.add(row.name)
                    yield row


def groups(schema: Schema) -> Iterator[tuple[list[str], bool]]:
    """Properties of which only one may be given; true: one must."""
    for one in [*schema.get("allOf", []), *schema.get("then", {}).get("allOf", [])]:
        if "oneOf" in one:
            names = [name for other in one["oneOf"] for name in other.get("required", [])]
            yield names, not any("not" in other for other in one["oneOf"])


def alternatives(schema: Schema) -> list[str]:
    """Forms of which exactly one is given."""
    return [name for names, must in groups(schema) if must for name in names]


def properties(schema: Schema, declared: Declared, owner: str) -> str:
    text = ""
    for one in branches(schema):
        if "enum" in one:
            text += "A name: " + ", ".join(code(value) for value in one["enum"]) + ".\n\n"
        if "properties" not in one:
            continue
        for either, must in groups(one):
            if len(either) > 1:
                count = "Exactly one of " if must else "At most one of "
                text += count + ", ".join(f"`{name}`" for name in either) + ".\n\n"
        lines = []
        for row in rows(one, declared, owner):
            name = f"`{row.name}`" + (" (required)" if row.required else "")
            lines.append([name, row.meaning, row.takes, row.default, row.example])
        text += table(["property", "meaning", "value", "default", "example"], lines) + "\n"
    return text


def fits(schema: Schema, value: Any) -> bool:
    """Whether a value can be one of a definition, by its members or its name."""
    for one in branches(schema):
        if isinstance(value, dict) and value.keys() <= one.get("properties", {}).keys():
            return True
        if isinstance(value, str) and value in one.get("enum", []):
            return True
    return False


class Collector:
    """Walks through scenes along the schema and keeps the shortest example of each property."""

    def __init__(self, declared: Declared, scene: str) -> None:
        self.declared, self.scene = declared, scene

    def note(self, key: str, value: Any, path: str) -> None:
        known = self.declared.examples.get(key)
        new = Example(value, self.scene, path)
        if known is None or new.size() < known.size():
            self.declared.examples[key] = new

    def value(self, schema: Schema, value: Any, key: str, path: str) -> None:
        for one in branches(schema):
            if "$ref" in one:
                name = one["$ref"].rpartition("/")[2]
                name = SAME.get(name, name)
                # (What is within is described where the whole definition is.)
                if fits(self.declared.definitions[name], value):
                    self.note(name, value, path)
                    self.value(self.declared.definitions[name], value, name, path)
            elif isinstance(value, dict):
                self.members(one, value, key, path)
            elif isinstance(value, list):
                entries = one.get("prefixItems") or []
                for index, item in enumerate(value):
                    entry = entries[index] if index < len(entries) else one.get("items")
                    if isinstance(entry, dict):
                        self.value(entry, item, f"{key}[]", f"{path}[{index}]")

    def members(self, schema: Schema, value: dict[str, Any], key: str, path: str) -> None:
        known = schema.get("properties", {})
        rest = schema.get("additionalProperties")
        for name, item in value.items():
            here = f"{path}.{name}" if path else name
            if name in known:
                self.note(f"{key}.{name}", item, here)
                self.value(known[name], item, f"{key}.{name}", here)
            elif isinstance(rest, dict):
                self.value(rest, item, f"{key}.NAME", here)

    def scene_of(self, scene: dict[str, Any]) -> None:
        for name, item in scene["objects"].items():
            kind = item.get("kind") or item["from"].partition("/")[0]
            if kind in self.declared.definitions:
                if "from" not in item:
                    self.note(kind, item, f"objects.{name}")
                self.value(self.declared.definitions[kind], item, kind, f"objects.{name}")
        for part in WHOLE:
            if part in scene:
                self.note(part, scene[part], part)
                self.value(self.declared.schema["properties"][part], scene[part], part, part)


def collect(declared: Declared, program: str) -> None:
    """Examples from all scenes that the program finds right."""
    for path in sorted((ROOT / "scenarios").rglob("*.json")):
        if path.name == "scene.schema.json":
            continue
        name = path.relative_to(ROOT).as_posix()
        Collector(declared, name).scene_of(json.loads(path.read_text(encoding="utf-8")))
    for name in sorted({one.scene for one in declared.examples.values()}):
        told(program, "check", name, "--quiet")
    # What no scenario has is in the scene of all properties, which is only read.
    rest = Declared(declared.schema)
    name = "tests/schema_scene.json"
    Collector(rest, name).scene_of(json.loads((ROOT / name).read_text(encoding="utf-8")))
    for key, one in rest.examples.items():
        declared.examples.setdefault(key, one)


def block(example: Example) -> str:
    """An example with its place. (Words in the comment are what a test looks for.)"""
    text = json.dumps(example.value, indent=2, ensure_ascii=False)
    # Short lists and objects stand in a line.
    text = re.sub(r"[\[{]\s+([^\[\]{}]{1,90}?)\s+[\]}]", lambda m: re.sub(r"\s*\n\s*", " ", m[0]), text)
    place = f"From `{example.scene}`, `{example.path}`" if example.scene else "With numbers in SI units"
    return f"{place}:\n\n```json\n{text}\n```\n\n"


def kind_page(kind: str, declared: Declared) -> str:
    schema = declared.definitions[kind]
    text = f"# Object `{kind}`\n\n{schema.get('description', '')}\n\n"
    text += "## Example\n\n" + block(declared.examples[kind])
    text += "## Properties\n\n" + properties(schema, declared, kind)
    return text


def variants(schema: Schema) -> list[str]:
    return [name for one in branches(schema) for name in alternatives(one)]


def numbers(schema: Schema) -> Any:
    """What a form takes that has nothing but numbers: 1 for each of them, if that is in its bounds."""
    if any(one.get("type") == "number" for one in branches(schema)):
        least = max(one.get("minimum", 1.0) for one in branches(schema))
        most = min(one.get("maximum", math.inf) for one in branches(schema))
        return min(max(1.0, least), most)
    if "allOf" in schema:
        return None
    within = {name: numbers(own) for name, own in schema.get("properties", {}).items()}
    return within if within and None not in within.values() else None


def example_of(definition: str, name: str | None, declared: Declared) -> Example:
    """An example of a form of a definition."""
    alike = next((one for one in ALIKE if definition in one), [])
    for one in [definition, *alike]:
        found = declared.examples.get(f"{one}.{name}" if name else one)
        if found:
            return found
    made = numbers(declared.definitions[definition]["properties"].get(name, {})) if name else None
    if made is not None:
        return Example(made, "", "")
    raise SystemExit(f"no scene has an example of `{definition}.{name}`")


def part_page(page: str, declared: Declared) -> str:
    title, shown = PARTS[page]
    text = f"# {title}\n\n"
    for definition, heading in shown.items():
        schema = declared.definitions[definition]
        text += f"## {heading} {{ #{definition.replace('_', '-')} }}\n\n"
        same = [f"`{name}`" for name, of in SAME.items() if of == definition]
        if same:
            text += "Objects that only turn or only slide take those of their coordinate.\n\n"
        text += properties(schema, declared, definition)
        for name in variants(schema) or [None]:
            example = example_of(definition, name, declared)
            if name:
                text += f"Example of `{name}`. "
                example = Example({name: example.value}, example.scene, example.path)
            text += block(example)
    return text


def whole_page(part: str, declared: Declared) -> str:
    title, lead = WHOLE[part]
    schema = declared.schema["properties"][part]
    text = f"# {title}\n\n{lead}\n\n"
    text += "## Example\n\n" + block(declared.examples[part])
    owner = part
    if schema.get("type") == "array":
        schema, owner = schema["items"], f"{part}[]"
    if "properties" not in schema:
        lines = [["`NAME`", described(schema)[0], takes(schema["additionalProperties"])]]
        return text + "## Properties\n\n" + table(["property", "meaning", "value"], lines)
    return text + "## Properties\n\n" + properties(schema, declared, owner)


def units_page(units: Schema) -> str:
    text = """# Units

A bare number is in the SI unit of its quantity. A text has a number and a unit: `"600 rpm"`, `"5 N m/rad"`. Units are
combined by spaces for products, `/` for quotients and `^` for powers. The dimension is checked.

## Quantities

"""
    lines = []
    for one in units["quantities"]:
        remark = "the radian may be left out" if one["angle_may_be_left_out"] else ""
        lines.append([one["name"], f"`{one['units'][0]}`", ", ".join(f"`{unit}`" for unit in one["units"][1:]), remark])
    text += table(["quantity", "SI unit", "units in messages, for example", "remark"], lines)
    text += "\n## Symbols\n\nEvery known symbol, prefixed forms included, with its value in SI units.\n\n"
    lines = [[f"`{one['symbol']}`", f"{one['in_si']:.12g}", f"`{one['dimension']}`"] for one in units["symbols"]]
    return text + table(["symbol", "value", "in SI units"], lines)


def results_page(results: Schema) -> str:
    text = """# Results

`expect`, `--figure`, `--subject` and `--accuracy` address results by these names. Words in capitals stand for names of the scene,
N for a number. `dam schema --of results` prints this list as JSON.

δ is the positioning error of an object: the deflection seen at its output. φ is its displacement. An angle and a
length share a row where an object may turn or slide.

"""
    titles = {
        "object": ("Objects", "Results of `dam run`. OBJECT is the id of an object."),
        "stop": ("Stops", "Results of `dam run`. OBJECT.STOP is a stop of an object. The last rows are those of the mass that it stops."),
        "run": ("Run", "Results of `dam run` as a whole."),
        "steady": ("Steady motion", "Results of `dam steady`."),
        "kinematics": ("Kinematics", "Results of `dam kinematics`. OBJECT is a linkage."),
        "forces": ("Forces", "Results of `dam forces`. OBJECT is a linkage."),
        "cam": ("Cams", "Results of `dam cam`. OBJECT is the follower."),
        "frequency": ("Natural frequencies", "Results of `dam run`, in cycles per second."),
    }
    for key, (title, lead) in titles.items():
        text += f"## {title}\n\n{lead}\n\n"
        if any(one["address"].endswith(".END") for one in results[key]):
            text += "END is one of:\n\n"
            text += "".join(f"- `{one['name']}`: {one['meaning']}\n" for one in results["ends"]) + "\n"
        lines = []
        with_sign = any("sign" in one for one in results[key])
        for one in results[key]:
            units = ", ".join("–" if unit in ("1", "") else f"`{unit}`" for unit in one["units"])
            line = [f"`{one['address']}`", one["meaning"], units]
            lines.append([*line, one["sign"]] if with_sign else line)
        heads = ["address", "meaning", "SI unit"]
        text += table([*heads, "sign"] if with_sign else heads, lines) + "\n"
    text += "## Reasons for a stop\n\nA run that ends early states one of these in `run.stopped`; `stops` of an expectation takes them.\n\n"
    return text + table(["name", "meaning"], [[f"`{one['name']}`", one["meaning"]] for one in results["stops"]])


def codes_page(codes: Schema) -> str:
    text = """# Codes of messages

Each error and warning of a scene has a code: `error[unknown-property]`. With `--json` it is the member `code`. A code keeps its
meaning, see [Formats](../formats.md). `dam schema --of codes` prints this list as JSON.

"""
    return text + table(
        ["code", "cause", "remedy"],
        [[f"`{one['code']}`", one["cause"], one["remedy"]] for one in codes["codes"]],
    )


def catalogue_page() -> str:
    text = """# Catalogue

A scene copies an object by `"from": "rocker/steel-lever-205mm"`. Properties beside `from` replace those of the catalogue.

"""
    by_kind: dict[str, list[list[str]]] = {}
    for path in sorted((ROOT / "objects").glob("*/*.json")):
        own = json.loads(path.read_text(encoding="utf-8"))
        by_kind.setdefault(own["kind"], []).append([f"`{path.parent.name}/{path.stem}`", own["description"], own["source"]])
    for kind, lines in by_kind.items():
        text += f"## {kind.replace('_', ' ').capitalize()}\n\nKind [`{kind}`]({kind.replace('_', '-')}.md).\n\n"
        text += table(["name", "what it is", "source of its numbers"], lines) + "\n"
    return text


def shown_option(lines: list[str]) -> tuple[str, str]:
    """Text of an option of the help, and its default."""
    text = " ".join(line.strip() for line in lines)
    choices = re.split(r"\s*Possible values:\s*", text)
    text = choices[0]
    if len(choices) > 1:
        rest, _, default = choices[1].partition("[default: ")
        text = text.rstrip(".") + ". One of: " + "; ".join(one.strip() for one in re.split(r"(?:^|\s)- (?=[\w-]+:?)", re.sub(r" +", " ", rest)) if one.strip()) + "."
        text += f" [default: {default}" if default else ""
    found = re.search(r"\s*\[default: (.*)\]", text)
    return (text[: found.start()] + text[found.end() :], found[1]) if found else (text, "")


def arguments(help_text: str) -> str:
    """Arguments and options of a command as a table."""
    lines, name, own = [], "", []

    def ended() -> None:
        if name:
            text, default = shown_option(own)
            lines.append([f"`{name}`", text, f"`{default}`" if default else ""])

    for line in help_text.splitlines():
        found = re.match(r"^ {2,6}((?:-\w|--|<|\[)\S.*?)(?: {2,}(.*))?$", line)
        if found:
            ended()
            name, own = found[1], [found[2] or ""]
        elif line.startswith(" ") and name:
            own.append(line)
        elif line and not line.startswith(" "):
            ended()
            name, own = "", []
    ended()
    return table(["argument or option", "meaning", "default"], lines)


def command_page(program: str) -> str:
    text = """# Command line

`dam COMMAND --help` prints the same. `dam manual COMMAND` prints it as a manual page.

"""

    def of(words: list[str]) -> None:
        nonlocal text
        said = told(program, *words, "--help")
        commands = re.findall(r"^  ([a-z-]+) {2,}", said.partition("Commands:")[2].partition("Options:")[0], re.MULTILINE)
        if words:
            usage = re.search(r"Usage: (.*)", said)
            about = said.partition("\n\nUsage")[0].replace("\n", " ").strip().rstrip(".")
            text += f"## `dam {' '.join(words)}`\n\n{about}.\n\n"
            if not commands:
                text += f"```text\n{usage[1] if usage else ''}\n```\n\n{arguments(said)}\n"
        for name in commands:
            if name != "help":
                of([*words, name])

    of([])
    return text


def answers_page(schema: Schema) -> str:
    text = """# Answers of `--json`

Every command with `--json` prints one document. [answers.schema.json](answers.schema.json) describes these documents as a JSON
Schema (draft 2020-12), one definition for each command. Units are SI. New members may be added, see [Formats](../formats.md).

Members without a mark are always there. "maybe" marks those that are there only if they apply.

"""
    for name, own in schema["$defs"].items():
        if not name.startswith("dam "):
            continue
        text += f"## `{name}` {{ #{name.replace(' ', '-')} }}\n\n"
        lines = []
        for form in branches(own):
            needed = set(form.get("required", []))
            for member, value in form.get("properties", {}).items():
                mark = "" if member in needed else "maybe"
                line = [f"`{member}`", value.get("description", ""), mark]
                if line not in lines:
                    lines.append(line)
        text += table(["member", "meaning", ""], sorted(lines)) + "\n"
    return text


def index_page(declared: Declared) -> str:
    text = """# Reference

These pages are made from the declarations of the program. They list every property, unit, result and code.

| page | contents |
| --- | --- |
"""
    lines = [(f"[`{kind}`]({kind.replace('_', '-')}.md)", declared.definitions[kind]["description"]) for kind in declared.kinds()]
    lines += [(f"[{title}]({page}.md)", ", ".join(shown.values())) for page, (title, shown) in PARTS.items()]
    lines += [(f"[{title}]({part}.md)", lead) for part, (title, lead) in WHOLE.items()]
    lines += [
        ("[Results](results.md)", "Address, meaning, unit and sign of every result."),
        ("[Units](units.md)", "Quantities and symbols."),
        ("[Catalogue](catalogue.md)", "Objects that a scene can copy."),
        ("[Command line](command-line.md)", "Commands and options."),
        ("[Answers](answers.md)", "Form of the JSON documents."),
        ("[Codes of messages](codes.md)", "Cause and remedy of each error and warning."),
        ("[Glossary](glossary.md)", "Terms in English, German and Russian."),
    ]
    return text + "".join(f"| {name} | {cell(what)} |\n" for name, what in lines)


def pages(program: str) -> dict[str, str]:
    """All pages by name."""
    declared = Declared(json.loads(told(program, "schema")))
    collect(declared, program)
    shown = set(declared.kinds()) | set(SAME) | {name for _, of in PARTS.values() for name in of}
    if shown != set(declared.definitions):
        raise SystemExit(f"definitions without a page, or pages without one: {shown ^ set(declared.definitions)}")
    own = {
        "units": units_page(json.loads(told(program, "schema", "--of", "units"))),
        "results": results_page(json.loads(told(program, "schema", "--of", "results"))),
        "codes": codes_page(json.loads(told(program, "schema", "--of", "codes"))),
        "catalogue": catalogue_page(),
        "command-line": command_page(program),
        "index": index_page(declared),
    }
    answers = ROOT / "docs/site/reference/answers.schema.json"
    own["answers"] = answers_page(json.loads(answers.read_text(encoding="utf-8")))
    own |= {kind.replace("_", "-"): kind_page(kind, declared) for kind in declared.kinds()}
    own |= {page: part_page(page, declared) for page in PARTS}
    own |= {part: whole_page(part, declared) for part in WHOLE}
    return own


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--dam", required=True, help="the program")
    parser.add_argument("--out", type=Path, default=ROOT / "docs/site/reference", help="folder of the pages")
    given = parser.parse_args()
    program = str(Path(given.dam).resolve(strict=True))
    given.out.mkdir(parents=True, exist_ok=True)
    made = pages(program)
    for name, text in made.items():
        (given.out / f"{name}.md").write_text(re.sub(r"\n{3,}", "\n\n", text), encoding="utf-8")
    print(f"{len(made)} pages of reference")


if __name__ == "__main__":
    main()
