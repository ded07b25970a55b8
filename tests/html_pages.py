"""Pages of HTML as tests look at them."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

VOID = {"meta", "link", "img", "br"}
"""Elements without an end tag, of those that our pages have."""
DATA = re.compile(r'<script type="application/json">(.*?)</script>', re.DOTALL)


class Page(HTMLParser):
    """The start tags of a page, in their order, the attributes that load something, the plots.

    An end tag that does not close the innermost element, an element left open and an id that is
    given twice fail the test.
    """

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.loaded: list[str] = []
        self.ids: list[str] = []
        self.plots: list[dict[str, Any]] = [json.loads(data) for data in DATA.findall(text)]
        self._opened: list[str] = []
        assert text.startswith("<!DOCTYPE html>")
        self.feed(text)
        self.close()
        assert self._opened == []
        assert len(self.ids) == len(set(self.ids)), "an id is unique"

    @classmethod
    def read(cls, path: Path) -> Page:
        return cls(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.loaded += [value or "" for name, value in attrs if name in ("src", "href")]
        self.ids += [value or "" for name, value in attrs if name == "id"]
        assert not [name for name, _ in attrs if name.startswith("on")], f"{tag} has a handler"
        if tag not in VOID:
            self._opened.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self._opened.pop() == tag, f"line {self.getpos()[0]}: </{tag}>"
