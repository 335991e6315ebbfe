"""Pictures of the report pages that get-started and the tutorial show, light and dark.

    python docs/tutorial_pictures.py --dam target/release/dam [--only cam]

takes scenes and commands from the pages themselves: what a reader would paste. It then
photographs the report page in a headless Chromium (BROWSER names another). Sections that are not shown are hidden.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SITE = ROOT / "docs/site"
BLOCK = re.compile(r'^```(\w+)(?: title="([^"]+)")?\n(.*?)^```$', re.DOTALL | re.MULTILINE)
# Of Chromium's `preferredColorScheme`.
SCHEMES = {"dark": 0, "light": 1}
# More than 250 kB make a page slow to load.
LARGEST = 250_000
WIDTH = 900


@dataclass
class Picture:
    """A report page that a page of the site shows."""

    name: str
    page: str
    # The folder of `--out` in a command of that page.
    out: str
    # Beginnings of the headings of the sections that are shown below the answer; "": what is before them.
    sections: list[str]
    height: int
    # How far the player of the machine has gone, 0 to 1.
    at: float | None = None
    # The page whose scene this one goes on with.
    after: str | None = None


PICTURES = [
    Picture("first-answer", "get-started.md", "out", [], 170),
    Picture("first-report", "get-started.md", "out", ["Mechanism", "The machine moving"], 880, at=0.0555),
    Picture("first-scene", "tutorial/first-scene.md", "lever", ["The machine moving"], 630, at=0.0555),
    Picture("closing", "tutorial/lift-off.md", "closing", ["lever"], 600, after="tutorial/first-scene.md"),
    Picture("masses", "tutorial/how-good.md", "masses", ["lever"], 600, after="tutorial/first-scene.md"),
    Picture("map", "tutorial/own-machine.md", "map", ["Map"], 970),
    Picture("cam", "tutorial/cam-from-table.md", "cam", ["Cam and follower"], 900, at=0.22),
    Picture("press", "tutorial/press.md", "forces", ["The mechanism with its forces"], 710, at=0.92),
    Picture("flywheel", "tutorial/press.md", "flywheel", ["Motion over a cycle"], 620),
    Picture("methods", "tutorial/model-and-method.md", "methods", ["Error against time"], 800),
    Picture("find", "tutorial/requirements.md", "fastest", ["Over the range"], 800),
]

# Hides what is not shown, and moves the machine on.
PREPARE = """<script>
addEventListener("load", () => {
  const shown = %s;
  document.querySelector("footer")?.remove();
  // They are seen under a pointer alone.
  document.querySelectorAll(".chart .saves").forEach((buttons) => buttons.remove());
  let keep = shown.includes("");
  for (const part of document.querySelector("main").children) {
    const title = part.tagName === "SECTION" ? part.querySelector("h2") : part.tagName === "H2" && part;
    if (title) keep = shown.some((head) => head && title.textContent.startsWith(head));
    if (!keep && part.tagName !== "STYLE") part.style.display = "none";
  }
  const slider = document.querySelector(".moving input[type=range]");
  if (slider && %s !== null) {
    slider.value = slider.max * %s;
    slider.dispatchEvent(new Event("input"));
  }
});
</script>"""


def rehearse(page: Path, program: Path, folder: Path, wanted: set[str]) -> None:
    """Files of a page, and its commands that write the wanted folders, or what other commands read."""
    text = page.read_text(encoding="utf-8")
    for language, title, body in BLOCK.findall(text):
        if language in ("json", "csv") and title:
            (folder / title).write_text(body, encoding="utf-8")
        for line in body.splitlines() if language == "sh" else []:
            out = re.search(r"--out (\S+)", line)
            needed = out and (out[1] in wanted or f"dam methods {out[1]}/" in text)
            if line.startswith("dam new") or needed:
                command = line.replace("dam", str(program), 1).partition("   #")[0]
                subprocess.run(command, shell=True, cwd=folder, check=True, capture_output=True)


def photograph(picture: Picture, report: Path, browser: str) -> None:
    """Both pictures of a report page."""
    at = "null" if picture.at is None else f"{picture.at:g}"
    text = report.read_text(encoding="utf-8") + PREPARE % (picture.sections, at, at)
    page = report.with_name("photographed.html")
    page.write_text(text, encoding="utf-8")
    for scheme, number in SCHEMES.items():
        file = SITE / f"pictures/tutorial-{picture.name}-{scheme}.png"
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]
        options += [f"--window-size={WIDTH},{picture.height}", "--virtual-time-budget=4000"]
        options += [f"--blink-settings=preferredColorScheme={number}", f"--screenshot={file}"]
        subprocess.run([browser, *options, page.as_uri()], check=True, capture_output=True)
        size = file.stat().st_size
        if size > LARGEST:
            raise SystemExit(f"{file.relative_to(ROOT)}: {size} bytes, {LARGEST} at most")
        print(f"{file.relative_to(ROOT)}: {size} bytes")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dam", type=Path, required=True, help="the program")
    parser.add_argument("--only", help="the name of one picture")
    options = parser.parse_args()
    program = options.dam.resolve(strict=True)
    browser = os.environ.get("BROWSER", "chromium")
    wanted = [picture for picture in PICTURES if options.only in (None, picture.name)]
    if not wanted:
        raise SystemExit(f"no such picture; there are {[picture.name for picture in PICTURES]}")
    with tempfile.TemporaryDirectory() as name:
        for page in dict.fromkeys(picture.page for picture in wanted):
            here = [picture for picture in wanted if picture.page == page]
            folder = Path(name) / Path(page).stem
            folder.mkdir()
            for shared in ("scenarios", "objects"):
                (folder / shared).symlink_to(ROOT / shared)
            for before in dict.fromkeys(picture.after for picture in here if picture.after):
                rehearse(SITE / before, program, folder, set())
            rehearse(SITE / page, program, folder, {picture.out for picture in here})
            for picture in here:
                photograph(picture, folder / picture.out / "report.html", browser)


if __name__ == "__main__":
    main()
