"""`crosscheck`: the tree for the FMI cross-check, and how FMPy finds it."""

from __future__ import annotations

from pathlib import Path

import click

from slider_resonator.commands.options import default_fmu, json_option
from slider_resonator.fmu.instance import instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.output.json_output import to_json
from slider_resonator.trials.crosscheck.export import FOLDER_NAME, export
from slider_resonator.trials.crosscheck.importer import Imported, imported

TOOL = "slider-resonator"


def _folder_name(context: click.Context, option: click.Parameter, name: str) -> str:
    if not FOLDER_NAME.fullmatch(name):
        raise click.BadParameter(
            f"{name!r}: allowed are letters, digits and . _ + -", context, option
        )
    return name


@click.command("crosscheck")
@click.argument("fmu", type=click.Path(path_type=Path), required=False)
@click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    required=True,
    help="Folder for the tree, which begins with fmus/2.0/cs.",
)
@click.option(
    "--tool",
    default=TOOL,
    show_default=True,
    callback=_folder_name,
    help="Name under which the exporting tool is listed at fmi-standard.org.",
)
@json_option
@click.pass_context
def crosscheck_command(
    context: click.Context, fmu: Path | None, out: Path, tool: str, as_json: bool
) -> None:
    """Write what the FMI cross-check asks of an exporting tool, and check it with FMPy.

    For each platform that the FMU has a binary for, or sources, there are three folders with the
    FMU, inputs, reference results, options and a ReadMe. FMPy checks them by the rules, version
    4.1, and repeats the runs of this platform. Without FMU: the native one in dist. Leaves with 0
    when nothing is wrong, 1 when something is, 2 when the tree could not be written.

    \b
    Examples:
      python -m harness crosscheck --out crosscheck
      python -m harness crosscheck my.fmu --out crosscheck --tool MyTool --json
    """
    with open_fmu(default_fmu(fmu)) as opened, instantiate(opened) as instance:
        folders = export(instance, out, tool)
    results = [imported(folder) for folder in folders]
    passed = all(result.passed for result in results)
    if as_json:
        rows = [{**vars(one), "folder": str(one.folder), "passed": one.passed} for one in results]
        click.echo(to_json({"passed": passed, "folders": rows}))
    else:
        click.echo("\n".join(_sentence(result) for result in results))
    context.exit(0 if passed else 1)


def _sentence(result: Imported) -> str:
    if not result.passed:
        return f"{result.folder}: {'; '.join(result.problems)}"
    run = "files only, of another platform" if result.outliers is None else "files and run"
    return f"{result.folder}: pass ({run})"
