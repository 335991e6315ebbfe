#!/usr/bin/env python3
"""Mutated invocations of the real program, over all commands.

    fuzz/invocations.py target/release/dam [--count 2000] [--first 0] [--seed 1] [--jobs 2] [--limit 3]

Every invocation must end by itself within 5 s of processor time and 1 GB of
memory (they have a time limit of --limit or less), with status 0, 1 or 2, without a
panic, and what ends with status 0 must not show a number that is none. Scenes are those of scenarios/, with values
exchanged, scaled, dropped, or broken as text; about two of three are accepted.
Some invocations are told to stop on the way (SIGINT: 130, SIGTERM: 143).
Each is made from the seed and its number alone: a failure is repeated with
--only NUMBER, which also shows the command and keeps the scene.
"""

import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
RECORD = str(ROOT / "scenarios/shafts/released_wheel.csv")
SECONDS = 5
MEMORY = 1 << 30
FACTORS = [0, -1, 1e-300, 1e-30, 1e-9, 1e-3, 0.5, 0.9, 1.1, 2, 10, 1e3, 1e9, 1e30, 1e300]
NUMBER = re.compile(r"-?\d+(\.\d+)?([eE][-+]?\d+)?")
NONE = re.compile(r"(?<![\w.])(NaN|-?inf(inity)?|not a number)(?![\w.])", re.IGNORECASE)


