"""Holds the built site together: every link, picture and anchor leads somewhere within it, and nothing
is loaded from a network.

    python docs/links.py target/site
"""

from __future__ import annotations

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# What a page loads by itself; other addresses outside are for people to follow.
LOADS = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "srcset")}


# The studio of one file, opened with a scenario behind the #.
STUDIO = "dam-studio.html"
SCENARIOS = Path(__file__).resolve().parent.parent / "scenarios"


class Page(HTMLParser):
    """Anchors and addresses of a page."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.addresses: list[tuple[str, bool]] = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if value is None:
                continue
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)
            if name in ("href", "src", "srcset"):
                self.addresses.append((value, (tag, name) in LOADS))


def faults(site: Path) -> list[str]:
    """What leads nowhere, or away."""
    # 404.html is shown at any address: its own are those of a server's root.
    pages = {path: Page(path) for path in site.rglob("*.html") if path.name not in ("404.html", STUDIO)}
    found = []
    for path, page in pages.items():
        for address, loads in page.addresses:
            parts = urlsplit(address)
            if parts.scheme in ("data", "mailto", "javascript"):
                continue
            if parts.scheme or parts.netloc:
                if loads:
                    found.append(f"{path}: loads {address}")
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            target = target / "index.html" if target.is_dir() else target
            if not target.is_file():
                found.append(f"{path}: {address} leads nowhere")
            elif target.name == STUDIO:
                if not (SCENARIOS / f"{parts.fragment.removeprefix('scenario=')}.json").is_file():
                    found.append(f"{path}: {address}: there is no such scenario")
            elif parts.fragment and target in pages:
                if unquote(parts.fragment) not in pages[target].anchors:
                    found.append(f"{path}: {address}: there is no such anchor")
    for style in site.rglob("*.css"):
        for address in re.findall(r"url\(([^)]+)\)", style.read_text(encoding="utf-8")):
            address = address.strip("\"'")
            if address.startswith(("data:", "#")):
                continue
            if "//" in address or not (style.parent / address.partition("?")[0]).is_file():
                found.append(f"{style}: {address}")
    return found


def main() -> None:
    site = Path(sys.argv[1]).resolve(strict=True)
    found = faults(site)
    if found:
        raise SystemExit("\n".join(found))
    pages = len(list(site.rglob("*.html")))
    if pages < 30:
        raise SystemExit(f"only {pages} pages in {site}")
    print(f"{pages} pages: all links and anchors lead somewhere, nothing is loaded from a network")


if __name__ == "__main__":
    main()
