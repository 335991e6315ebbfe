"""The form of the answers of `--json`, as a JSON Schema of each command.

    python docs/answers.py --dam target/release/dam

runs every command on the scenarios that it takes and writes docs/site/reference/answers.schema.json anew: members
that all answers have are required, no others are known. Meanings of members that the file has stay.
tests/program/reference.rs holds the answers of all commands to it.
"""

from __future__ import annotations

import argparse
import ast
import json
import re
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
SCHEMA = ROOT / "docs/site/reference/answers.schema.json"
Schema = dict[str, Any]

# Commands that are asked of every scenario; each takes those that it fits.
OF_SCENES = ["check", "show", "run", "kinematics", "forces", "cam", "steady", "verify", "linearise", "response"]
# Options that the answer does not depend on.
LEFT_OUT = ["--help", "--quiet", "--json", "--out", "--force", "--time-limit", "--units", "--significant", "--resume", "--merge", "--threads"]
# What else gives members that no scenario has.
ROCKER = ["scenarios/rocker/one_mass.json", "--set", "run.duration=0.05"]
TEN = ["scenarios/rocker/ten_masses_closed.json", "--set", "run.duration=0.05"]
CRANK = "scenarios/kinetostatics/slider_crank.json"
TAPPET = "scenarios/cams/flat_tappet.json"
WHEEL = ["scenarios/shafts/free_vibration.json", "--record", "scenarios/shafts/released_wheel.csv", "--match", "deflection=wheel.delta"]
STIFFNESS = "rocker.stiffness=1e6:2e6:2"
MORE = [
    ["law", "list"],
    *(["law", "show", name] for name in ["parabolic", "modified_sine", "3-4-5", "rectangular", "unequal_trapezoid"]),
    ["law", "cycle", "scenarios/cams/indexing_dwells.json", "--of", "table"],
    ["law", "compare", TAPPET, "--at", "valve.position.cam.law", "--law", "cycloidal", "--law", "3-4-5", "--by", "residual"],
    ["run", *TEN, "--spread"],
    ["run", *TEN, "--accuracy", "2 %"],
    ["run", *ROCKER, "--set", 'run.first_times={"far": {"of": "rocker", "condition": "phi > 0.1"}, "never": {"of": "rocker", "condition": "phi > 9"}}'],
    ["run", *ROCKER, "--set", 'run.until={"of": "rocker", "condition": "phi > 0.1"}'],
    ["run", *ROCKER, "--accuracy", "frequency.1=1 %"],
    ["compare", *ROCKER, "--over", "rocker.stiffness=1e6,2e6", "--figure", "frequency.1"],
    ["compare", *TEN, "--over", "rocker.masses=1,2,5"],
    ["map", *ROCKER, "--x", STIFFNESS, "--y", "rocker.inertia=0.4:0.5:2"],
    ["map", *ROCKER, "--x", STIFFNESS, "--panels", "rocker.inertia=0.4,0.5"],
    ["map", *ROCKER, "--x", STIFFNESS, "--figure", "frequency.1"],
    ["map", "scenarios/rigid/pump.json", "--set", "run.duration=0.05", "--x", "run.tolerance=1e-6:1e-4:2", "--figure", "plunger.peak_speed"],
    ["find", *ROCKER, "--vary", "rocker.stiffness=1e6:3e6:5", "--subject", "frequency.1 <= 700 Hz", "--maximize", "rocker.stiffness"],
    ["find", *ROCKER, "--vary", "rocker.stiffness=1e6:3e6:5", "--minimize", "rocker.delta_abs"],
    ["find", *ROCKER, "--vary", "rocker.stiffness=1e6:3e6:5", "--subject", "frequency.1 <= 1 Hz"],
    ["optimize", *ROCKER, "--vary", "rocker.stiffness=1e6:3e6", "--vary", "rocker.inertia=0.4:0.5", "--starts", "2", "--subject", "frequency.1 <= 700 Hz", "--minimize", "rocker.delta_abs"],
    ["optimize", *ROCKER, "--vary", "rocker.stiffness=1e6:3e6", "--starts", "1", "--subject", "frequency.1 <= 1 Hz", "--minimize", "rocker.delta_abs"],
    ["gradient", *ROCKER, "--by", "rocker.inertia,rocker.stiffness", "--figures", "rocker.delta_max,rocker.pair.separations"],
    ["gradient", "scenarios/rocker/two_masses.json", "--set", "rocker.damping_capacity=0", "--set", "run.duration=0.02", "--by", "rocker.damping_capacity"],
    ["tolerance", *ROCKER, "--tol", "rocker.inertia=±1 %", "--tol", "rocker.stiffness=+2 -1 %", "--samples", "64", "--limit", "rocker.delta_max <= 0.1 mrad", "--figures", "rocker.pair.separations"],
    ["tolerance", CRANK, "--tol", "mechanism.links.crank.points.A[0]=±0.1 mm", "--figures", "kinematics.mechanism.slide.stroke", "--samples", "0"],
    ["tolerance", "scenarios/limits/short_rod.json", "--set", "slide.position.slider_crank.crank=79.99 mm", "--tol", "slide.position.slider_crank.rod=±0.03 mm", "--limit", "slide.final.displacement <= 1 m", "--samples", "64"],
    ["identify", *WHEEL, "--vary", "wheel.stiffness=5000:12000", "--vary", "wheel.damping_capacity=0:1", "--starts", "2"],
    ["identify", *WHEEL, "--vary", "wheel.stiffness=5000:12000", "--vary", "wheel.inertia=0.01:0.03", "--starts", "2"],
    ["identify", *WHEEL, "--vary", "wheel.stiffness=5000:12000", "--vary", "wheel.damping_capacity=0:1", "--starts", "2", "--sigma", "deflection=20 µrad"],
    ["identify", *WHEEL, "--vary", "wheel.stiffness=5000:12000", "--vary", "wheel.damping_capacity=0:1", "--starts", "2", "--sigma", "deflection=1 µrad"],
    ["identify", *WHEEL, "--vary", "wheel.inertia=0.001:0.003", "--starts", "1"],
    ["cam", TAPPET, "--lift-off"],
    ["cam", "scenarios/cams/yarn_traverse.json", "--cutter", "10 mm"],
    ["forces", CRANK, "--compare-massless", "1,10"],
    ["forces", CRANK, "--time", "0.05"],
    ["kinematics", CRANK, "--time", "0.05"],
    ["kinematics", CRANK, "--range", "10 deg:50 deg"],
    ["reduce", "scenarios/rocker/two_masses.json", "--set", "run.duration=0.05"],
    ["response", "scenarios/rocker/two_masses.json", "--set", "rocker.damping_capacity=0"],
    ["orders", "scenarios/valve_train/in_working_order.json", "--points", "5"],
    ["orders", "scenarios/valve_train/lift_off.json", "--points", "5"],
    ["orders", "scenarios/rocker/two_masses.json", "--points", "2", "--set", "rocker.damping_capacity=0", "--speeds", "100:200000 rpm"],
    ["verify", "scenarios/rocker/one_mass.json", "scenarios/cams/flat_tappet.json"],
    ["run", "no_such_file.json"],
    ["check", "tests/diagnostics/many_faults.json"],
    ["check", "tests/diagnostics/unit_unknown.json"],
    ["check", "tests/diagnostics/two_ways.json"],
]


