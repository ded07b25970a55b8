"""Print a command's result as JSON or as text."""

from typing import Any

import click

from slider_resonator.fmu.provenance import Provenance
from slider_resonator.output.console import output
from slider_resonator.output.json_output import to_json
from slider_resonator.output.readable import escaped
from slider_resonator.output.table import Table
from slider_resonator.output.terminal import fitting, rendered, terminal_width


def print_result(result: Any, text: str, *, as_json: bool, provenance: Provenance | None) -> None:
    """Print the result as JSON, with its provenance, or as text."""
    if as_json:
        print_json(result, provenance)
    else:
        print_text(text)


def print_json(result: Any, provenance: Provenance | None = None) -> None:
    """Print the result, and its provenance if it has one, as one JSON document."""
    click.echo(to_json(result, provenance))


def print_text(text: str, *, err: bool = False) -> None:
    """Print text that may hold foreign parts, on standard error with `err`.

    A terminal gets lines that fit it, a file or another program gets them as they are.
    """
    click.echo(fitting(escaped(text), terminal_width(err=err)), err=err)


def print_table(table: Table) -> None:
    """Print a table on the console for results."""
    output().print(rendered(table))
