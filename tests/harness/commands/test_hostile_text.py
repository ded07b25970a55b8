"""Text from an FMU or a path passes for nothing else: not in a terminal, a CI log or Markdown."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from slider_resonator.output.json_output import to_json
from slider_resonator.output.readable import indented, one_line
from tests.harness import faulty_fmus
from tests.harness.calling import call

NASTY = "x\x1b[31m\n::error::y##[warning]`z`<b>[k](http:q)"
"""Of a file: what a terminal, the log of a workflow and Markdown could take for more than text."""
TEXT = r"\x1b[31mred\n::error::spoofed\n##[error]spoofed `code` [link](https://e.org) <b>"
"""The same as the C source of a log message."""
REFUSES = f'log_message(NULL, "harness1", 3, "logStatusError", "{TEXT}"); return 3;'


@pytest.fixture(scope="module")
def nasty_fmu(native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU whose path, output and log are hostile, and which refuses every step."""
    folder = tmp_path_factory.mktemp("nasty") / NASTY.replace("/", "")
    folder.mkdir()
    plain = folder.parent / "plain.fmu"
    faulty_fmus.compiled(native_fmu, plain, f"IN_STEP=PRINT {REFUSES}", "VALUE=1.0")
    return Path(shutil.copy(plain, folder / f"{NASTY.replace('/', '')}.fmu"))


def assert_harmless(text: str) -> None:
    assert not re.search(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]", text), "no control characters"
    assert not re.search(r"^\s*::", text, re.MULTILINE), "no commands to GitHub Actions"
    assert "##[" not in text
    assert not re.search(r"^(error|red|spoofed|y)", text.partition("\n")[2], re.MULTILINE), text


COMMANDS = {
    "validate": ["validate", "FMU", "--scene", "SCENE"],
    "run": ["run", "FMU", "SCENE"],
    "steady": ["steady", "FMU"],
    "blocking": ["blocking", "FMU"],
    "choose": ["choose", "NEED", "--fmu", "FMU"],
    "sweep": ["sweep", "GRID", "--fmu", "FMU", "--out", "OUT.csv"],
    "paper": ["paper", "--fmu", "FMU", "--out", "OUT", "--only", "figure_2"],
    "bench": ["bench", "FMU", "--repeats", "1"],
    "hosts": ["hosts", "FMU", "--python-fmu", "FMU", "--host", "fmpy"],
    "baseline": ["baseline", "record", "FMU", "--dir", "OUT", "--scene", "SCENE"],
    "no such FMU": ["run", "FMU.no", "SCENE"],
    "no such host FMU": ["hosts", "FMU.no"],
    "no such scene": ["validate", "FMU", "--scene", "FMU.no"],
    "no such grid": ["sweep", "FMU.no", "--out", "OUT.csv"],
}


QUICK = ("validate", "run", *(name for name in COMMANDS if name.startswith("no such")))
CASES = [
    pytest.param(name, as_json, marks=() if name in QUICK and not as_json else pytest.mark.slow)
    for name in COMMANDS
    for as_json in (False, True)
    if not as_json or name in ("validate", "steady", "sweep", "hosts", "no such FMU")
]


@pytest.mark.isolated
@pytest.mark.parametrize(("command", "as_json"), CASES)
def test_no_command_prints_hostile_text(
    nasty_fmu: Path,
    tmp_path: Path,
    command: str,
    as_json: bool,
) -> None:
    scene = faulty_fmus.scene(tmp_path)
    need, grid = tmp_path / "need.toml", tmp_path / "grid.toml"
    need.write_text(scene.read_text() + "[need]\nmean_velocity = { rel = 0.05 }\n")
    grid.write_text(
        'measures = ["velocity.rms"]\n[grid]\nphase = [0.0]\n[run]\ndrive_periods = 2\n'
    )
    places = {"FMU": nasty_fmu, "SCENE": scene, "NEED": need, "GRID": grid}
    out = tmp_path / NASTY.replace("/", "")
    words = []
    for word in COMMANDS[command]:
        name, point, suffix = word.partition(".")
        path = {**places, "OUT": out}.get(name)
        words.append(word if path is None else f"{path}{point}{suffix}")
    if as_json:
        words.append("--json")
    summary = tmp_path / "summary.md"
    result = call(*words, GITHUB_STEP_SUMMARY=str(summary))
    assert result.exit_code in (1, 2), result.output
    assert_harmless(result.stdout)
    assert_harmless(result.stderr)
    if command == "validate":
        page = summary.read_text(encoding="utf-8")
        assert "<b>" not in page
        assert "](" not in page.replace("]\\(", "")
        assert "://" not in page


def test_lines_of_a_message_are_marked_as_its_own() -> None:
    assert indented("error: a\nerror: b") == "error: a\n  error: b"
    assert one_line("a\nb\x1b") == "a b\ufffd"


def test_json_holds_no_command_of_a_workflow() -> None:
    assert "##[" not in to_json({"name": "##[error]x"})
    assert "\\u0023#[error]x" in to_json({"name": "##[error]x"})
