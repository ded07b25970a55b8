"""Links and paths of tests in the Markdown files."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted(
    page
    for pattern in ("*.md", "docs/**/*.md", "fmu_src/**/*.md", "harness/**/*.md")
    for page in ROOT.glob(pattern)
)
TO_BE_ADDED = {"tests/fmu_src/python/test_dahl.py"}
"""Paths of the exercise in docs/architecture.md."""


def relative_links(text: str) -> list[str]:
    """Return the targets of all links and images that are not URLs."""
    targets = re.findall(r"\]\(([^)\s]+)\)", text)
    return [target for target in targets if not re.match(r"[a-z]+:", target)]


def anchors(page: Path) -> set[str]:
    """Return the anchors that GitHub gives the headings of a page."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def paths_of_tests(text: str) -> set[str]:
    """Return the paths in `tests` that stand in backticks, alone or in a command."""
    code = " ".join(re.findall(r"`([^`\n]+)`", text))
    return set(re.findall(r"(?<!\S)tests/[\w./-]+(?!\S)", code))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_relative_links_exist(page: Path) -> None:
    for target in relative_links(page.read_text(encoding="utf-8")):
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        assert file.exists(), f"{page.name} links to {target}"
        assert not anchor or anchor in anchors(file), f"{page.name} links to {target}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_paths_of_tests_exist(page: Path) -> None:
    paths = paths_of_tests(page.read_text(encoding="utf-8")) - TO_BE_ADDED
    assert not {path for path in paths if not (ROOT / path).exists()}


def test_links_and_paths_are_recognised() -> None:
    text = "[a](b.md#c) ![d](e.png) [f](https://g) `pytest -m slow tests/h.py` `tests/i_<name>.py`"
    assert relative_links(text) == ["b.md#c", "e.png"]
    assert paths_of_tests(text) == {"tests/h.py"}
    assert {"README.md", "docs/architecture.md"} <= {str(page.relative_to(ROOT)) for page in PAGES}
