#!/usr/bin/env python3
"""Mutants of the closed forms, the laws and the events, and which check of a run finds them.

    mutants.py list            writes candidates.tsv: every place that a rule below matches
    mutants.py draw SEED COUNT writes drawn.tsv: so many of them, drawn by the seed
    mutants.py build           patches the sources, builds once, restores the sources
    mutants.py run             runs the scenes with each mutant and writes results.tsv

All mutants are in one program: each place asks for the number in the environment variable
DAM_MUTANT. The sources are restored after the build, whatever happens.
"""

import json
import math
import os
import random
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PROGRAM = ROOT / "target" / "mutants" / "dam"

FILES = """
src/exact/from_model/fit.rs src/exact/from_model/law.rs src/exact/from_model/prescribed.rs
src/exact/from_model/builder/loads.rs src/exact/from_model/builder/masses.rs
src/exact/from_model/builder/sums.rs src/exact/from_model/rhythm.rs
src/exact/phase.rs src/exact/event_function.rs src/exact/impacts.rs src/exact/law.rs
src/exact/basis/response.rs src/exact/resonance.rs src/exact/regime.rs src/exact/problem.rs
src/exact/functional.rs src/exact/pencil.rs
src/kinematics/motion/mod.rs src/kinematics/motion/run_up.rs src/kinematics/motion/spline.rs
src/kinematics/motion/written.rs src/kinematics/motion/law/mod.rs
src/kinematics/motion/law/form.rs src/kinematics/motion/law/trapezoid.rs
src/kinematics/motion/law/compose.rs src/kinematics/motion/law/polynomial.rs
src/kinematics/motion/cycle/mod.rs src/kinematics/motion/cycle/joints.rs
src/kinematics/position/mod.rs src/kinematics/position/sine.rs
src/kinematics/position/table.rs src/kinematics/position/cam.rs src/kinematics/breaks.rs
src/dynamics/builder/pieces.rs src/dynamics/builder/written.rs
src/dynamics/system/pairs.rs src/dynamics/system/impacts.rs src/dynamics/system/stops.rs
src/dynamics/system/switches.rs src/dynamics/system/loads.rs src/dynamics/system/hertz.rs
src/dynamics/restitution.rs src/dynamics/integrate/locate.rs src/math/polynomial/roots.rs
""".split()

# A term behind a sign gets the other sign; a number is half as great again; a condition is
# the opposite.
TERM = re.compile(r"(?<=[\w)\]] )([+-]) (?=[\w(])")
NUMBER = re.compile(r"(?<![\w.\[])(\d+\.\d+)(?![\w.])")
CONDITION = re.compile(r"^(\s*(?:\} else )?if )((?!let )[^{}]*?[<>][^{}]*?)( \{)$")

SCENES = [
    *(f"scenarios/{name}/*.json" for name in
      "rocker cams contact indexing valve_train loads differential slotted_link four_bar rigid".split()),
    *(f"tests/reference/public/{name}.json" for name in
      ["motion_*", "geneva_*", "written_feed_smooth", "hunting", "catch_up", "double_dwell"]),
]
METHODS = ["auto", "dop853"]
# Figures agree to this share of the greatest of their kind, else a run is wrong.
WRONG = 1e-4


def code_lines(path):
    """Lines of a file that are code, with their numbers: no tests, comments, constants."""
    depth_of_tests = False
    for number, line in enumerate((ROOT / path).read_text().splitlines()):
        if line.startswith("#[cfg(test)]"):
            depth_of_tests = True
        bare = line.split("//")[0].rstrip()
        if depth_of_tests or not bare or re.match(r"\s*(pub(\(\w+\))? )?(const|static|use|fn|impl|struct|type)\b", bare):
            continue
        if '"' in bare or "assert" in bare or "where" in bare:
            continue
        yield number, bare


