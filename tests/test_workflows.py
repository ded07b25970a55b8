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


def steps(path: Path) -> Iterator[dict[str, Any]]:
    """The steps of all jobs that run something."""
    for job in yaml.safe_load(path.read_text(encoding="utf-8"))["jobs"].values():
        yield from (step for step in job["steps"] if "run" in step)


CALLS = [
    pytest.param(words[len(call) :], id=f"{path.stem}: {step['name']}")
    for path in WORKFLOWS
    for step in steps(path)
    for words in map(shlex.split, step["run"].splitlines())
    for call in HARNESS
    if words[: len(call)] == call
]


@pytest.mark.parametrize("words", CALLS)
def test_the_harness_takes_each_call(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Command lines are parsed as the harness does, without running the command."""
    (tmp_path / "reports").mkdir()
    monkeypatch.chdir(tmp_path)
    group: click.Command = main
    context = click.Context(main)
    while isinstance(group, click.Group):
        command = group.get_command(context, words[0])
        assert command is not None, f"no command {words[0]}"
        group, words = command, words[1:]
    group.make_context(str(group.name), words, parent=context)


def test_workflows_judge_an_fmu_with_the_harness() -> None:
    names = {str(call.id).partition(":")[0] for call in CALLS}
    assert {"ci", "validate-fmu"} <= names


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.name)
def test_every_script_is_sound_shell(path: Path) -> None:
    for step in steps(path):
        subprocess.run(["bash", "-n"], input=step["run"], text=True, check=True)
