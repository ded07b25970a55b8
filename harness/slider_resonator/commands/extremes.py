"""`extremes`: the stability matrix."""

from __future__ import annotations

from pathlib import Path

import click

from slider_resonator.commands.options import default_fmus, json_option
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.output.console import progress_bar
from slider_resonator.output.json_output import to_json
from slider_resonator.output.targets import make_folder
from slider_resonator.trials.extremes.listing import as_plain, write_matrices
from slider_resonator.trials.extremes.matrix import all_cells
from slider_resonator.trials.extremes.run import TIME_LIMIT, Matrix, run_matrix
from slider_resonator.trials.extremes.verdict import PASSED


@click.command("extremes")
@click.argument("fmus", type=click.Path(path_type=Path), nargs=-1)
@click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    required=True,
    help="Folder for extremes.json, extremes.md and a picture for each FMU.",
)
@click.option(
    "--limit",
    type=click.FloatRange(min=0.0, min_open=True),
    default=TIME_LIMIT,
    show_default=True,
    help="Time limit of a cell in s; a cell that exceeds it fails.",
)
@click.option(
    "--long",
    is_flag=True,
    help="Add resolved runs of 1e8 drive periods, with LuGre friction of 1e6: minutes each in the "
    "native FMU, so give slower ones a --limit. Without it they have 1e5 and 1e3; averaged motion "
    "always has 1e8.",
)
@json_option
@click.pass_context
def extremes_command(
    context: click.Context,
    fmus: tuple[Path, ...],
    out: Path,
    limit: float,
    long: bool,
    as_json: bool,
) -> None:
    """Run FMUs at the extremes of every parameter, input and step, and judge them by physics.

    The FMU runs in a process of its own. A cell passes the bounds that follow from the equations,
    is refused by name, or fails; a hang or a crash fails its cell. Without FMUS: those that
    build_fmu.py has built in dist. Leaves with 0 when no cell failed, 1 when one did, 2 when
    an FMU could not be run.

    \b
    Examples:
      python -m harness extremes --out extremes
      python -m harness extremes my.fmu --out extremes --json
    """
    chosen = fmus or default_fmus()
    for path in chosen:
        with open_fmu(path):  # One that cannot be opened must not cost the matrix of another.
            pass
    make_folder(out)
    cells = all_cells(long=long)
    with progress_bar() as progress:
        matrices = [run_matrix(fmu, cells, progress, limit) for fmu in chosen]
    write_matrices(matrices, out)
    if as_json:
        click.echo(to_json(as_plain(matrices)))
    else:
        click.echo("\n".join(_sentences(matrix) for matrix in matrices))
        click.echo(f"written {out}")
    context.exit(0 if all(matrix.passed for matrix in matrices) else 1)


def _sentences(matrix: Matrix) -> str:
    lines = [f"{matrix.fmu}: {matrix.summary}"]
    lines.extend(
        f"  {one.verdict}: {one.name}: {one.reason}"
        for one in matrix.verdicts
        if one.verdict != PASSED
    )
    return "\n".join(lines)