def bases() -> list[list[str]]:
    """The invocations of tests/program/options.rs."""
    text = (ROOT / "tests/program/options.rs").read_text(encoding="utf-8")
    names = dict(re.findall(r'const (\w+): &str = ("[^"]*");', text))
    body = re.search(r"const BASES.*?= &\[(.*?)\n\];", text, re.DOTALL)
    assert body
    plain = re.sub(r"\b[A-Z_]{4,}\b", lambda found: names[found[0]], body[1].replace("&[", "["))
    return [[*command.split(" "), *more] for command, more in ast.literal_eval(f"[{plain}]")]


def tries(program: str) -> list[list[str]]:
    """Every option of the commands of these invocations, with the values that the test has for it."""
    text = (ROOT / "tests/program/options.rs").read_text(encoding="utf-8")
    listed = re.search(r"const VALUES.*?= &\[(.*?)\n\];", text, re.DOTALL)
    assert listed
    values = dict(ast.literal_eval(f"[{listed[1].replace('&[', '[')}]"))
    found = []
    for call in bases():
        command = call[:2] if call[0] == "law" else call[:1]
        said = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True).stdout
        for option in re.split(r"\n(?= {2,8}-)", said)[1:]:
            name = re.search(r"--[\w-]+", option)
            if not name or name[0] in call or name[0] in LEFT_OUT:
                continue
            choices = re.findall(r"^ +- ([\w-]+):", option, re.MULTILINE)
            own = choices or values.get(name[0], [])
            takes_value = "<" in option.splitlines()[0]
            found += [[*call, name[0], value] for value in own] if takes_value else [[*call, name[0]]]
    return found


