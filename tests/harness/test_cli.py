"""The command line as users and CI jobs use it: output, JSON, exit codes, refusals."""

import json
import re
import shlex
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from slider_resonator import cli
from slider_resonator.commands import options
from slider_resonator.errors import unknown_name
from tests.harness.calling import call, refused
from tests.harness.golden import SCREENS, assert_as_before, without_long_lists
from tests.harness.public_json import assert_public_keys


@pytest.mark.parametrize(
    ("arguments", "shown"),
    [
        ([], "Commands:\n  baseline  "),
        (["baseline"], "Commands:\n  accept  "),
        (["baseline", "record"], "Missing option '--dir'"),
    ],
)
def test_without_what_it_needs_a_command_shows_its_help(arguments: list[str], shown: str) -> None:
    assert shown in refused(*arguments)


def test_an_error_is_json_too_where_json_was_asked_for() -> None:
    result = call("steady", "no.fmu", "--json")
    assert result.exit_code == 2
    assert "no such file" in json.loads(result.stdout)["error"]
    assert_public_keys("error", result.stdout)


def in_a_shell(line: str, fmu: Path) -> subprocess.CompletedProcess[str]:
    """Run `harness ...` in bash with its exit code, whatever it is piped into, as the last line."""
    script = (
        f'harness() {{ {sys.executable} -m harness "$@"; echo "code $?" >&2; }}; fmu={fmu}; {line}'
    )
    return subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=False)


FULL = "error: standard output: No space left on device\ncode 2\n"
ONE = "validate $fmu --scene blocking_force_table_1"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("line", "errors"),
    [
        (f"harness {ONE} --json >/dev/full", FULL),
        (f"harness {ONE} >/dev/full", FULL),
        ("harness steady $fmu >/dev/full", FULL),
        ("harness --help >/dev/full", FULL),
        # A reader that stops early is no error and no verdict.
        (f"harness {ONE} | true", "code 2\n"),
        (f"harness {ONE} --json | true", "code 2\n"),
        ("harness steady $fmu | true", "code 2\n"),
        ("harness --help | true", "code 2\n"),
        ("harness steady no.fmu --json 2>&1 >/dev/full | true; echo 'code 2' >&2", "code 2\n"),
        # A closed output does not hide the verdict.
        ("harness steady $fmu >&-", "code 0\n"),
        ("harness steady $fmu --set load=0.25 >&-", "code 1\n"),
    ],
)
def test_output_that_cannot_be_written(native_fmu: Path, line: str, errors: str) -> None:
    assert in_a_shell(line, native_fmu).stderr == errors


def test_an_error_that_cannot_be_printed_exits_with_2(native_fmu: Path) -> None:
    shell = in_a_shell(
        f"{sys.executable} -m harness steady no.fmu 2>/dev/full; echo $?", native_fmu
    )
    assert shell.stdout == "2\n"


@pytest.mark.parametrize(
    ("error", "code", "reported"),
    [
        (KeyError("oops"), 2, "KeyError"),
        (EOFError("a pipe has closed \x1b[2J"), 2, "EOFError: a pipe has closed \ufffd[2J"),
        (KeyboardInterrupt(), 130, "interrupted\n"),
    ],
)
def test_a_bug_or_an_interruption_is_not_taken_for_a_verdict(
    monkeypatch: pytest.MonkeyPatch, error: BaseException, code: int, reported: str
) -> None:
    def broken(names: list[str]) -> None:
        raise error

    monkeypatch.setattr("slider_resonator.commands.scenes.find_scenes", broken)
    result = call("scenes", "--json")
    assert result.exit_code == code, "Python itself would have exited with 1"
    assert reported in result.stderr
    assert json.loads(result.stdout)["error"]


def test_an_interrupt_of_a_command_that_loads_is_quiet() -> None:
    script = """
import sys, time

class Slow:
    def find_spec(self, name, *others):
        if name == "slider_resonator.cli":
            print("ready", flush=True)
            time.sleep(60)

sys.meta_path.insert(0, Slow())
from slider_resonator.entry import main
main()
"""
    with subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    assert process.returncode == -signal.SIGINT, "which a shell reports as 130"
    assert not errors


