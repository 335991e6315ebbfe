"""The picture of a report page in the README, light and dark.

    python docs/report_picture.py --dam target/release/dam

runs the scene of the README and photographs its page in a headless Chromium (BROWSER names another), at an
instant at which the follower is off its cam.
"""

from __future__ import annotations

import argparse
import csv
import os
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PICTURES = ROOT / "docs/site/pictures"
SPEED = "1450 rpm"
WIDTH, HEIGHT = 1100, 1400
# Of Chromium's `preferredColorScheme`.
SCHEMES = {"dark": 0, "light": 1}

# The player of the page goes to a time; what follows it is drawn by itself.
GO = """<script>
addEventListener("load", () => {
  const slider = document.querySelector(".moving input[type=range]");
  slider.value = slider.max * %f;
  slider.dispatchEvent(new Event("input"));
});
</script>"""


def highest(record: Path) -> float:
    """The share of the run at which the follower is farthest off its cam."""
    with record.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    time = lambda row: float(row["time [s]"])
    best = max(rows, key=lambda row: float(row["follower.delta [m]"]))
    return time(best) / time(rows[-1])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dam", type=Path, required=True, help="the program")
    program = parser.parse_args().dam.resolve(strict=True)
    browser = os.environ.get("BROWSER", "chromium")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run = lambda *words: subprocess.run([program, *words], cwd=folder, check=True, capture_output=True)
        run("new", "cam", "cam.json")
        run("run", "cam.json", "--set", f"camshaft.motion.speed={SPEED}", "--out", "out")
        page = folder / "page.html"
        text = (folder / "out/report.html").read_text(encoding="utf-8")
        page.write_text(text + GO % highest(folder / "out/record.csv"), encoding="utf-8")
        for scheme, number in SCHEMES.items():
            picture = PICTURES / f"report-{scheme}.png"
            options = ["--headless", "--no-sandbox", "--hide-scrollbars", f"--window-size={WIDTH},{HEIGHT}"]
            options += [f"--blink-settings=preferredColorScheme={number}", "--virtual-time-budget=4000"]
            subprocess.run(
                [browser, *options, f"--screenshot={picture}", page.as_uri()], check=True, capture_output=True
            )
            print(f"{picture.relative_to(ROOT)}: {picture.stat().st_size} bytes")


if __name__ == "__main__":
    main()
