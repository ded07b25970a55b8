"""Hostile FMUs: commands outlive them, leave nothing behind, and print none of their text raw.

One FMU does what the environment variable FAULT names, which also tells its processes from others.
"""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

import slider_resonator as sr
from slider_resonator.fmu.limits import DEFAULTS, MEMORY
from tests.harness import faulty_fmus
from tests.harness.calling import call, refused
from tests.processes import run_command

pytestmark = [
    pytest.mark.isolated,
    pytest.mark.skipif(sys.platform != "linux", reason="reads /proc; adopts orphans"),
]

FAULTS: Mapping[str, tuple[int, str]] = {
    "fork": (1, ""),
    "fork_session": (1, ""),
    "fork_twice": (1, ""),
    "fork_many": (2, "processes; must be at most 250"),
    "fork_and_exit": (2, "its process ended with exit code 0"),
    "exit": (2, "its process ended with exit code 0"),
    "crash": (2, "crashed in fmi2DoStep: its process ended with SIGABRT"),
    "sleep": (2, "no answer within the time limit of"),
    "stop": (2, "no answer within the time limit of"),
    "spam": (2, "no answer within the time limit of"),
    "spam_log": (2, "no answer within the time limit of"),
    "eat": (2, "MiB in memory; must be at most 400 MiB"),
    "kill_group": (2, "its process ended with SIGKILL"),
    "kill_parent": (2, "its process ended with SIGKILL"),
}
"""What the FMU does in fmi2DoStep, with the exit code of `validate` and the reason."""
OFTEN = ("crash", "fork_and_exit", "fork_twice")
"""Run on each push."""
ENDED_SOON = ("fork_many", "eat")
"""Ended once they have too much, which takes some seconds on a busy machine."""


@pytest.fixture(scope="module")
def hostile_fmu(native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("hostile")
    return faulty_fmus.compiled(native_fmu, folder / "hostile.fmu", "IN_STEP=FAULT", "VALUE=1.0")


def processes_of(mark: str) -> list[str]:
    """The processes that have inherited FAULT with this value; this one was started without."""
    found = []
    for environment in Path("/proc").glob("[0-9]*/environ"):
        try:
            if f"FAULT={mark}".encode() in environment.read_bytes().split(b"\0"):
                found.append(environment.parent.name)
        except OSError:
            continue
    return found


@pytest.fixture
def outlive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., tuple[int, str]]:
    """Run a command with a fault; return exit code and errors if it has left nothing behind.

    It runs in this process, where loading takes no time, unless `apart`.
    """

    def run(fault: str, *arguments: object, apart: bool = False) -> tuple[int, str]:
        mark = f"{fault}:{tmp_path}"
        temporary, here = tmp_path / "temporary", tmp_path / "here"
        temporary.mkdir()
        here.mkdir()
        monkeypatch.setenv("FAULT", mark)
        monkeypatch.setenv("TMPDIR", str(temporary))
        monkeypatch.setenv(MEMORY, str(DEFAULTS[MEMORY]))  # an option sets it for good
        monkeypatch.setattr(tempfile, "tempdir", None)
        monkeypatch.chdir(here)
        if apart:
            done = run_command(sys.executable, "-m", "slider_resonator", *arguments, timeout=120.0)
            code, errors = done.returncode, done.stderr
        else:
            result = call(*arguments)
            code, errors = result.exit_code, result.stderr
        assert not processes_of(mark), "no process is left"
        assert not list(temporary.iterdir()), "no folder is left"
        assert not list(here.iterdir()), "the FMU does not run in the user's folder"
        return code, errors

    return run


@pytest.mark.parametrize(
    "fault",
    [pytest.param(name, marks=() if name in OFTEN else pytest.mark.slow) for name in FAULTS],
)
def test_validate_outlives_an_fmu(
    hostile_fmu: Path, tmp_path: Path, outlive: Callable[..., tuple[int, str]], fault: str
) -> None:
    names = ("a", "b")
    scenes = [argument for n in names for argument in ("--scene", faulty_fmus.scene(tmp_path, n))]
    reports = [tmp_path / f"report.{kind}" for kind in ("json", "xml", "html")]
    options = [word for r in reports for word in (f"--{r.suffix[1:]}".replace("xml", "junit"), r)]
    limit = 30 if fault in ENDED_SOON else 2
    validate = ("--max-memory", 400, "validate", hostile_fmu, "--time-limit", limit)
    found, errors = outlive(fault, *validate, *scenes, *options)
    code, reason = FAULTS[fault]
    assert found == code, errors
    in_json = json.loads(reports[0].read_text())["errors"]
    in_junit = [error.get("message") for error in ET.parse(reports[1]).getroot().iter("error")]
    assert bool(in_json) == bool(in_junit) == (code == 2)
    for said in (errors, json.dumps(in_json), str(in_junit)):
        assert reason in said
    assert reports[2].read_text().rstrip().endswith("</html>")
    for report in reports:
        assert "\x1b" not in report.read_text()


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


COMMANDS: Mapping[str, Sequence[str]] = {
    "validate": ["validate", "FMU", "--scene", "SCENE"],
    "run": ["run", "FMU", "SCENE"],
    "steady": ["steady", "FMU"],
    "blocking": ["blocking", "FMU"],
    "run --auto": ["run", "FMU", "NEED", "--auto"],
    "choose": ["choose", "NEED", "--fmu", "FMU"],
    "sweep": ["sweep", "GRID", "--fmu", "FMU", "--out", "OUT.csv"],
    "trade": ["trade", "NEED", "--fmu", "FMU", "--out", "OUT", "--periods", "4"],
    "paper": ["paper", "--fmu", "FMU", "--out", "OUT", "--only", "figure_2"],
    "bench": ["bench", "FMU", "--repeats", "1"],
    "hosts": ["hosts", "FMU", "--python-fmu", "FMU", "--host", "fmpy"],
    "baseline": ["baseline", "record", "FMU", "--dir", "OUT", "--scene", "SCENE"],
    "no such FMU": ["run", "FMU.no", "SCENE"],
    "no such host FMU": ["hosts", "FMU.no"],
    "no such scene": ["validate", "FMU", "--scene", "FMU.no"],
    "no such grid": ["sweep", "FMU.no", "--out", "OUT.csv"],
}
"""What is given to commands; FMU, SCENE and so on stand for files."""


