"""The help of all commands, and the names of their options."""

import re
from collections.abc import Iterator
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from slider_resonator.commands import options
from slider_resonator.errors import FmuError
from slider_resonator.fmu import finished
from studies import COMMANDS as STUDIES
from studies.cli import main
from tests.harness.calling import call
from tests.harness.golden import assert_as_before
from tests.processes import run_python


def commands() -> Iterator[tuple[str, click.Command]]:
    """Yield every command by its name, with those of a group."""
    context = click.Context(main)
    for name in main.summaries:
        command = main.get_command(context, name)
        assert command is not None
        yield name, command
        if isinstance(command, click.Group):
            yield from ((f"{name} {inner}", c) for inner, c in command.commands.items())


EVERY = dict(commands())
PROGRAMS = ("slider-resonator", "python", "pip")
OPTIONS = {
    name: {opt for p in command.params if isinstance(p, click.Option) for opt in p.opts}
    for name, command in EVERY.items()
}


@pytest.mark.parametrize("width", [80, 120])
def test_no_help_but_examples_is_wider_than_the_terminal(width: int) -> None:
    for name, command in EVERY.items():
        context = click.Context(command, info_name=name, terminal_width=width - 2)
        lines = command.get_help(context).splitlines()
        lines = [line for line in lines if not line.lstrip().startswith(PROGRAMS)]  # to be copied
        assert not [line for line in lines if len(line) > width], name
        assert not [line for line in lines if re.search(r"\w-$", line)], name


@pytest.mark.parametrize("name", EVERY)
def test_help_shows_examples(name: str) -> None:
    result = call(*name.split(), "--help")
    assert result.exit_code == 0
    program = "python -m harness" if name in STUDIES else "slider-resonator"
    assert f"{program} {name}" in result.stdout


def test_options_have_the_same_name_in_every_command() -> None:
    names = sorted({option for options in OPTIONS.values() for option in options})
    having = {name: [one for one, options in OPTIONS.items() if name in options] for name in names}
    lines = [f"{option}: {', '.join(commands)}\n" for option, commands in having.items()]
    assert_as_before("options.txt", "".join(lines))


@pytest.mark.parametrize("arguments", [("steady",), ("blocking",), ("run", "table_1")])
def test_the_default_is_the_native_fmu(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...]
) -> None:
    (tmp_path / "dist").symlink_to(native_fmu.parent)
    monkeypatch.chdir(tmp_path)
    result = call(*arguments)
    assert result.exit_code == 0, result.output
    assert str(Path("dist") / "SliderResonator.fmu") in result.stdout


def test_help_of_all_commands_loads_none_of_them() -> None:
    code = "import sys, atexit; atexit.register(lambda: print(*sys.modules)); "
    loaded = run_python(code + "from slider_resonator.cli import main; main(['--help'])")
    assert "slider_resonator.cli" in loaded
    assert "slider_resonator.commands." not in loaded


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
@options.device_options
@options.json_option
def echo(names: tuple[str, ...], given: options.Given, as_json: bool) -> None:
    """Print what was given."""
    click.echo((names, given.settings, as_json))


SETTINGS = {"phase": 0.4, "load": 0.05, "tolerance": 1e-9}


@pytest.mark.parametrize(
    ("arguments", "name", "settings"),
    [
        ("a.fmu --set phase=0.4 load=0.05 tolerance=1e-9 --json", "a.fmu", SETTINGS),
        ("a.fmu --set=phase=0.4 load=0.05 --json --set tolerance=1e-9", "a.fmu", SETTINGS),
        ("--json --set phase=0.4 --set load=0.05 tolerance=1e-9 a.fmu", "a.fmu", SETTINGS),
        # It may be the name of a file.
        ("phase=1 --json", "phase=1", {}),
        ("--json -- phase=1", "phase=1", {}),
        ("--json phase=1", "phase=1", {}),
    ],
)
def test_settings_follow_their_option(arguments: str, name: str, settings: object) -> None:
    result = CliRunner().invoke(echo, arguments.split())
    assert result.output == f"{((name,), settings, True)}\n"
