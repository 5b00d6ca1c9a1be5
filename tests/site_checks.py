"""Checks of a built site: no requests to other hosts, and no broken links."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

#: Elements that a browser loads without a click.
_FETCHED = {"img": "src", "script": "src", "iframe": "src", "source": "src", "video": "src", "audio": "src"}
_OF_CSS = re.compile(r"(?:url\(|@import)\s*['\"]?((?:https?:)?//[^)'\"\s]+)")


class SiteError(Exception):
    """A site with requests to other hosts or broken links."""


@dataclass
class Page(HTMLParser):
    """What a page loads, its links, and its anchors."""

    fetched: list[str] = field(default_factory=list)
    links: list[str] = field(default_factory=list)
    anchors: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        super().__init__()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Record what an element loads, links to or names."""
        named = {name: value for name, value in attrs if value}
        if tag in _FETCHED and (source := named.get(_FETCHED[tag])):
            self.fetched.append(source)
        if tag == "link" and named.get("rel") != "canonical" and (source := named.get("href")):
            self.fetched.append(source)
        if tag == "a" and (target := named.get("href")):
            self.links.append(target)
        self.anchors |= {named[name] for name in ("id", "name") if name in named}


def read_page(path: Path) -> Page:
    """Read a page."""
    page = Page()
    page.feed(path.read_text("utf-8"))
    return page


def check_site(folder: Path) -> None:
    """Check all pages and style sheets of a site.

    Raises
    ------
    SiteError
        With one line for each fault.
    """
    pages = {path: read_page(path) for path in sorted(folder.rglob("*.html"))}
    if not pages:
        raise SiteError(f"{folder}: found no page; expected a site")
    faults = [f"{path.relative_to(folder)}: {fault}" for path in pages for fault in _faults(path, pages)]
    for sheet in sorted(folder.rglob("*.css")):
        asked = _OF_CSS.findall(sheet.read_text("utf-8"))
        faults += [f"{sheet.relative_to(folder)}: requests {address}" for address in asked]
    if faults:
        raise SiteError("\n".join(["the site:", *faults]))


def _faults(path: Path, pages: dict[Path, Page]) -> Iterator[str]:
    page = pages[path]
    for address in page.fetched:
        if urlsplit(address).netloc:
            yield f"requests {address}"
        elif not urlsplit(address).scheme and not _leads_to(path, address).exists():
            yield f"fetches {address}, which does not exist"
    for link in page.links:
        parts = urlsplit(link)
        if parts.scheme or parts.netloc:
            continue
        target = _leads_to(path, link)
        if not target.exists():
            yield f"links to {link}, which does not exist"
        elif target in pages and parts.fragment and unquote(parts.fragment) not in pages[target].anchors:
            yield f"links to {link}, which has no such heading"


def _leads_to(path: Path, link: str) -> Path:
    """The file that a link points to."""
    inside = unquote(urlsplit(link).path)
    target = (path.parent / inside).resolve() if inside else path
    return target / "index.html" if target.is_dir() else target
