#!/usr/bin/env python3
"""Lines of code without tests, comments and blank lines, by folder.

    tests/prices/lines.py [DEPTH]    folders of src down to a depth (2 if not given)

Doc tests count as comments. Of the studio and of Python what is written by hand counts.
"""

import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
TESTS = {"tests", "testing", "fixture"}


def is_test(path):
    stems = [part.removesuffix(".rs") for part in path.parts]
    return any(s in TESTS or s.endswith("_tests") or s.startswith("testing_") for s in stems)


def lines_of(path):
    """Lines of code of a Rust source up to its tests."""
    count, within = 0, False
    lines = path.read_text().splitlines()
    for line, after in zip(lines, [*lines[1:], ""]):
        bare = line.strip()
        if line == "#[cfg(test)]" and after.startswith("mod ") and after.endswith("{"):
            break
        if within or bare.startswith("/*"):
            within = "*/" not in bare
            continue
        count += bool(bare) and not bare.startswith("//")
    return count


def main():
    depth = int(sys.argv[1]) if len(sys.argv) > 1 else 2
    counts, files = Counter(), Counter()
    for path in sorted((ROOT / "src").rglob("*.rs")):
        own = path.relative_to(ROOT)
        if is_test(own.relative_to("src")):
            continue
        folder = "/".join(own.parts[: min(depth, len(own.parts) - 1)])
        counts[folder] += lines_of(path)
        files[folder] += 1
    for folder, count in sorted(counts.items()):
        print(f"{folder:40} {files[folder]:5} files {count:8} lines")
    print(f"{'src':40} {sum(files.values()):5} files {sum(counts.values()):8} lines")


if __name__ == "__main__":
    main()