def candidates():
    found = []
    for path in FILES:
        if not (ROOT / path).exists():
            continue
        for number, line in code_lines(path):
            for match in TERM.finditer(line):
                found.append((path, number, match.start(1), "term", line.strip()))
            for match in NUMBER.finditer(line):
                if float(match.group(1)) != 0.0:
                    found.append((path, number, match.start(1), "number", line.strip()))
            match = CONDITION.match(line)
            if match and "||" not in line and "&&" not in line:
                found.append((path, number, match.start(2), "condition", line.strip()))
    return found


def patched(line, place, kind, number):
    head, tail = line[:place], line[place:]
    if kind == "term":
        return f"{head}{tail[0]} crate::mutant_sign({number}) * {tail[2:]}"
    if kind == "number":
        value = NUMBER.match(" " + tail, 1).group(1)
        return f"{head}crate::mutant_number({number}, {value}){tail[len(value):]}"
    condition = CONDITION.match(line).group(2)
    return f"{head}crate::mutant_condition({number}, {condition}){tail[len(condition):]}"


HOOK = '''
fn mutant() -> u32 {
    static NUMBER: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    *NUMBER.get_or_init(|| {
        let number = std::env::var("DAM_MUTANT").ok();
        number.and_then(|number| number.parse().ok()).unwrap_or(u32::MAX)
    })
}
pub(crate) fn mutant_sign(number: u32) -> f64 { if mutant() == number { -1.0 } else { 1.0 } }
pub(crate) fn mutant_number(number: u32, value: f64) -> f64 {
    if mutant() == number { 1.5 * value } else { value }
}
pub(crate) fn mutant_condition(number: u32, value: bool) -> bool { (mutant() == number) != value }
'''


def read(name):
    lines = (HERE / name).read_text().splitlines()[1:]
    rows = [line.split("\t") for line in lines]
    return [(int(n), path, int(line), int(place), kind, text) for n, path, line, place, kind, text in rows]


def write(name, rows):
    head = "number\tfile\tline\tplace\tkind\ttext"
    (HERE / name).write_text("\n".join([head] + ["\t".join(map(str, row)) for row in rows]) + "\n")


def apply(rows, sources):
    """Writes the patched sources; several mutants of a line from its end on."""
    texts = {path: text.splitlines() for path, text in sources.items() if path != "src/lib.rs"}
    for number, path, line, place, kind, _ in sorted(rows, key=lambda row: (row[1], row[2], -row[3])):
        texts[path][line] = patched(texts[path][line], place, kind, number)
    for path, lines in texts.items():
        (ROOT / path).write_text("\n".join(lines) + "\n")
    (ROOT / "src/lib.rs").write_text(sources["src/lib.rs"] + HOOK)


def build():
    rows = read("drawn.tsv")
    sources = {path: (ROOT / path).read_text() for path in {row[1] for row in rows} | {"src/lib.rs"}}
    try:
        for _ in range(6):
            apply(rows, sources)
            checked = subprocess.run(
                ["cargo", "check", "--message-format=json"], cwd=ROOT, capture_output=True, text=True
            )
            wrong = set()
            for line in checked.stdout.splitlines():
                message = json.loads(line).get("message") or {}
                if message.get("level") == "error":
                    for span in message["spans"]:
                        wrong.add((span["file_name"], span["line_start"] - 1))
            if checked.returncode == 0:
                break
            dropped = [row for row in rows if (row[1], row[2]) in wrong]
            if not dropped:
                sys.exit(checked.stderr[-3000:])
            # (The rules know no types: what they make of these does not compile.)
            print("does not compile:", *(f"{row[0]} {row[5]}" for row in dropped), sep="\n  ")
            rows = [row for row in rows if row not in dropped]
        write("drawn.tsv", rows)
        subprocess.run(["cargo", "build"], cwd=ROOT, check=True)
        PROGRAM.parent.mkdir(exist_ok=True)
        PROGRAM.write_bytes((ROOT / "target/debug/dam").read_bytes())
        PROGRAM.chmod(0o755)
    finally:
        for path, text in sources.items():
            (ROOT / path).write_text(text)


