"""Every command that the Markdown files name exists, with its options."""

import re
import shlex
from collections.abc import Iterator
from itertools import product
from pathlib import Path

import click
import pytest
from _pytest.mark.structures import ParameterSet

from studies.cli import main
from tests.processes import ROOT

ALL_PAGES = sorted(
    page
    for pattern in ("*.md", "docs/**/*.md", "fmu_src/**/*.md", "harness/**/*.md")
    for page in ROOT.glob(pattern)
)
PAGES = [page for page in ALL_PAGES if page.name != "CHANGELOG.md"]  # which names what there was
HARNESS = ("slider-resonator", "python -m harness", "python -m slider_resonator")


def commands(text: str) -> Iterator[str]:
    """Yield the lines of shell blocks, continued ones joined, and the code within lines."""
    blocks = re.findall(r"^```(?:sh|bash|console)\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    for block in blocks:
        yield from block.replace("\\\n", " ").splitlines()
    prose = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    yield from re.findall(r"`([^`\n]+)`", prose)


def calls(*programs: str) -> list[ParameterSet]:
    """Return the arguments after one of the programs, without placeholders, by page."""
    found = []
    for page in PAGES:
        for line, program in product(commands(page.read_text(encoding="utf-8")), programs):
            rest = line.strip().removeprefix(program)
            following = (" ", "", ".") if program.startswith("python -m ") else (" ", "")
            is_call = rest != line.strip() and rest[:1] in following
            if is_call and not re.search(r"\[|\.\.\.|COMMAND|<", rest):
                words = shlex.split(rest, comments=True)
                found.append(pytest.param(words, id=f"{page.name}: {' '.join(words)}"))
    return found


@pytest.mark.parametrize("words", calls(*HARNESS))
def test_commands_of_the_harness_exist(words: list[str]) -> None:
    """With their options; values are not looked at."""
    command: click.Command = main
    context = click.Context(main)
    while isinstance(command, click.Group):
        _, words, _ = command.make_parser(context).parse_args(words)
        if not words:
            return
        inner = command.get_command(context, words[0])
        assert inner is not None, f"no command {words[0]}"
        command, words, context = inner, words[1:], click.Context(inner, parent=context)
    command.make_parser(context).parse_args(words)


@pytest.mark.parametrize("words", calls("make"))
def test_targets_of_make_exist(words: list[str]) -> None:
    targets = set(re.findall(r"^([\w./-]+):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE))
    named = [word for word in words if "=" not in word and not word.startswith("-")]
    assert set(named) <= targets


@pytest.mark.parametrize("words", calls("python -m tests", "python -m fmu_src"))
def test_modules_that_are_run_exist(words: list[str]) -> None:
    module = words[0].removeprefix(".").replace(".", "/") + ".py"
    assert any((ROOT / folder / module).is_file() for folder in ("tests", "fmu_src"))


@pytest.mark.parametrize("words", calls("python build_fmu.py"))
def test_options_of_the_build_exist(words: list[str]) -> None:
    text = (ROOT / "build_fmu.py").read_text(encoding="utf-8")
    assert not [word for word in words if word.startswith("--") and f'"{word}"' not in text]


TO_BE_ADDED = {"tests/fmu_src/python/test_dahl.py"}
"""Paths of the exercise in docs/architecture.md."""


def anchors(page: Path) -> set[str]:
    """Return the anchors that GitHub gives the headings of a page."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", ALL_PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links_and_paths_of_tests_exist(page: Path) -> None:
    """Links and images that are no URLs; paths that stand in backticks, alone or in a command."""
    text = page.read_text(encoding="utf-8")
    for target in re.findall(r"\]\((?![a-z]+:)([^)\s]+)\)", text):
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        assert file.exists(), f"{page.name} links to {target}"
        assert not anchor or anchor in anchors(file), f"{page.name} links to {target}"
    code = " ".join(re.findall(r"`([^`\n]+)`", text))
    paths = set(re.findall(r"(?<!\S)tests/[\w./-]+(?!\S)", code)) - TO_BE_ADDED
    assert not {path for path in paths if not (ROOT / path).exists()}
