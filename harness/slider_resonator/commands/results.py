"""Print a command's result as JSON or as text."""

from __future__ import annotations

from typing import Any

import click

from slider_resonator.output.console import output
from slider_resonator.output.json_output import to_json
from slider_resonator.output.table import Table
from slider_resonator.output.terminal import escaped, rendered


def print_result(result: Any, text: str, *, as_json: bool) -> None:
    """Print the result as JSON or as text."""
    click.echo(to_json(result) if as_json else escaped(text))


def print_table(table: Table) -> None:
    """Print a table on the console for results."""
    output().print(rendered(table))