@pytest.mark.parametrize(
    ("command", "quantity", "value"),
    [("steady", "steady_velocity", 0.126667), ("blocking", "blocking_force", 0.0851861)],
)
def test_results_as_json(native_fmu: Path, command: str, quantity: str, value: float) -> None:
    result = call(command, native_fmu, "--json")
    assert result.exit_code == 0
    assert_public_keys(command, result.stdout)
    assert json.loads(result.stdout)[quantity] == pytest.approx(value, rel=1e-5)


def test_a_load_is_no_setting_of_the_search_for_it(native_fmu: Path) -> None:
    said = refused("blocking", native_fmu, "--set", "load=50 mN")
    assert said.startswith("error: load = 0.05: it is what is searched; must be another par")


def test_no_steady_motion_exits_with_1_and_a_status(native_fmu: Path) -> None:
    search = ("steady", native_fmu, "--set", "frequency_ratio=1.001")
    result, printed = call(*search, "--json"), call(*search)
    assert (result.exit_code, printed.exit_code) == (1, 1)
    motion = json.loads(result.stdout)
    assert (motion["steady_velocity"], motion["status"]) == (None, "slow_beat")
    assert "slow_beat" in printed.stdout


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (OSError("the pipe is gone"), "error: standard output: the pipe is gone"),
        (OSError(28, "No space left", "a.csv"), "error: a.csv: No space left"),
        (OSError(), "error: standard output: OSError"),
    ],
)
def test_system_errors(error: OSError, words: str, capsys: pytest.CaptureFixture[str]) -> None:
    cli._report(error)
    assert capsys.readouterr().err == f"{words}\n"


FILES = {
    "mine.toml": "[device]\nslider_mass = 2\n",
    "grid.toml": "[grid]\nphase = [1]\n",
    "fase.toml": "[grid]\nfase = [1]\n",
    "three.toml": "[grid]\nphase = [1]\nload = [0]\nfidelity = [2]\n",
}
FILE = "refused_commands.txt"
PROMPT = "$ slider-resonator "


def test_refused_commands_write_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A command that is added to the file gets its text by `UPDATE_SCREENS=1`."""
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(options, "default_fmus", lambda: (Path("none.fmu"),))  # built or not
    said = []
    lines = (SCREENS / FILE).read_text(encoding="utf-8").splitlines()
    for command in (line.removeprefix(PROMPT) for line in lines if line.startswith(PROMPT)):
        result = call(*shlex.split(command))
        assert (result.exit_code, result.stdout) == (2, ""), command
        reason = re.sub(r"(?s)^Usage:.*(?=Error: )", "", result.stderr)
        said.append(f"{PROMPT}{command}\n{without_long_lists(reason)}")
    assert {path.name for path in tmp_path.iterdir()} == FILES.keys()
    assert_as_before(FILE, "".join(said))


def test_the_nearest_name_is_suggested_whatever_its_case() -> None:
    text = unknown_name("input", "Phse", ["phase", "load"])
    assert text == "unknown input 'Phse'; did you mean 'phase'? (must be one of load, phase)"
    assert "did you mean" not in unknown_name("input", "xyzzy", ["phase", "load"])
    scenes = [f"scene_{number}" for number in range(200)] + ["steady_contact"]
    text = unknown_name("scene", "steady_velocity", scenes)
    assert text.startswith("unknown scene 'steady_velocity'; did you mean 'steady_contact'?")
    assert "(must be one of 201, such as steady_contact, scene_" in text
    assert len(text) < 250


def test_the_only_name_with_that_part_comes_before_one_that_looks_like_it() -> None:
    text = unknown_name("parameter or input", "preload", ["load", "normal_preload", "phase"])
    assert "did you mean 'normal_preload'?" in text


def test_a_symbol_stands_for_its_parameter() -> None:
    text = unknown_name("parameter", "mu", ["slider_mass", "friction_coefficient"])
    assert "'mu'; did you mean 'friction_coefficient'?" in text
    assert "did you mean" not in unknown_name("output", "mu", ["position"])
