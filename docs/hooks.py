"""What MkDocs calls when it builds the site: mathematics becomes MathML, which browsers draw by
themselves, with a font that the site brings along. Tables that programs write into docs/ are pages of the site
too."""

import html
import re
from importlib.metadata import distribution
from pathlib import Path
from posixpath import relpath

from latex2mathml.converter import convert
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

DOCS = Path(__file__).resolve().parent

# Written by benches and measurements; pages lead to them as they do in the repository.
MEASURED = ["scoreboard.md", "model-order.md", "studio-latency.md", "studio-latency.svg", "studio-latency-press.svg"]
TO_MEASURED = re.compile(r"\]\((?:\.\./)+([\w-]+\.md)\)")

FONT = "STIXTwoMath-Regular.ttf"

# Primes have glyphs of their own above the line, which the style asks for.
PRIME = re.compile(r"<mi>(&#x0203[234];)</mi>")
# A function and its argument without brackets stand apart.
APART = re.compile(r"(<mi>(?:sin|cos|tan|ln)</mi>)(?!<mo|</)")

FORMULA = re.compile(r'<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</\1>', re.DOTALL)


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """The font of formulas, out of the package that carries it, and what was measured."""
    font = Path(str(distribution("ziamath").locate_file(f"ziamath/fonts/{FONT}")))
    files.append(File.generated(config, f"fonts/{FONT}", content=font.read_bytes()))
    for name in MEASURED:
        files.append(File.generated(config, f"measured/{name}", content=(DOCS / name).read_bytes()))
    return files


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """Links out of docs/site to what was measured."""
    folder = page.file.src_uri.rpartition("/")[0]

    def led(found: re.Match[str]) -> str:
        known = found[1] in MEASURED
        return f"]({relpath(f'measured/{found[1]}', folder or '.')})" if known else found[0]

    return TO_MEASURED.sub(led, markdown)


# What a browser needs to search in pages that were opened from disk; the site brings it along.
WORKER = "https://unpkg.com/iframe-worker/shim"


def on_post_page(output: str, page: Page, **_: object) -> str:
    """No page loads anything from a network."""
    folder = page.file.src_uri.rpartition("/")[0]
    return output.replace(WORKER, relpath("scripts/iframe-worker.js", folder or "."))


# What the converter does not know, or takes for something else.
SAME = {"aligned}": "align*}", r"\lvert": r"\left|", r"\rvert": r"\right|"}


def _mathml(found: re.Match[str]) -> str:
    inline = found[2] == "("
    source = html.unescape(found[3]).strip()
    for written, known in SAME.items():
        source = source.replace(written, known)
    mathml = convert(source, display="inline" if inline else "block")
    mathml = mathml.replace("<mo>&#x0221E;</mo>", "<mi>&#x0221E;</mi>")
    mathml = PRIME.sub(r'<mi class="prime">\1</mi>', mathml)
    mathml = APART.sub(r'\1<mspace width="0.17em" />', mathml)
    if "\\" in mathml or "<mi>&</mi>" in mathml:
        raise ValueError(f"not all of this formula is understood: {source}")
    return mathml if inline else f'<div class="formula">{mathml}</div>'


def on_page_content(html: str, **_: object) -> str:
    """Formulas of a page."""
    return FORMULA.sub(_mathml, html)
