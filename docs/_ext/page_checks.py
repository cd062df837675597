"""What the finished pages are held to: links, search, a way onward, formulas that browsers draw.

The build fails with one line for each fault.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from sphinx.application import Sphinx
from sphinx.errors import SphinxError
from sphinx.search.en import SearchEnglish

import earthspin
from earthspin.engine.question import keys_of
from earthspin.scenes import QUESTIONS

#: Pages that are made by Sphinx and lie on no way.
ASIDE = ("genindex.html", "py-modindex.html", "search.html", "404.html")


class Page(HTMLParser):
    """Links and anchors of one page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.anchors: set[str] = {""}
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.anchors |= {given[name] or "" for name in ("id", "name") if name in given}
        for name in ("href", "src"):
            if link := given.get(name):
                self.links.append(link)


@cache
def page_of(path: Path) -> Page:
    return Page(path.read_text(encoding="utf-8"))


def faults_of_links(folder: Path) -> Iterator[str]:
    """Links to a file or a place that is not there, or to the network for what a page needs."""
    for path in sorted(folder.rglob("*.html")):
        if "_static" in path.parts:
            continue
        for link in page_of(path).links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            there = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not there.exists():
                yield f"{path.relative_to(folder)}: there is no {link}"
            elif there.suffix == ".html" and unquote(parts.fragment) not in page_of(there).anchors:
                yield f"{path.relative_to(folder)}: no such place on its page: {link}"


def faults_of_pages(folder: Path) -> Iterator[str]:
    """Pages without a sidebar or a way to the next, fetched from afar, or with dead letters."""
    for path in sorted(folder.rglob("*.html")):
        name = path.relative_to(folder).as_posix()
        if name in ASIDE or name.startswith("_"):
            continue
        text = path.read_text(encoding="utf-8")
        if name.startswith("_modules"):
            continue
        if 'class="toctree-l1' not in text:
            yield f"{name}: no sidebar"
        if not re.search(r'class="(left-prev|right-next)"', text):
            yield f"{name}: neither a previous nor a next page"
        if far := re.findall(r'<(?:script|link|img)[^>]+(?:src|href)="https?://[^"]+"', text):
            yield f"{name}: needs the network, {far[0]}"
        if "&lt;Figure size" in text:
            yield f"{name}: a figure is shown as text; begin its cell with %matplotlib inline"
        if dead := re.findall(r'mathvariant="(?!normal)[^"]+"', text):
            yield f"{name}: a formula with {dead[0]}, which browsers do not draw"
        for words in re.findall(r"<dt><strong>([^<]*[ `][^<]*)</strong>", text):
            if not re.fullmatch(r"\**\w+(, \**\w+)*", words):
                yield f"{name}: prose is shown as the name of a parameter, {words!r}"
        if "<mi>&</mi>" in text:
            yield f"{name}: a formula with a bare &"


class Search:
    """The index of the pages, asked as the script on the page of search asks it."""

    def __init__(self, path: Path) -> None:
        text = path.read_text(encoding="utf-8")
        self.index = json.loads(text.removeprefix("Search.setIndex(").rstrip().removesuffix(")"))
        self.stem = SearchEnglish({}).stem

    def pages(self, query: str) -> set[str]:
        """Names of pages that hold every word of a query, or a thing of that name."""
        found = [self._with(word) for word in re.findall(r"\w+", query.lower())]
        return {self.index["docnames"][number] for number in set.intersection(*found)}

    def _with(self, word: str) -> set[int]:
        numbers: set[int] = set()
        for terms in (self.index["terms"], self.index["titleterms"]):
            for term in {word, self.stem(word)}:
                at = terms.get(term, [])
                numbers |= {at} if isinstance(at, int) else set(at)
        for things in self.index["objects"].values():
            for thing in things:
                if word == str(thing[4]).lower():
                    numbers.add(thing[0])
        return numbers


def wanted() -> Iterator[tuple[str, str]]:
    """What one must find, and how the name of a page that tells of it begins."""
    yield "tutorial", "tutorials/"
    yield "scene keys", "keys"
    yield "glossary", "glossary"
    for question in QUESTIONS.values():
        for key in keys_of(question):
            yield key, "keys"
    for name in earthspin.__all__:
        yield name.strip("_"), "reference/"


def faults_of_search(folder: Path) -> Iterator[str]:
    """Words that the search does not find where they belong."""
    search = Search(folder / "searchindex.js")
    for query, where in dict(wanted()).items():
        pages = search.pages(query)
        if not any(page.startswith(where) for page in pages):
            yield f"search: '{query}' finds {sorted(pages) or 'nothing'}, nothing of {where}"


def check(app: Sphinx, exception: Exception | None) -> None:
    """Hold the finished pages to all of it."""
    if exception is not None or app.builder.name != "html":
        return
    folder = Path(app.outdir)
    page_of.cache_clear()
    faults = [*faults_of_links(folder), *faults_of_pages(folder), *faults_of_search(folder)]
    if faults:
        raise SphinxError("\n".join([f"{len(faults)} faults of the finished pages:", *faults]))


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("build-finished", check, priority=999)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
