"""The workflows call existing commands with existing options."""

from __future__ import annotations

import re
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

CI = ROOT / ".github" / "workflows" / "ci.yml"
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
def test_a_workflow_is_whole(path: Path) -> None:
    workflow = read(path)
    assert workflow["permissions"] == {"contents": "read"}
    assert True in workflow, "YAML 1.1 reads the key `on` as true"
    for name, job in workflow["jobs"].items():
        assert job["timeout-minutes"] <= 60, name
        needed = job.get("needs", [])
        assert set([needed] if isinstance(needed, str) else needed) <= set(workflow["jobs"])
    for step in steps(path):
        assert ("run" in step) != ("uses" in step), step
        if "uses" in step:
            assert step["uses"].startswith("actions/"), step
        if step.get("uses", "").startswith("actions/checkout@"):
            assert step["with"]["persist-credentials"] is False, "a later step could use them"
    more = {name for name, job in workflow["jobs"].items() if "permissions" in job}
    assert more == ({"publish"} if path.stem == "release" else set()), "no other needs more"


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.name)
def test_actions_are_pinned_by_commit_and_say_their_version(path: Path) -> None:
    uses = re.findall(r"uses:\s*(.*)", path.read_text(encoding="utf-8"))
    assert uses
    for action in uses:
        assert re.fullmatch(r"actions/[a-z-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+", action), action
    commits = {tuple(action.split(" # ")) for action in uses}
    assert len(commits) == len({action.split("@")[0] for action in uses}), "one version of each"


def test_both_builds_are_compared_and_what_is_kept_has_checksums() -> None:
    jobs = read(CI)["jobs"]
    runs = {
        name: "\n".join(str(s.get("run", "")) for s in job["steps"]) for name, job in jobs.items()
    }
    assert "sha256sum *.fmu *.ssp *.html > SHA256SUMS" in runs["verdict"]
    assert jobs["reproducible"]["needs"] == "verdict"
    assert "python -m fmu_src.compare" in runs["reproducible"]
    assert jobs["reproducible"]["runs-on"] != jobs["verdict"]["runs-on"]
    assert "cyclonedx-py requirements" in runs["sbom"]


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.name)
def test_every_script_is_sound_shell(path: Path) -> None:
    for step in steps(path):
        if "run" in step:
            subprocess.run(["bash", "-n"], input=step["run"], text=True, check=True)


def test_what_the_project_runs_is_there() -> None:
    scripts = [word for step in steps(CI) for word in str(step.get("run", "")).split()]
    assert ".ci/run" in scripts
    assert (ROOT / ".ci" / "run").stat().st_mode & 0o100, "it must be executable"


def test_the_tools_that_the_verdict_needs_are_installed_from_its_own_list() -> None:
    """`.ci/run` may not install as the user of a runner, and ends where a tool is missing."""
    script = ".ci/install-tools.sh"
    assert script in (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    runs = [str(step.get("run", "")) for step in read(CI)["jobs"]["verdict"]["steps"]]
    assert f"sudo {script}" in runs[: runs.index(".ci/run")]
    assert not any("apt-get" in run for run in runs), "one list of packages"
