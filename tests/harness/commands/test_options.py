from __future__ import annotations

from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from slider_resonator.commands import options
from slider_resonator.errors import FmuError
from slider_resonator.fmu import finished


def test_fmus_built_here_are_preferred(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    package = tmp_path / "package"
    monkeypatch.setattr(finished, "FOLDERS", (package,))
    monkeypatch.setattr(finished, "COMMANDS_LOOK_IN", (Path("dist"), package))
    assert options.default_fmu(Path("given.fmu")) == Path("given.fmu")
    with pytest.raises(FmuError, match="make build"):
        options.default_fmu(None)
    native, python = (Path("dist") / finished.FMUS[build] for build in ("native", "python"))
    in_package = package / python.name
    package.mkdir()
    in_package.touch()
    assert options.default_fmus() == (in_package,)
    python.parent.mkdir()
    python.touch()
    assert options.default_fmu(None) == python
    native.touch()
    assert options.default_fmus() == (native, python)
    assert options.default_fmu(None) == native, "the native FMU comes first"


@click.command("echo", cls=options.SettingsCommand)
@click.argument("names", nargs=-1)
@options.set_option
@options.json_option
def echo(names: tuple[str, ...], settings: dict[str, float], as_json: bool) -> None:
    """Print what was given."""
    click.echo((names, settings, as_json))


@pytest.mark.parametrize(
    "arguments",
    [
        ["a.fmu", "--set", "phase=0.4", "load=0.05", "tolerance=1e-9", "--json"],
        ["a.fmu", "--set=phase=0.4", "load=0.05", "--json", "--set", "tolerance=1e-9"],
        ["--json", "--set", "phase=0.4", "--set", "load=0.05", "tolerance=1e-9", "a.fmu"],
    ],
)
def test_several_settings_may_follow_one_option(arguments: list[str]) -> None:
    result = CliRunner().invoke(echo, arguments)
    assert result.exit_code == 0, result.output
    settings = {"phase": 0.4, "load": 0.05, "tolerance": 1e-9}
    assert result.output == f"{(('a.fmu',), settings, True)}\n"


@pytest.mark.parametrize(
    ("arguments", "reported"),
    [
        (["--set", "phase=1", "phse=1"], "did you mean 'phase'"),
        (["--set", "phase=1", "load=x"], "must be a number"),
        (["--set", "phase=1", "phase=2"], "must be one value"),
        (["--set", "--json"], "is not NAME=VALUE"),
        (["--set"], "requires an argument"),
    ],
)
def test_every_setting_is_judged(arguments: list[str], reported: str) -> None:
    result = CliRunner().invoke(echo, arguments)
    assert result.exit_code == 2
    assert reported in result.output


@pytest.mark.parametrize("arguments", [["phase=1"], ["--", "phase=1"], ["--json", "phase=1"]])
def test_only_what_follows_the_option_is_a_setting(arguments: list[str]) -> None:
    result = CliRunner().invoke(echo, arguments)
    assert result.output.startswith("(('phase=1',), {},"), "it may be the name of a file"
