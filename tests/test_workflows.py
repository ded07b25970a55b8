"""The workflows call existing commands with existing options."""

import shlex
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click
import pytest
import yaml

from studies.cli import main
from tests.processes import ROOT

WORKFLOWS = (
    *sorted((ROOT / ".github" / "workflows").glob("*.yml")),
    ROOT / "examples" / "validate-fmu.yml",
)
HARNESS = (["python", "-m", "harness"], ["slider-resonator"])
"""How the harness is called; a user's folder may have a harness of its own, but not its command."""


def read(path: Path) -> dict[Any, Any]:
    content = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert isinstance(content, dict)
    return content


def steps(path: Path) -> Iterator[dict[str, Any]]:
    for job in read(path)["jobs"].values():
        yield from job["steps"]


def harness_calls() -> list[Any]:
    calls = []
    for path in WORKFLOWS:
        for step in steps(path):
            for line in str(step.get("run", "")).splitlines():
                words = shlex.split(line)
                for call in HARNESS:
                    if words[: len(call)] == call:
                        rest = words[len(call) :]
                        calls.append(pytest.param(rest, id=f"{path.stem}: {step['name']}"))
    return calls


def parse(words: list[str]) -> None:
    """Parse a command line as the harness does, without running the command."""
    group: click.Command = main
    context = click.Context(main)
    while isinstance(group, click.Group):
        command = group.get_command(context, words[0])
        assert command is not None, f"no command {words[0]}"
        group, words = command, words[1:]
    group.make_context(str(group.name), words, parent=context)


@pytest.mark.parametrize("words", harness_calls())
def test_the_harness_takes_each_call(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "reports").mkdir()
    monkeypatch.chdir(tmp_path)
    parse(words)
    with pytest.raises(click.UsageError):
        parse([*words, "--no-such-option"])


def test_workflows_judge_an_fmu_with_the_harness() -> None:
    names = {str(call.id).partition(":")[0] for call in harness_calls()}
    assert {"ci", "validate-fmu"} <= names


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.name)
def test_every_script_is_sound_shell(path: Path) -> None:
    for step in steps(path):
        if "run" in step:
            subprocess.run(["bash", "-n"], input=step["run"], text=True, check=True)