def arguments(command: str, fmu: Path, folder: Path) -> list[str]:
    """Return the words of a command, with files in a folder."""
    scene = faulty_fmus.scene(folder)
    need, grid = folder / "need.toml", folder / "grid.toml"
    need.write_text(scene.read_text() + "[need]\nmean_velocity = { rel = 0.05 }\n")
    grid.write_text(
        'measures = ["velocity.rms"]\n[grid]\nphase = [0.0]\n[run]\ndrive_periods = 2\n'
    )
    out = folder / NASTY.replace("/", "")
    places = {"FMU": fmu, "SCENE": scene, "NEED": need, "GRID": grid, "OUT": out}
    words = (word.partition(".") for word in COMMANDS[command])
    return [f"{places.get(name, name)}{point}{suffix}" for name, point, suffix in words]


QUICK = ("validate", *(name for name in COMMANDS if name.startswith("no such")))
AS_JSON = ("validate", "steady", "sweep", "hosts", "no such FMU")


@pytest.mark.parametrize(
    ("command", "as_json"),
    [
        *(pytest.param(n, False, marks=() if n in QUICK else pytest.mark.slow) for n in COMMANDS),
        *(pytest.param(name, True, marks=pytest.mark.slow) for name in AS_JSON),
    ],
)
def test_text_is_escaped(nasty_fmu: Path, tmp_path: Path, command: str, as_json: bool) -> None:
    summary = tmp_path / "summary.md"
    words = [*arguments(command, nasty_fmu, tmp_path), *(["--json"] if as_json else [])]
    result = call(*words, GITHUB_STEP_SUMMARY=str(summary))
    assert result.exit_code in (1, 2), result.output
    assert_harmless(result.stdout)
    assert_harmless(result.stderr)
    if command == "validate":
        page = summary.read_text(encoding="utf-8")
        assert "<b>" not in page
        assert "](" not in page.replace("]\\(", "")
        assert "://" not in page


@pytest.mark.slow
@pytest.mark.parametrize("command", [name for name in COMMANDS if "no such" not in name])
def test_every_command_outlives_an_fmu(
    hostile_fmu: Path, tmp_path: Path, outlive: Callable[..., tuple[int, str]], command: str
) -> None:
    apart = command == "bench"  # which keeps what it has compiled to the end of its process
    words = [*arguments(command, hostile_fmu, tmp_path), "--time-limit", "5"]
    code, errors = outlive("fork_and_exit", *words, apart=apart)
    # A point of a sweep that fails is a row with its error.
    assert code == (1 if command == "sweep" else 2), errors
    assert "Traceback" not in errors
    assert errors or command == "sweep"


def test_a_hang_is_ended(hostile_fmu: Path, outlive: Callable[..., tuple[int, str]]) -> None:
    code, errors = outlive("sleep", "steady", hostile_fmu, "--time-limit", "1")
    assert code == 2
    assert "no answer within the time limit of 1 s in fmi2DoStep" in errors


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_ended_command(native_fmu: Path, tmp_path: Path, number: signal.Signals) -> None:
    loop = 'fopen("looping", "w"); LOOP'
    fmu = faulty_fmus.compiled(native_fmu, tmp_path / "loop.fmu", f"IN_STEP={loop}")
    mark, temporary = f"none:{tmp_path}", tmp_path / "temporary"
    temporary.mkdir()
    with subprocess.Popen(
        [sys.executable, "-m", "slider_resonator", "run", str(fmu), "table_1"],
        env={**os.environ, "TMPDIR": str(temporary), "FAULT": mark},
        stderr=subprocess.PIPE,
        text=True,
    ) as command:
        wait_until(lambda: any(temporary.glob("*/work/looping")))
        command.send_signal(number)
        _, message = command.communicate(timeout=60.0)
    if number != signal.SIGKILL:
        assert (command.returncode, message.strip()) == (130, "interrupted")
    wait_until(lambda: not any(temporary.iterdir()) and not processes_of(mark))


def wait_until(condition: Callable[[], bool]) -> None:
    for _ in range(600):
        if condition():
            return
        time.sleep(0.05)
    raise AssertionError("it takes too long")


def test_an_fmu_that_crashes_as_it_is_opened_is_named(native_fmu: Path, tmp_path: Path) -> None:
    cut = faulty_fmus.altered(
        *(native_fmu, tmp_path / "cut.fmu"),
        lambda name, content: content[: len(content) // 2] if "/linux64/" in name else content,
    )
    said = "cut.fmu crashed in fmi2Instantiate: its process ended with SIG"
    assert refused("steady", cut).startswith(f"error: {said}")
    with pytest.raises(sr.HarnessError, match=f"^{said}"):
        sr.open_fmu(cut)


def test_a_crash_after_the_run_ends_with_2(native_fmu: Path, tmp_path: Path) -> None:
    fmu = faulty_fmus.compiled(native_fmu, tmp_path / "faulty.fmu", "IN_FREE=CRASH")
    assert "crashed in fmi2Terminate or fmi2FreeInstance" in refused("run", fmu, "table_1")