def calls(program: str) -> list[list[str]]:
    """Everything that is asked."""
    scenes = sorted((ROOT / "scenarios").rglob("*.json"))
    names = [path.relative_to(ROOT).as_posix() for path in scenes if path.name != "scene.schema.json"]
    return [*bases(), *tries(program), *MORE, *([command, name] for command in OF_SCENES for name in names)]


def name_of(call: list[str]) -> str:
    """The command of a call: `dam law show`."""
    return " ".join(["dam", *(call[:2] if call[0] == "law" else call[:1])])


def answer(program: str, call: list[str]) -> Any:
    """The document of a call; none where it prints none."""
    ran = subprocess.run(
        [program, *call, "--json", "--time-limit", "60"], capture_output=True, text=True, check=False, cwd=ROOT
    )
    return json.loads(ran.stdout) if ran.stdout.strip() else None


def gathered(program: str, jobs: int) -> dict[str, list[Any]]:
    """All answers by command; that of a failure is the same for all."""
    found: dict[str, list[Any]] = {}
    asked = calls(program)
    with ThreadPoolExecutor(jobs) as pool:
        for call, document in zip(asked, pool.map(lambda call: answer(program, call), asked)):
            if document is not None:
                failed = set(document) == {"dam", "errors"}
                found.setdefault("failure" if failed else name_of(call), []).append(document)
    return found


# Objects whose members are named by the scene: a form for all members.
MAPS = re.compile(
    r"dam (run|compare/runs\[\]/figures)/(units|objects|studies)|.*/run/(first_times|undetermined_times)"
    r"|dam (run|reduce)/accuracy|.*/models\[\]/(errors|values)|.*/(changes|losses|levels|extremes|columns)"
    r"|dam gradient/(parameters|gradients(/\*/by)?)|dam tolerance/figures(/\*/by)?|dam reduce/objects|.*/periodic/drive/start|.*/summary/verdicts|.*/given/levels"
)
# Members of a form of their own.
SCENE = "dam reduce/reduced"
# Text, number, truth or nothing, where samples of one kind do not say what else there may be.
OPEN: Schema = {}

DOC = re.compile(r"^\s*/// ?(.*)$")
FIELD = re.compile(r"^\s*pub(?:\([^)]*\))? (\w+): (.*?),?$")


class Field:
    """A member of a type that the program writes."""

    def __init__(self, name: str, kind: str, doc: str, may_be_absent: bool) -> None:
        self.name, self.kind, self.doc, self.may_be_absent = name, kind, doc, may_be_absent


