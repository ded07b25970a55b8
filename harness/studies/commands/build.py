"""`build`: build the FMUs of a checkout."""

import subprocess
import sys
from pathlib import Path

import click

from slider_resonator.errors import HarnessError

SCRIPT = Path(__file__).resolve().parents[3] / "build_fmu.py"


@click.command("build", context_settings={"ignore_unknown_options": True})
@click.argument("arguments", nargs=-1, type=click.UNPROCESSED)
@click.pass_context
def build_command(context: click.Context, arguments: tuple[str, ...]) -> None:
    """Build the FMUs from the sources of a checkout.

    Takes the options of build_fmu.py, which `python build_fmu.py --help` lists. Needs the
    checkout's extra `build`: `pip install --editable '.[build]'`. An installed wheel brings
    finished FMUs instead: `slider_resonator.fmu_path()`. Exit code: 0 when built, 2 otherwise.

    \b
    Examples:
      python -m harness build
      python -m harness build --only native --platform host
    """
    if not SCRIPT.is_file():
        raise HarnessError(
            "build refused: this installation has no sources; must be an editable installation of "
            "a checkout. slider_resonator.fmu_path() names the finished FMU"
        )
    context.exit(subprocess.run([sys.executable, SCRIPT, *arguments], check=False).returncode)
