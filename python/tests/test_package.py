"""What the package index shows of the distribution."""

from __future__ import annotations

import re
import subprocess
import sys
from importlib import metadata
from pathlib import Path

DISTRIBUTION = "dam-mechanisms"


def _page() -> str:
    page = metadata.metadata(DISTRIBUTION)["Description"]
    assert page is not None
    return page


def test_both_licences_are_in_the_wheel() -> None:
    known = metadata.metadata(DISTRIBUTION)
    assert known["License-Expression"] == "MIT OR Apache-2.0"
    assert sorted(known.get_all("License-File") or []) == ["LICENSE-APACHE", "LICENSE-MIT"]
    files = metadata.files(DISTRIBUTION)
    assert files is not None
    root = Path(__file__).parents[2]
    for licence in ("LICENSE-APACHE", "LICENSE-MIT"):
        (file,) = (one for one in files if one.name == licence)
        text = Path(str(file.locate())).read_text(encoding="utf-8")
        assert text == (root / licence).read_text(encoding="utf-8")


def test_the_page_links_to_nothing_that_is_not_there() -> None:
    # Links within the repository lead nowhere on an index.
    for target in re.findall(r"\]\(([^)]+)\)", _page()):
        assert target.startswith("https://"), target


def test_what_the_page_shows_is_printed(tmp_path: Path) -> None:
    (code,) = re.findall(r"```python\n(.*?)```", _page(), re.DOTALL)
    (shown,) = re.findall(r"```text\n(.*?)```", _page(), re.DOTALL)
    ran = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=tmp_path
    )
    assert ran.stdout == shown


def test_the_page_names_what_there_is() -> None:
    import dam

    for owner, name in re.findall(r"`(scene|dam)\.(\w+)\(", _page()):
        assert hasattr(dam.Scene if owner == "scene" else dam, name), name


def test_it_says_where_it_was_run() -> None:
    known = metadata.metadata(DISTRIBUTION)
    classifiers = known.get_all("Classifier") or []
    assert "Typing :: Typed" in classifiers
    wheel = metadata.distribution(DISTRIBUTION).read_text("WHEEL")
    assert wheel is not None and re.search(r"^Tag: cp310-abi3-(many)?linux", wheel, re.MULTILINE)