def types() -> dict[str, dict[str, Field]]:
    """The types of the sources that are written as JSON, with their members."""
    found: dict[str, dict[str, Field]] = {}
    flat: dict[str, list[str]] = {}
    for path in sorted((ROOT / "src").rglob("*.rs")):
        text = path.read_text(encoding="utf-8")
        for own in re.finditer(r"#\[derive\([^)]*Serialize[^)]*\)\]\n(?:#\[.*\]\n)*(?:pub(?:\([^)]*\))? )?struct (\w+)[^{;(]*\{\n(.*?)\n\}", text, re.DOTALL):
            members: dict[str, Field] = {}
            doc, attributes = [], ""
            for line in own[2].splitlines():
                if found_doc := DOC.match(line):
                    doc.append(found_doc[1])
                elif line.strip().startswith("#["):
                    attributes += line.strip()
                elif field := FIELD.match(line):
                    rename = re.search(r'rename = "(.*?)"', attributes)
                    if "flatten" in attributes:
                        flat.setdefault(own[1], []).append(re.sub(r"Option<(.*)>", r"\1", field[2]))
                    elif "serde(skip)" not in attributes:
                        name = rename[1] if rename else field[1]
                        members[name] = Field(name, field[2], " ".join(doc).strip(), "skip_serializing_if" in attributes)
                    doc, attributes = [], ""
            found[own[1]] = members
    for name, inner in flat.items():
        for other in inner:
            for member, own_field in found.get(other, {}).items():
                found[name][member] = Field(member, own_field.kind, own_field.doc, True)
    return found


class Form:
    """The form of a value, from samples."""

    def __init__(self) -> None:
        self.kinds: set[str] = set()
        self.members: dict[str, Form] = {}
        self.count: dict[str, int] = {}
        self.objects = 0
        self.items: Form | None = None

    def add(self, value: Any, path: str) -> None:
        if isinstance(value, dict):
            self.kinds.add("object")
            self.objects += 1
            for name, item in value.items():
                key = "*" if MAPS.fullmatch(path) else name
                self.count[key] = self.count.get(key, 0) + 1
                inner = self.members.setdefault(key, Form())
                if path != SCENE:
                    inner.add(item, f"{path}/{key}")
        elif isinstance(value, list):
            self.kinds.add("array")
            self.items = self.items or Form()
            for item in value:
                self.items.add(item, f"{path}[]")
        else:
            self.kinds.add({bool: "boolean", str: "string", float: "number", int: "integer"}.get(type(value), "null"))

    def type_of(self, known: dict[str, dict[str, Field]]) -> dict[str, Field]:
        """The type of the sources that has these members."""
        names = set(self.members)
        fits: list[tuple[int, dict[str, Field]]] = []
        for members in known.values():
            more = names - set(members)
            absent = {name for name in set(members) - names if not members[name].may_be_absent}
            shared = len(names & set(members))
            if not absent and shared >= 2 and (not more or (len(more) <= 2 and shared >= 4)):
                fits.append((len(more), members))
        best = [members for more, members in fits if more == min(one[0] for one in fits)]
        same = [{name: field.doc for name, field in members.items()} for members in best]
        return best[0] if best and all(one == same[0] for one in same) else {}

    def schema(self, path: str, known: dict[str, dict[str, Field]]) -> Schema:
        """As a JSON Schema."""
        kinds = set(self.kinds)
        if kinds <= {"null"}:
            return dict(OPEN)
        if "number" in kinds:
            kinds.discard("integer")
        made: Schema = {"type": sorted(kinds)[0] if len(kinds) == 1 else sorted(kinds)}
        if self.items is not None:
            made["items"] = self.items.schema(f"{path}[]", known)
        if path == SCENE:
            return {"type": "object"}
        if "object" in kinds:
            if MAPS.fullmatch(path):
                inner = self.members.get("*")
                made["additionalProperties"] = inner.schema(f"{path}/*", known) if inner else True
                return made
            made |= self.of_members(path, known)
        return made

    def of_members(self, path: str, known: dict[str, dict[str, Field]]) -> Schema:
        own = self.type_of(known)
        properties: Schema = {}
        for name in sorted(self.members):
            value = self.members[name].schema(f"{path}/{name}", known)
            field = own.get(name)
            if field and field.kind.startswith("Option<") and "type" in value:
                listed = value["type"] if isinstance(value["type"], list) else [value["type"]]
                value["type"] = sorted({*listed, "null"})
            if field and field.doc:
                value["description"] = plain(field.doc)
            properties[name] = value
        for name, field in own.items():
            if name not in properties:
                properties[name] = {"description": plain(field.doc)}
        required = sorted(
            name for name, count in self.count.items() if count == self.objects and not (name in own and own[name].may_be_absent)
        )
        return {"properties": properties, "required": required, "additionalProperties": False}


