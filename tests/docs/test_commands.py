"""Every command that the Markdown files name exists, with its options."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import click
import pytest
from _pytest.mark.structures import ParameterSet

import build_fmu
from studies.cli import main
from tests.processes import ROOT

PAGES = sorted(
    page
    for pattern in ("*.md", "docs/**/*.md", "fmu_src/**/*.md", "harness/**/*.md")
    for page in ROOT.glob(pattern)
    if page.name != "CHANGELOG.md"  # which names what there was
)
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
        for line in commands(page.read_text(encoding="utf-8")):
            for program in programs:
                rest = line.strip().removeprefix(program)
                following = (" ", "", ".") if program.startswith("python -m ") else (" ", "")
                is_call = rest != line.strip() and rest[:1] in following
                if is_call and not re.search(r"\[|\.\.\.|COMMAND|<", rest):
                    words = shlex.split(rest, comments=True)
                    found.append(pytest.param(words, id=f"{page.name}: {' '.join(words)}"))
    return found


def unknown_options(words: list[str]) -> list[str]:
    """Return the options of a command line of the harness that its command does not have."""
    command: click.Command = main
    context = click.Context(main)
    seen: list[str] = []
    while isinstance(command, click.Group):
        own = {option for p in command.params for option in p.opts} | {"--help"}
        while words and words[0].startswith("--"):
            seen += [words[0]] if words[0] not in own else []
            words = words[1 if words[0] in ("--version", "--help") else 2 :]
        if not words:
            return seen
        inner = command.get_command(context, words[0])
        assert inner is not None, f"no command {words[0]}"
        command, words = inner, words[1:]
    own = {option for p in command.params for option in p.opts} | {"-h", "--help"}
    options = [word.partition("=")[0] for word in words if re.match(r"--?[a-z]", word)]
    return seen + [option for option in options if option not in own]


@pytest.mark.parametrize("words", calls(*HARNESS))
def test_commands_of_the_harness_exist(words: list[str]) -> None:
    assert unknown_options(words) == []


def test_a_command_that_does_not_exist_is_found() -> None:
    assert unknown_options(["steady", "my.fmu", "--sets", "phase=1"]) == ["--sets"]
    with pytest.raises(AssertionError, match="no command steddy"):
        unknown_options(["steddy"])


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
    text = Path(build_fmu.__file__).read_text(encoding="utf-8")
    assert not [word for word in words if word.startswith("--") and f'"{word}"' not in text]
