#!/usr/bin/env python3
"""Mutants of the closed forms, the laws and the events, and which check of a run finds them.

    mutants.py list            writes candidates.tsv: every place that a rule below matches
    mutants.py draw SEED COUNT writes drawn.tsv: so many of them, drawn by the seed
    mutants.py build           patches the sources, builds once, restores the sources
    mutants.py run [FOLDER]    runs the scenes, and those of a folder besides, with each mutant
                               and writes results.tsv

equivalent.tsv says of mutants that nothing finds why no figure of a run can change by them.

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
import time
from concurrent.futures import ThreadPoolExecutor
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
src/dynamics/system/switches.rs src/dynamics/system/loads.rs src/dynamics/laws/friction.rs src/dynamics/laws/kloss.rs
src/dynamics/laws/speed_table.rs src/dynamics/laws/contact/power.rs
src/dynamics/restitution.rs src/dynamics/integrate/locate.rs src/math/polynomial/roots.rs
""".split()

# A term behind a sign gets the other sign; a number is half as great again; a condition is
# the opposite.
TERM = re.compile(r"(?<=[\w)\]] )([+-]) (?=[\w(])")
NUMBER = re.compile(r"(?<![\w.\[])(\d+\.\d+)(?![\w.])")
CONDITION = re.compile(r"^(\s*(?:\} else )?if )((?!let )[^{}]*?[<>][^{}]*?)( \{)$")

SCENES = ["scenarios/*/*.json", "tests/reference/public/*.json", "tests/mutants/scenes/*.json"]
METHODS = ["auto", "dop853"]
# Figures agree to this share of the greatest of their kind, else a run is wrong.
WRONG = 1e-4
# Scenes that take longer than this, in s, are left out: the same code runs in others.
DEAREST = 0.6


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
fn is_mutant(number: u32) -> bool {
    static NUMBER: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    let drawn = *NUMBER.get_or_init(|| {
        let number = std::env::var("DAM_MUTANT").ok();
        number.and_then(|number| number.parse().ok()).unwrap_or(u32::MAX)
    });
    if drawn == number {
        static REACHED: std::sync::Once = std::sync::Once::new();
        REACHED.call_once(|| eprintln!("mutant reached"));
    }
    drawn == number
}
pub(crate) fn mutant_sign(number: u32) -> f64 { if is_mutant(number) { -1.0 } else { 1.0 } }
pub(crate) fn mutant_number(number: u32, value: f64) -> f64 {
    if is_mutant(number) { 1.5 * value } else { value }
}
pub(crate) fn mutant_condition(number: u32, value: bool) -> bool { is_mutant(number) != value }
'''


def read(name):
    """Rows of a list; each is looked up again by its text, the nearest line that has it."""
    rows = []
    for row in (HERE / name).read_text().splitlines()[1:]:
        number, path, line, place, kind, text = row.split("\t")
        lines = (ROOT / path).read_text().splitlines()
        at = [i for i, there in enumerate(lines) if there.strip() == text]
        if not at:
            sys.exit(f"{path} no longer has: {text}")
        line = min(at, key=lambda i: abs(i - int(line)))
        rows.append((int(number), path, line, int(place), kind, text))
    return rows


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
    began = time.monotonic()
    broken = {"check": "refused or broken off", "figures": {}, "reached": True}
    try:
        ran = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=20)
        document = json.loads(ran.stdout)
    except (subprocess.TimeoutExpired, json.JSONDecodeError):
        return broken
    if "run" not in document:
        return broken
    figures = {}
    for name, values in document["objects"].items():
        for figure in ("delta_abs", "peak_speed", "peak_acceleration", "peak_reaction"):
            if isinstance(values.get(figure), (int, float)):
                figures[f"{name}.{figure}"] = values[figure]
    return {
        "check": check_of(document),
        "figures": figures,
        "time": document["run"]["time"],
        "seconds": time.monotonic() - began,
        "reached": "mutant reached" in ran.stderr,
    }


def check_of(document):
    """The check that did not hold in a run; None: all held."""
    run = document["run"]
    if any("not to be trusted" in warning for warning in document["warnings"]):
        kept = run["equations"]["defect"] is not None and run["equations"]["defect"] <= run["equations"]["bound"]
        return "energies" if kept else f"audit: {run['equations']['what']}"
    if "equations of motion are not kept" in run["why"]:
        return "audit, and another method taken"
    if "energies of exact propagation do not balance" in run["why"]:
        return "energies, and another method taken"
    if "exact propagation gave up" in run["why"]:
        return "exact gave up, and another method taken"
    if not run["complete"] and run.get("stopped") not in ("dead_position", "end_of_travel", "self_locking"):
        return f"stopped: {run.get('stopped')}"
    return None


def differs(one, other, share=WRONG):
    """Whether figures of two runs differ by more than a share of the greatest of their kind."""
    if one["figures"].keys() != other["figures"].keys():
        return True
    if not math.isclose(one["time"], other["time"], rel_tol=share):
        return True
    for name, value in one["figures"].items():
        there = other["figures"][name]
        kind = name.rsplit(".", 1)[1]
        scale = max((abs(v) for n, v in one["figures"].items() if n.endswith(kind)), default=0.0)
        if not math.isclose(value, there, rel_tol=share, abs_tol=share * scale):
            return True
    return False


def plain_runs(scenes):
    """Outcomes without a mutant of the runs that end and are trusted. Where the methods do
    not agree the motion is not determined by the scene (rounding decides), and it is left out."""
    plain = {}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for scene, ran in zip(scenes, pool.map(lambda scene: [outcome(scene, m, -1) for m in METHODS], scenes)):
            sound = [found["check"] is None and found["figures"] for found in ran]
            if all(sound) and differs(*ran, share=1e-5):
                continue
            for method, found, is_sound in zip(METHODS, ran, sound):
                if is_sound and found["seconds"] < DEAREST:
                    plain[scene, method] = found
    return plain


def run(folder):
    patterns = [path for pattern in SCENES for path in ROOT.glob(pattern)]
    patterns += Path(folder).glob("*.json") if folder else []
    plain = plain_runs(sorted({scene for scene in patterns if "schema" not in scene.name}))
    print(len(plain), "runs without a mutant")
    lines = ["number\treached in\tother digits in\tfound in\tsilent in\tchecks\tsilent scenes\tfile\tline\tkind\ttext"]
    for number, path, line, _, kind, text in read("drawn.tsv"):
        reached, digits, found, silent, checks = 0, 0, 0, [], {}
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            outcomes = list(pool.map(lambda task: outcome(*task, number), plain))
        for ((scene, method), right), now in zip(plain.items(), outcomes):
            reached += now["reached"]
            if now["check"]:
                found += 1
                checks[now["check"]] = checks.get(now["check"], 0) + 1
            elif differs(right, now):
                silent.append(f"{scene.stem}/{method}")
            elif differs(right, now, share=0.0):
                digits += 1
        words = ", ".join(f"{name} {count}" for name, count in sorted(checks.items(), key=lambda c: -c[1]))
        counts = [number, reached, digits, found, len(silent)]
        row = [*counts, words, " ".join(silent[:6]), path, line + 1, kind, text]
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
        run(sys.argv[2] if len(sys.argv) > 2 else None)