def plain(doc: str) -> str:
    """A comment without links to items."""
    return re.sub(r"\[`?(?:\w+::)*(\w+)`?\](?:\([^)]*\))?", r"\1", doc)


# Meanings of members that no type of the sources has, by their path or by their name.
MEANINGS: dict[str, str] = {
    "dam": "Version of the form of the document: 1.",
    "scene": "Name of the scene.",
    "hash": "Hash of the scene, SHA-256 of its canonical text.",
    "warnings": "Warnings.",
    "verdict": "Verdict on the answer, one of four values.",
    "checks": "Checks that the answer made of itself: value, bound and whether it passed.",
    "expect": "Judgement of each expectation of the scene.",
    "rigid": "Whether elastic objects were left out or included, and by which command.",
    "objects": "Results of each object, by its id.",
    "run": "Summary of the run: method, time reached, steps, balance of energy, check of the equations.",
    "units": "SI units of displacement and force of each object.",
    "accuracy": "Accuracy of results: what was asked, the estimated error and whether it holds.",
    "models": "Models that were run to find the error of the model.",
    "spread": "Change of each result by small changes of loads and tolerance.",
    "failure/errors": "What is wrong: code, message, place and hints.",
    "dam check/errors": "Empty: the scene is right. Otherwise the document has only errors.",
    "dam check/diagnostics": "Warnings about the text, with their places.",
    "dam check/remarks": "Remarks of the model.",
    "dam check/assembly_modes": "Assembly mode of each dyad that has another, with how to choose that.",
    "dam check/reaches": "Range of motion of each linkage, in words.",
    "dam show/equations": "Equations of motion, as text and as LaTeX.",
    "dam show/exact": "Whether the method `exact` takes the scene, and what it refuses.",
    "dam show/linkages": "Linkages with one degree of freedom: groups, mobility, range of motion.",
    "dam show/multi_linkages": "Linkages with several degrees of freedom.",
    "dam show/natural_frequencies": "Natural frequencies with contacts closed and separated.",
    "dam show/objects": "Objects of the model with their numbers.",
    "dam compare/over": "Property that was varied, with its values.",
    "dam compare/runs": "Each run: value, results, checks and verdict.",
    "dam compare/table": "Results of all runs, a row for each result.",
    "dam map/complete": "True when every point was computed.",
    "dam map/figure": "Address of the result that is shown.",
    "dam map/panels": "Values, verdicts and causes for each value of the third parameter.",
    "dam map/thresholds": "Bounds by which points are judged.",
    "dam map/unit": "SI unit of the result.",
    "dam map/x": "Parameter along x, with its values.",
    "dam map/y": "Parameter along y, with its values; null without one.",
    "dam steady/rigid_motion": "Steady motion of a machine with rigid objects.",
    "dam steady/periodic": "Periodic motion of an elastic scene: orbit, period, multipliers.",
    "dam steady/machine": "Machine that was given in place of a scene.",
    "dam kinematics/axis": "Input coordinate or time of the positions.",
    "dam kinematics/columns": "Quantities over the positions, by address, with unit and extremes.",
    "dam kinematics/equilibria": "Positions at which the linkage rests, and their stability.",
    "dam kinematics/groups": "Groups of links in the order in which they are solved.",
    "dam kinematics/input": "Motion of the input and its limit positions.",
    "dam kinematics/mobility": "Degree of freedom.",
    "dam kinematics/object": "Linkage of the answer.",
    "dam kinematics/stopped": "Where and why the positions end early; null if they do not.",
    "dam kinematics/strokes": "Strokes of outputs and guides, with time ratios.",
    "dam kinematics/transmission_angles": "Extremes of transmission angles.",
    "dam kinematics/singular_positions": "Singular configurations of a linkage with several inputs.",
    "dam forces/columns": "Forces over the positions, by address, with unit.",
    "dam forces/convention": "Sign convention of χ.",
    "dam forces/counterweight": "Best counterweight on the input link; null if there is none.",
    "dam forces/cycle": "Works, losses and efficiency over the course.",
    "dam forces/extremes": "Extremes of each force with their places.",
    "dam forces/indeterminate": "What rigid links leave statically indeterminate.",
    "dam run/studies": "Results of other studies that were asked for, by their addresses.",
    "dam forces/massless": "Comparison with massless links: driving force at each scale of the speed.",
    "dam forces/motion": "Motion of the input, in words.",
    "dam forces/object": "Linkage of the answer.",
    "dam forces/output": "Output whose load is looked at; null without one.",
    "dam forces/positions": "Number of positions.",
    "dam forces/unique": "False if several solutions agree with the friction.",
    "dam forces/zones": "Parts of the course without forces, or with self-locking.",
    "dam cam/cam": "Sizes, checks and forces of the cam.",
    "dam cam/curves": "Profile, pitch curve and cutter path as points.",
    "dam cam/object": "Follower of the cam.",
    "dam cam/tolerance": "Greatest distance of curves from their chords.",
    "dam cam/lift_off": "Speed at which the follower lifts off, by runs.",
    "dam methods/axis": "Parameter that is varied from slice to slice.",
    "dam methods/complete": "True when every point was computed.",
    "dam methods/duration": "Duration of the run (s).",
    "dam methods/fastest_rate": "Fastest rate of the linear model (1/s); null if it has none.",
    "dam methods/fixed_step": "Step of methods with a fixed step (s); null without one.",
    "dam methods/methods": "Methods with their stability and their points: step or tolerance, error, cost.",
    "dam methods/models": "Levels of the model that the accuracy needs.",
    "dam methods/mutual_distances": "Differences between the references, result by result.",
    "dam methods/recommendation": "Cheapest method within the accuracy; null if there is none.",
    "dam methods/reference": "Reference by which errors are measured, and how it was confirmed.",
    "dam methods/samples": "Number of sample intervals of the run.",
    "dam methods/slices": "The same for each value of the parameter.",
    "dam find/best": "Best value and its results; null if no value satisfies the conditions.",
    "dam find/certain": "True when no better value was missed between the samples.",
    "dam find/complete": "True when the search came to its end.",
    "dam find/goal": "What was maximised or minimised.",
    "dam find/places": "Values that were tried, with their results.",
    "dam find/ranges": "Ranges of the parameter in which all conditions hold.",
    "dam find/subject": "Conditions.",
    "dam find/unit": "SI unit of the parameter.",
    "dam find/vary": "Parameter and its range.",
    "dam optimize/best": "Best optimum: values, goal, and what holds it; null if no place satisfies the conditions.",
    "dam optimize/complete": "True when all starts came to their end.",
    "dam optimize/evaluations": "Number of places that were examined.",
    "dam optimize/finer": "Best optimum by a model with twice the masses or modes, and whether it stands.",
    "dam optimize/goal": "What was maximised or minimised.",
    "dam optimize/least_violation": "Where no place satisfies the conditions: the least violation and the conditions in conflict.",
    "dam optimize/optima": "Distinct optima, the best first.",
    "dam optimize/settings": "Best values as settings of the scene.",
    "dam optimize/slopes": "Number of slopes that were exact and that were differences.",
    "dam optimize/starts": "Each start, where it ended and why.",
    "dam optimize/subject": "Conditions.",
    "dam optimize/variables": "Variables and their ranges.",
    "dam identify/answered": "True when the fit converged and the records determine all numbers.",
    "dam identify/complete": "True when all starts came to their end.",
    "dam identify/correlated": "Pairs of which the records determine mainly a combination.",
    "dam identify/correlations": "Correlations of the estimates, row by row; empty if they are unknown.",
    "dam identify/chi_squared": "χ² of the fit by the stated standard deviations, with its degrees of freedom and probability; null without them.",
    "dam identify/misfit": "Why the fit does not explain the records; null if it does.",
    "dam identify/ending": "Why the best fit ended.",
    "dam identify/estimates": "Numbers of the scene: estimate and standard error; null if the records do not determine it. `standing` says why, or under which condition.",
    "dam identify/evaluations": "Number of sets of values that were run.",
    "dam identify/open_directions": "Changes, as shares of the values, that leave the fit as it is. The greatest is 1.",
    "dam identify/remarks": "What is to be known of the fit.",
    "dam identify/residual_sigma": "Standard deviation of a residual over that of its column; null if no fit ended.",
    "dam identify/settings": "Estimates as settings of the scene; empty unless all are determined.",
    "dam identify/signals": "Columns of the records with their residuals, and whether these are random.",
    "dam identify/starts": "Each start, where it ended and why.",
    "dam identify/starts_requested": "Number of starts that were requested.",
    "dam gradient/check": "Agreement of the derivatives with differences of runs; null if not checked.",
    "dam gradient/events": "Number of events of the motion.",
    "dam gradient/gradients": "Results with their derivatives by every parameter, what each is worth, and where it holds.",
    "dam gradient/parameters": "Numbers of the scene, in SI units.",
    "dam tolerance/complete": "True when all samples were run.",
    "dam tolerance/failures": "Samples that could not be run or judged, by their causes.",
    "dam tolerance/figures": "Results: at nominal values and in the middle of the tolerances, stack, distribution, effect of every number.",
    "dam tolerance/limits": "Limits, each with the share of samples that meet it.",
    "dam tolerance/remarks": "What is to be known of all results.",
    "dam tolerance/samples": "Number of samples.",
    "dam tolerance/samples_requested": "Number of samples that were requested.",
    "dam tolerance/seed": "Seed of the samples.",
    "dam tolerance/tolerances": "Numbers of the scene with their tolerances; several deviate by the same. In SI units.",
    "dam tolerance/yield": "Share of the samples that meet all limits, with its interval; null without samples.",
    "dam tolerance/yield_without_failures": "The same among the samples that did not fail.",
    "dam verify/holds": "True when every requirement holds.",
    "dam verify/scenes": "Each scene with its requirements and their judgement.",
    "dam linearise/A": "Matrix A of ẋ = A·x + B·u, a list of its rows.",
    "dam linearise/B": "Matrix B, a list of its rows.",
    "dam linearise/C": "Matrix C of y = C·x + D·u, a list of its rows.",
    "dam linearise/D": "Matrix D, a list of its rows.",
    "dam linearise/mass": "Mass matrix of the deviations, a list of its rows.",
    "dam linearise/damping": "Damping matrix of the deviations, a list of its rows.",
    "dam linearise/stiffness": "Stiffness matrix of the deviations, a list of its rows.",
    "dam linearise/case": "What was linearised.",
    "dam linearise/validity": "When the equations hold.",
    "dam linearise/states": "Names and units of the states: deviations of the masses, then their speeds.",
    "dam linearise/inputs": "Names and units of the inputs: each law with two derivatives, and loads.",
    "dam linearise/outputs": "Names and units of the outputs.",
    "dam linearise/modes": "Natural modes of each tree of masses.",
    "dam linearise/left_out": "Objects without linear equations, with the reason.",
    "dam linearise/operating_point": "Speeds and deviations about which a machine was linearised; empty behind a prescribed drive.",
    "dam linearise/eigenvalues": "Eigenvalues of A with an imaginary part of 0 or more (1/s): real and imaginary part.",
    "dam response/accuracy": "Relative error that the model may have.",
    "dam response/judged_by": "How the error of the model was judged.",
    "dam response/frequencies": "Frequencies (Hz).",
    "dam response/pairs": "Response of each output to each input.",
    "dam orders/left_out": "Objects without orders, with the reason.",
    "dam orders/trees": "Orders, crossings and deviations of each tree of masses.",
    "dam response/left_out": "Objects without linear equations, with the reason.",
    "dam reduce/answer": "Outcome in a few words.",
    "dam reduce/complete": "True when the search came to its end.",
    "dam reduce/cost": "Time of a run of the given and of the reduced scene.",
    "dam reduce/given_holds": "True when the given scene itself is accurate enough.",
    "dam reduce/holds": "True when the reduced scene is within the accuracy.",
    "dam reduce/objects": "Level of the model of each object.",
    "dam reduce/offered": "Further simplifications, in words.",
    "dam reduce/reduced": "The reduced scene.",
    "dam reduce/steps": "What was left out, and what that changed.",
    "dam law compare/by": "Property by which laws are ranked.",
    "dam law compare/laws": "Laws with their constants and the response of the scene.",
    "dam law compare/places": "Rank of each law by each property.",
    "dam law synthesize/criterion": "What was optimised; null if nothing was.",
    "dam law synthesize/figures": "Sizes of the stroke: spans, speeds, accelerations.",
    "dam law synthesize/laws": "Laws of run-up and run-out.",
    "dam law synthesize/unit": "Unit of the stroke.",
    "dam law show/constants": "Constants of the law.",
    "dam law show/joints": "Ends of its pieces.",
    "dam law show/law": "The law.",
    "dam law show/run_up": "True for a law of a run-up or run-out.",
    "dam law cycle/cycle": "Joints, extremes and shocks of the cycle.",
    "dam law cycle/object": "Object whose cycle is shown.",
    "dam law cycle/units": "Units of displacement and input.",
    "dam law list/run_ups": "Laws of run-ups and run-outs.",
    "dam law list/strokes": "Laws of strokes.",
}


