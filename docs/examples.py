"""Executes what the pages of the site show: commands, Python, scenes; and compares what is printed.

    python docs/examples.py

with the package `dam` installed and its program on the path. Each page has a folder of its own that sees
`scenarios` and `objects`; the pages of the tutorial go on in one, in their order:

- a block of JSON or CSV with a title is a file of that name;
- a block of `sh` is commands, a line each; `# exit status N` behind one is the status expected of it;
- a block of `python` goes on from the block before it on its page;
- a block of `text` behind one of these is what it prints: every line of it in this order, `…` for
  what is left out.

Blocks of `console` are commands that build and install the program, or that serve until they are ended:
python/check and the tests of documents (tests/program/documents.rs) do that. Rust is tested by `cargo test --doc`.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
import unicodedata
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SITE = ROOT / "docs/site"
BLOCK = re.compile(r'^```(\w+)(?: title="([^"]+)")?\n(.*?)^```$', re.DOTALL | re.MULTILINE)


def pages() -> list[Path]:
    """All pages that are written by hand, those of the tutorial in the order of its steps."""
    order = re.findall(r"[\w/-]+\.md", (ROOT / "docs/mkdocs.yml").read_text(encoding="utf-8"))
    known = [SITE / page for page in order if not page.startswith(("gallery/", "reference/"))]
    kept = {path for path in SITE.rglob("*.md") if not {"gallery", "reference"} & set(path.parts)}
    if set(known) != kept:
        raise SystemExit(f"not in the navigation, or not there: {kept ^ set(known)}")
    return known


def run(line: str, folder: Path) -> tuple[str, str | None]:
    """A command: what it prints, and what is wrong with that."""
    command, _, comment = line.partition("   #")
    wanted = re.fullmatch(r"\s*exit status (\d+)", comment)
    status = int(wanted[1]) if wanted else 0
    ran = subprocess.run(
        command, shell=True, cwd=folder, capture_output=True, text=True, timeout=300
    )
    wrong = None
    if ran.returncode != status:
        wrong = f"`{command}` ended with {ran.returncode}: {ran.stderr}"
    return ran.stdout + ran.stderr, wrong


def python(blocks: list[str], folder: Path) -> tuple[str, str | None]:
    """The last of these blocks after those before it, of which only the last is heard."""
    quiet = "\n".join(blocks[:-1])
    text = "import contextlib, io\n"
    # Processes that are started import the file; only this one is to run it.
    body = f"with contextlib.redirect_stdout(io.StringIO()):\n{indented(quiet)}\n{blocks[-1]}"
    text += f"if __name__ == '__main__':\n{indented(body)}"
    script = folder / "page.py"
    script.write_text(text, encoding="utf-8")
    ran = subprocess.run(
        [sys.executable, "page.py"], cwd=folder, capture_output=True, text=True, timeout=300
    )
    return ran.stdout, None if ran.returncode == 0 else ran.stderr


def indented(text: str) -> str:
    return "".join(f"    {line}\n" for line in (text or "pass").splitlines())


def differs(shown: str, printed: str) -> str | None:
    """The first line that is shown and not printed, in this order."""
    rest = map(spaced, printed.splitlines())
    for line in shown.splitlines():
        wanted = spaced(line)
        if wanted in ("", "…"):
            continue
        if not any(found.startswith(wanted) for found in rest):
            return line
    return None


def spaced(line: str) -> str:
    return unicodedata.normalize("NFC", " ".join(line.split()))


def execute(page: Path, folder: Path, only: str | None = None) -> tuple[int, list[str]]:
    """What was executed of a page, of one language or all, and what is wrong."""
    count, faults, printed = 0, list[str](), ""
    said: list[str] = []
    text = page.read_text(encoding="utf-8")
    for language, title, body in BLOCK.findall(text):
        place = f"{page.relative_to(ROOT)}:{text[: text.index(body)].count(chr(10)) + 1}"
        wrong = None
        if only not in (None, language):
            continue
        if language in ("csv", "json") and title:
            (folder / title).write_text(body, encoding="utf-8")
        elif language == "sh":
            printed = ""
            for line in filter(None, body.splitlines()):
                out, wrong = run(line, folder)
                printed += out
                count += 1
                if wrong:
                    break
        elif language == "python":
            said.append(body)
            printed, wrong = python(said, folder)
            count += 1
        elif language == "text":
            missing = differs(body, printed)
            wrong = f"is not printed: {missing}\n{printed}" if missing else None
        elif language not in ("console", "csv", "json", "rust"):
            wrong = f"nobody knows what to do with a block of {language}"
        if wrong:
            faults.append(f"{place}: {wrong}")
    return count, faults


def main() -> None:
    os.environ["COLUMNS"] = "100"
    count, faults = 0, list[str]()
    with tempfile.TemporaryDirectory() as name:
        # Commands of the README are run by tests/program/documents.rs.
        for page in [*pages(), ROOT / "README.md"]:
            folder = Path(name) / (page.parent.name if page.parent.name == "tutorial" else page.stem)
            if not folder.exists():
                folder.mkdir()
                for shared in ("scenarios", "objects"):
                    (folder / shared).symlink_to(ROOT / shared)
            done, wrong = execute(page, folder, "python" if page.name == "README.md" else None)
            count += done
            faults += wrong
    if faults:
        raise SystemExit("\n".join(faults))
    if count < 60:
        raise SystemExit(f"only {count} commands are shown")
    print(f"{count} commands and pieces of Python of the site executed")


if __name__ == "__main__":
    main()
