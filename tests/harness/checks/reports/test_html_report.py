from __future__ import annotations

import base64
from html.parser import HTMLParser
from pathlib import Path

from slider_resonator.checks.reports.html_report import write_html
from slider_resonator.checks.validate import Validation
from tests.harness.verdicts import BAD, BROKEN, GOOD, TIMES


class Tags(HTMLParser):
    """Collects the tags of a page and the attributes that load something."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.loaded: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.loaded += [value or "" for name, value in attrs if name in ("src", "href")]


def page(folder: Path, *validations: Validation) -> tuple[str, Tags]:
    path = folder / "report.html"
    write_html(path, validations)
    text = path.read_text(encoding="utf-8")
    tags = Tags()
    tags.feed(text)
    return text, tags


def test_deviations_are_drawn_and_the_page_loads_nothing(tmp_path: Path) -> None:
    text, tags = page(tmp_path, GOOD, BAD)
    (source,) = tags.loaded
    head, _, data = source.partition(",")
    assert head == "data:image/png;base64"
    assert base64.b64decode(data).startswith(b"\x89PNG")
    assert len(TIMES) > 128, "the picture has a whole run and a part of it"
    assert "from 0.0125 s on, most at 0.05 s" in text
    assert "off by 0.0067 m/s" in text
    assert "good.fmu" in text
    assert "bad.fmu" in text
    assert tags.tags.count("tr") == 2 + 4 + 5, "a head and all checks of both FMUs, provenance"


def test_output_of_an_fmu_is_escaped_in_markup(tmp_path: Path) -> None:
    text, tags = page(tmp_path, BROKEN)
    assert "b" not in tags.tags
    assert "could not be run" in text
    assert "lift_off at phase 0.4: the FMU crashed" in text