def described(definitions: Schema) -> None:
    """Adds the meanings of members that have none."""
    for command, form in definitions.items():
        for name, value in form.get("properties", {}).items():
            meaning = MEANINGS.get(f"{command}/{name}") or MEANINGS.get(name)
            if meaning and ("description" not in value or f"{command}/{name}" in MEANINGS):
                value["description"] = meaning


# Members that are null where a message concerns no place of a text.
PLACES = ("file", "line", "column")


def placed(definitions: Schema) -> None:
    """Messages may have no place."""
    for command, list_name in [("failure", "errors"), ("dam check", "warnings"), ("dam check", "diagnostics")]:
        members = definitions[command]["properties"][list_name].get("items", {}).get("properties", {})
        for name in PLACES:
            if "type" in members.get(name, {}):
                kinds = members[name]["type"]
                members[name]["type"] = sorted({"null", *(kinds if isinstance(kinds, list) else [kinds])})


def schema_of(answers: dict[str, list[Any]]) -> Schema:
    known = types()
    definitions: Schema = {}
    for command in sorted(answers):
        form = Form()
        for document in answers[command]:
            form.add(document, command)
        definitions[command] = form.schema(command, known)
    placed(definitions)
    described(definitions)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Answers of dam with --json, version 1",
        "description": "The document of each command. Numbers are in SI units.",
        "anyOf": [{"$ref": f"#/$defs/{command.replace(' ', '%20')}"} for command in sorted(answers)],
        "$defs": definitions,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--dam", required=True, help="the program")
    parser.add_argument("--jobs", type=int, default=2, help="commands at the same time")
    given = parser.parse_args()
    program = str(Path(given.dam).resolve(strict=True))
    made = schema_of(gathered(program, given.jobs))
    SCHEMA.write_text(json.dumps(made, indent=1, ensure_ascii=False, sort_keys=True) + "\n", encoding="utf-8")
    print(f"{len(made['$defs'])} forms of answers")


if __name__ == "__main__":
    main()