def places(value, path=()):
    """Paths of all leaves of a document."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield from places(item, path + (key,))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from places(item, path + (index,))
    else:
        yield path


def get(value, path):
    for key in path:
        value = value[key]
    return value


def put(value, path, new):
    for key in path[:-1]:
        value = value[key]
    value[path[-1]] = new


def gently(random_, leaf):
    """A value that is probably still sense."""
    factor = random_.choice([0.5, 0.8, 0.95, 1.05, 1.25, 2.0])
    return changed(leaf, factor)


def wildly(random_, leaf):
    return changed(leaf, random_.choice(FACTORS) * random_.choice([1, 1, 1, -1]))


def changed(leaf, factor):
    if isinstance(leaf, bool):
        return not leaf
    if isinstance(leaf, int) and float(factor).is_integer():
        return int(leaf * factor) if abs(leaf * factor) < 1e15 else leaf
    if isinstance(leaf, (int, float)):
        new = leaf * factor
        return new if math.isfinite(new) else leaf
    if isinstance(leaf, str) and NUMBER.match(leaf):
        number = float(NUMBER.match(leaf).group()) * factor
        return NUMBER.sub(repr(number), leaf, count=1) if math.isfinite(number) else leaf
    return leaf


def mutated(random_, scene):
    """A scene with some values changed, as text."""
    scene = json.loads(json.dumps(scene))
    run = scene.setdefault("run", {})
    # What is fuzzed is the program, not patience: runs are short.
    if isinstance(run.get("duration"), (int, float)):
        run["duration"] = min(run["duration"], 0.2)
    run["samples"] = min(run.get("samples", 200), 200)
    scene.pop("expect", None)
    all_places = [p for p in places(scene) if p[0] in ("objects", "run", "steady")]
    kind = random_.random()
    if kind < 0.70:
        for _ in range(random_.randint(0, 3)):
            path = random_.choice(all_places)
            put(scene, path, gently(random_, get(scene, path)))
    elif kind < 0.92:
        for _ in range(random_.randint(1, 3)):
            path = random_.choice(all_places)
            put(scene, path, wildly(random_, get(scene, path)))
    elif kind < 0.97:
        path = random_.choice(all_places)
        new = random_.choice([None, [], {}, "", "x", True, -0.0, 10**30, "1e999", "nan"])
        put(scene, path, new)
    text = json.dumps(scene, ensure_ascii=False)
    if kind >= 0.97:
        at = random_.randrange(len(text))
        text = text[:at] + random_.choice(["", "\x1b[31m", "\0", "}", '"', "9" * 400]) + text[at + 1 :]
    return text


def over(random_, scene):
    """A property with a number, as an address, and its value."""
    leaves = []
    for path in places(scene["objects"]):
        value = get(scene["objects"], path)
        number = isinstance(value, (int, float)) and not isinstance(value, bool)
        if number and all(isinstance(key, str) for key in path):
            leaves.append((".".join(path), value))
    return random_.choice(leaves) if leaves else ("run.tolerance", 1e-6)


def fitting(random_, scene):
    """Commands that have something to say of a scene; now and then all of them."""
    everywhere = ["run", "run", "run", "run", "check", "show", "compare", "map", "free", "law",
                  "reduce", "linearise", "response", "orders", "gradient", "tolerance", "optimize", "find", "identify"]
    others = ["kinematics", "forces", "cam", "steady", "methods", "schema"]
    if random_.random() < 0.05:
        return everywhere + others
    objects = json.dumps(scene["objects"])
    fits = {
        "kinematics": '"linkage"' in objects or '"slider_crank"' in objects or '"four_bar"' in objects,
        "forces": '"linkage"' in objects,
        "cam": '"base_radius"' in objects,
        "steady": "steady" in scene,
        "methods": '"masses"' in objects or '"motor"' in objects,
    }
    own = [command for command in others if fits.get(command)]
    return everywhere + own + own


def about_numbers(random_, command, number, first):
    """Arguments of a study of numbers of the scene."""
    name, value = number
    span = f"{name}={value * 0.5}:{value * 2}"
    if command == "gradient":
        return ["--by", name]
    if command == "tolerance":
        tolerance = random_.choice(["±1 %", "±0.1", "+1 -0.5 mm", "h7"])
        return ["--tol", f"{name}={tolerance}", "--samples", "8", "--threads", "1"]
    if command == "find":
        return ["--vary", f"{span}:3", "--maximize", name, "--threads", "1"]
    if command == "optimize":
        goal = random_.choice([f"{first}.delta_max", f"{first}.peak_speed", name])
        return ["--vary", span, "--minimize", goal, "--starts", "1", "--threads", "1"]
    signal = f"{first}.{random_.choice(['delta', 'displacement'])}"
    return ["--record", RECORD, "--match", f"deflection={signal}", "--vary", span, "--starts", "1", "--threads", "1"]


def arguments(random_, scene, path, out, limit):
    command = random_.choice(fitting(random_, scene))
    name, value = over(random_, scene)
    axis = f"{name}={value * 0.8}:{value * 1.2}:3"
    extra = []
    if command == "law":
        return ["law", *random_.choice([
            ["list"], ["list", "--json"], ["show", "sine"], ["show", "scca:0.25,0.5"],
            ["cycle", path, "--of", next(iter(scene["objects"]))],
            ["synthesize", "--stroke", f"{random_.choice(FACTORS)} mm", "--span", "120 deg"],
        ])]
    if command == "schema":
        return ["schema"]
    if command == "free":
        # A machine of expressions.
        size = random_.choice(FACTORS)
        return ["steady", f"--inertia=1+{random_.random()}*cos(phi)", f"--work={size}*cos(phi)",
                "--mean-speed", str(random_.choice(FACTORS)), "--json",
                *random_.choice([[], ["--balance"], ["--mean", "midrange"], ["--fluctuation", "0.1"]])]
    first = next(iter(scene["objects"]), "none")
    if command in ("gradient", "tolerance", "optimize", "find", "identify"):
        extra = about_numbers(random_, command, (name, value), first)
    elif command == "show":
        extra = ["--view", random_.choice(["all", "graph", "model", "equations"])]
    elif command == "compare":
        extra = ["--over", f"{name}={value},{value * random_.choice(FACTORS)}"]
    elif command == "map":
        extra = ["--x", axis, "--threads", "1"]
    elif command == "methods":
        extra = ["--repeats", "1", "--point-limit", "0.05", "--tolerances", "1e-3,1e-6"]
        extra += random_.choice([[], ["--models"]])
    elif command == "run":
        extra = random_.choice([[], [], [], ["--accuracy", "1 %"]])
    elif command == "response":
        extra = random_.choice([[], ["--frequencies", f"1:{random_.choice(FACTORS)} kHz:20"], ["--accuracy", "5 %"]])
    elif command == "reduce":
        extra = random_.choice([[], ["--accuracy", "5 %"]])
    elif command in ("kinematics", "forces"):
        extra = random_.choice([[], ["--turn"], ["--time"], ["--positions", "7"], ["--csv"]])
    elif command == "cam":
        extra = random_.choice([[], ["--tolerance", f"{random_.choice(FACTORS)} mm"], ["--form", "dxf"]])
    if random_.random() < 0.3 and "--csv" not in extra and "--form" not in extra:
        extra.append("--json")
    if random_.random() < 0.2 and command not in ("check", "show"):
        extra += ["--out", out]
    if random_.random() < 0.1:
        extra += ["--set", f"{name}={random_.choice(FACTORS) * value!r}"]
    # Wild scenes may have much to compute: the limit must be heard wherever that is.
    extra += ["--time-limit", random_.choice(["0.01", "0.1", "1", *[limit] * 9])]
    return [command, path, *extra]


def bounded():
    """Limits of this process, which those that it starts have too."""
    resource.setrlimit(resource.RLIMIT_AS, (4 * MEMORY, 4 * MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def limited(pid):
    """Ends a process that takes too much processor time. (Not between fork and exec: starting
    would cost several times as much.)"""
    try:
        resource.prlimit(pid, resource.RLIMIT_CPU, (SECONDS, SECONDS + 1))
    except ProcessLookupError:
        pass


def catches(pid, told):
    """True when the process has a handler for the signal."""
    try:
        lines = pathlib.Path(f"/proc/{pid}/status").read_text().splitlines()
    except OSError:
        # Where there is no such place to look, the early end is let pass.
        return False
    caught = next((line.split()[1] for line in lines if line.startswith("SigCgt:")), "0")
    return bool(int(caught, 16) >> (told - 1) & 1)


def trouble(status, cpu, memory, out, err, told):
    """What is wrong with how an invocation ended, if anything."""
    allowed = {0, 1, 2} | ({128 + told} if told else set())
    if b"panicked" in err or b"overflowed its stack" in err:
        return "panic"
    if status < 0 and -status in (signal.SIGXCPU, signal.SIGKILL):
        return f"more than {SECONDS} s of processor time"
    if status not in allowed:
        return f"status {status}"
    if cpu > SECONDS:
        return f"{cpu:.1f} s of processor time"
    if memory > MEMORY:
        return f"{memory >> 20} MB of memory"
    if status == 0 and NONE.search(out.decode(errors="replace")):
        return "a number that is none, with status 0"
    if re.search(rb"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]", out + err):
        return "control characters on the terminal"
    return None


def invoke(program, seed, number, limit, keep=False):
    random_ = random.Random(f"{seed} {number}")
    source = random_.choice(SCENES)
    scene = json.loads(source.read_text())
    with tempfile.TemporaryDirectory(prefix="dam-fuzz-") as folder:
        # Beside the scene lies what it refers to.
        path = os.path.join(folder, "scene.json")
        text = mutated(random_, scene)
        pathlib.Path(path).write_text(text, encoding="utf-8", errors="replace")
        for beside in source.parent.iterdir():
            if beside.suffix != ".json" or beside.is_dir():
                os.symlink(beside, os.path.join(folder, beside.name))
        args = arguments(random_, scene, path, os.path.join(folder, "out"), limit)
        told = random_.choice([signal.SIGINT, signal.SIGTERM]) if random_.random() < 0.05 else None
        after = random_.random() * 0.05
        if keep:
            print(program, *args)
            pathlib.Path("fuzz-scene.json").write_text(text, encoding="utf-8", errors="replace")
        files = [tempfile.TemporaryFile() for _ in range(2)]
        child = subprocess.Popen([program, *args], stdin=subprocess.DEVNULL, stdout=files[0],
                                 stderr=files[1])
        limited(child.pid)
        told_at_once = False
        if told:
            time.sleep(after)
            # While the program is still being loaded nobody listens: the signal then
            # ends it by itself, which a shell shows with the same status.
            told_at_once = not catches(child.pid, told)
            os.kill(child.pid, told)
        _, wait_status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(wait_status)
        if told_at_once and child.returncode == -told:
            child.returncode = 128 + told
        output = []
        for file in files:
            file.seek(0)
            output.append(file.read())
            file.close()
        cpu = used.ru_utime + used.ru_stime
        wrong = trouble(child.returncode, cpu, used.ru_maxrss * 1024, *output, told)
        left = [p for p in pathlib.Path(folder).rglob(".*.part")]
        if not wrong and left:
            wrong = f"{left[0].name} stays behind"
        return {"number": number, "args": args[:1] + args[2:], "scene": source.name,
                "status": child.returncode, "cpu": cpu, "memory": used.ru_maxrss >> 10,
                "wrong": wrong, "err": output[1][-600:].decode(errors="replace")}


SCENES = sorted(p for p in (ROOT / "scenarios").rglob("*.json") if "objects" in json.loads(p.read_text()))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--limit", default="3", help="time limit of most of them, s (default 3)")
    parser.add_argument("--first", type=int, default=0, help="number of the first one")
    parser.add_argument("--only", type=int)
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    bounded()
    if options.only is not None:
        print(json.dumps(invoke(program, options.seed, options.only, options.limit, keep=True), indent=1))
        return 0
    counts, worst, failures = {}, [], 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        numbers = range(options.first, options.first + options.count)
        runs = pool.map(lambda n: invoke(program, options.seed, n, options.limit), numbers)
        for result in runs:
            counts[result["status"]] = counts.get(result["status"], 0) + 1
            worst = sorted(worst + [(result["cpu"], result["number"])])[-5:]
            if result["wrong"]:
                failures += 1
                print(f"{result['number']}: {result['wrong']}: {result['scene']} {result['args']}\n{result['err']}")
    print(f"{options.count} invocations, seed {options.seed}, by status: {dict(sorted(counts.items()))}")
    print("longest (s, number):", ", ".join(f"{cpu:.2f} {number}" for cpu, number in worst))
    print(f"{failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
