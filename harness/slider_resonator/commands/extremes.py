"""`extremes`: run the stability matrix."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches
from functools import partial
from pathlib import Path

import click

from slider_resonator.commands.options import (
    default_fmus,
    fmus_argument,
    json_option,
    out_folder_option,
    time_limit_option,
)
from slider_resonator.commands.results import print_result
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import noting_on_interrupt
from slider_resonator.output.progress import part_of
from slider_resonator.output.progress_bar import progress_bar
from slider_resonator.output.readable import number_of
from slider_resonator.output.targets import make_folder
from slider_resonator.output.terminal import one_line
from slider_resonator.stress.case import MatrixCell
from slider_resonator.stress.listing import as_plain, write_matrices
from slider_resonator.stress.matrix import all_cells
from slider_resonator.stress.run import TIME_LIMIT, Matrix, run_matrix
from slider_resonator.stress.verdict import PASSED


@click.command("extremes")
@fmus_argument
@out_folder_option("extremes.json, extremes.md, index.html and a picture for each FMU")
@time_limit_option(TIME_LIMIT, "For each cell; one that hangs fails.", "--limit")
@click.option(
    "--long",
    is_flag=True,
    help="Lengthen resolved runs from 1e5 to 1e8 drive periods, with LuGre friction from 1e3 to "
    "1e6: minutes each in the native FMU, so give slower ones a --time-limit. Averaged motion "
    "always has 1e8.",
)
@click.option("--cell", "name", metavar="NAME", help="Run only the cell of this name.")
@json_option
@click.pass_context
def extremes_command(
    context: click.Context,
    fmus: tuple[Path, ...],
    out: Path,
    time_limit: float,
    long: bool,
    name: str | None,
    as_json: bool,
) -> None:
    """Run FMUs at the extremes of every parameter, input and step, and check them by physics.

    Each cell runs in a process of its own. It passes the bounds that follow from the equations, is
    refused by name, or fails; a hang or a crash fails its cell. Without FMUS: those in dist. Exit
    code: 0 when no cell fails, 1 when one does, 2 when an FMU could not run. The verdicts so far
    are written when the command is interrupted.

    \b
    Examples:
      slider-resonator extremes --out extremes
      slider-resonator extremes my.fmu --out extremes --json
      slider-resonator extremes my.fmu --out one_cell --cell "r_m: 1e-12: Coulomb, fidelity 1"
    """
    chosen = fmus or default_fmus()
    for path in chosen:
        with open_fmu(path):  # before any matrix runs: one takes minutes
            pass
    cells = _chosen(all_cells(long=long), name)
    make_folder(out)
    provenance = provenance_of(*chosen)
    matrices: list[Matrix] = []

    def keep(matrix: Matrix) -> None:
        matrices.append(matrix)
        write_matrices(matrices, out, provenance)

    with noting_on_interrupt(partial(_kept, matrices, out)), progress_bar() as progress:
        for index, fmu in enumerate(chosen):
            part = part_of(progress, index, len(chosen))
            keep(run_matrix(fmu, cells, part, time_limit, keep))
    lines = [*map(_sentences, matrices), f"written {one_line(str(out))}"]
    text = "\n".join(lines)
    print_result(as_plain(matrices), text, as_json=as_json, provenance=provenance)
    context.exit(0 if all(matrix.passed for matrix in matrices) else 1)


def _chosen(cells: Sequence[MatrixCell], name: str | None) -> Sequence[MatrixCell]:
    """Return all cells, or the one of that name; HarnessError when there is none."""
    chosen = [cell for cell in cells if name in (None, cell.name)]
    if not chosen:
        near = get_close_matches(name or "", [cell.name for cell in cells], n=1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise HarnessError(
            f"--cell {name!r} refused: must be AXIS: VALUE: MODEL of a cell, as in extremes.json"
            f"{hint}"
        )
    return chosen


def _kept(matrices: Sequence[Matrix], out: Path) -> str:
    if not matrices:
        return "no cell has run; nothing is kept"
    ran = sum(len(matrix.verdicts) for matrix in matrices)
    return (
        f"the verdicts of {number_of(ran, 'cell')} are kept in {out}; the same command runs "
        "all cells again"
    )


def _sentences(matrix: Matrix) -> str:
    lines = [f"{one_line(matrix.fmu)}: {matrix.summary}"]
    lines.extend(
        f"  {one.verdict}: {one.name}: {one_line(one.reason)}"
        for one in matrix.verdicts
        if one.verdict != PASSED
    )
    return "\n".join(lines)