def outcome(scene, method, number):
    command = [str(PROGRAM), "run", str(scene), "--json", "--time-limit", "3"]
    command += [] if method == "auto" else ["--set", f"run.method={method}"]
    environment = dict(os.environ, DAM_MUTANT=str(number))
    try:
        ran = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=20)
        document = json.loads(ran.stdout)
    except (subprocess.TimeoutExpired, json.JSONDecodeError):
        return {"check": "refused or broken off", "figures": {}}
    if "run" not in document:
        return {"check": "refused or broken off", "figures": {}}
    run = document["run"]
    check = None
    if any("not to be trusted" in warning for warning in document["warnings"]):
        kept = run["equations"]["defect"] is not None and run["equations"]["defect"] <= run["equations"]["bound"]
        check = "energies" if kept else f"audit: {run['equations']['what']}"
    elif "equations of motion are not kept" in run["why"]:
        check = "audit, and another method taken"
    elif "energies of exact propagation do not balance" in run["why"]:
        check = "energies, and another method taken"
    elif not run["complete"] and run.get("stopped") not in ("dead_position", "end_of_travel", "self_locking"):
        check = f"stopped: {run.get('stopped')}"
    figures = {}
    for name, values in document["objects"].items():
        for figure in ("delta_abs", "peak_speed", "peak_acceleration", "peak_reaction"):
            if isinstance(values.get(figure), (int, float)):
                figures[f"{name}.{figure}"] = values[figure]
    return {"check": check, "figures": figures, "time": run["time"]}


def differs(one, other):
    if one["figures"].keys() != other["figures"].keys() or one.get("time") != other.get("time"):
        return True
    for name, value in one["figures"].items():
        there = other["figures"][name]
        kind = name.rsplit(".", 1)[1]
        scale = max((abs(v) for n, v in one["figures"].items() if n.endswith(kind)), default=0.0)
        if not math.isclose(value, there, rel_tol=WRONG, abs_tol=WRONG * scale):
            return True
    return False


def run():
    scenes = sorted({path for pattern in SCENES for path in ROOT.glob(pattern)})
    scenes = [scene for scene in scenes if "schema" not in scene.name]
    plain = {}
    for scene in scenes:
        for method in METHODS:
            found = outcome(scene, method, -1)
            if found["check"] is None and found["figures"]:
                plain[scene, method] = found
    print(len(plain), "runs without a mutant")
    lines = ["number\tfound in\tsilent in\tchecks\tsilent scenes\tfile\tline\tkind\ttext"]
    for number, path, line, _, kind, text in read("drawn.tsv"):
        found, silent, checks = 0, [], {}
        for (scene, method), right in plain.items():
            now = outcome(scene, method, number)
            if now["check"]:
                found += 1
                checks[now["check"]] = checks.get(now["check"], 0) + 1
            elif differs(right, now):
                silent.append(f"{scene.stem}/{method}")
        words = ", ".join(f"{name} {count}" for name, count in sorted(checks.items(), key=lambda c: -c[1]))
        row = [number, found, len(silent), words, " ".join(silent[:6]), path, line + 1, kind, text]
        lines.append("\t".join(map(str, row)))
        print(lines[-1], flush=True)
        (HERE / "results.tsv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    if sys.argv[1] == "list":
        rows = [(number, *row) for number, row in enumerate(candidates())]
        write("candidates.tsv", rows)
        print(len(rows), "candidates")
    elif sys.argv[1] == "draw":
        rows = read("candidates.tsv")
        drawn = random.Random(int(sys.argv[2])).sample(rows, int(sys.argv[3]))
        write("drawn.tsv", sorted(drawn))
    elif sys.argv[1] == "build":
        build()
    else:
        run()
