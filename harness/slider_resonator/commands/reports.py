"""Where the verdicts of a command go: the terminal and the files that were asked for."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from slider_resonator.checks.reports.json_report import validations_as_json, write_json
from slider_resonator.checks.reports.junit import write_junit
from slider_resonator.checks.reports.step_summary import VARIABLE, append_summary
from slider_resonator.checks.reports.terminal import print_validation
from slider_resonator.checks.validate import RunFailure, Validation
from slider_resonator.checks.verdict import place
from slider_resonator.commands.options import Target
from slider_resonator.output.console import output
from slider_resonator.output.targets import distinct

PRINTED = Path("-")
"""What `--json` without a file stands for."""


class JsonTarget(Target):
    """A JSON file to write, or standard output."""

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> Path:
        """Return the path, `PRINTED` as it is."""
        return PRINTED if str(value) == str(PRINTED) else super().convert(value, param, ctx)


@dataclass(frozen=True)
class Reports:
    """Where verdicts go, beside the terminal; None where a report was not asked for."""

    title: str
    junit: Path | None
    html: Path | None
    json: Path | None
    summary: Path | None

    @classmethod
    def asked_for(
        cls,
        title: str,
        junit: Path | None,
        html: Path | None,
        json: Path | None,
        sources: Mapping[str, Path],
    ) -> Reports:
        """Return the reports of these options and the environment, none of which is a source.

        Raises HarnessError for one that is.
        """
        written = None if json == PRINTED else json
        distinct({"--junit": junit, "--html": html, "--json": written}, sources)
        summary = os.environ.get(VARIABLE)
        return cls(title, junit, html, json, Path(summary) if summary else None)

    @property
    def prints_json(self) -> bool:
        """Whether JSON is all that goes to standard output."""
        return self.json == PRINTED

    def write(self, validations: Sequence[Validation], error: str = "") -> None:
        """Write all that were asked for; HarnessError where one cannot be written."""
        if self.json is not None and self.json != PRINTED:
            write_json(self.json, validations, error)
        if self.junit is not None:
            write_junit(self.junit, validations, error, title=self.title)
        if self.html is not None:
            # Here, for drawing takes longer to load than everything else.
            from slider_resonator.checks.reports.html_report import write_html

            write_html(self.html, validations, error, title=self.title)
        if self.summary is not None:  # last: it is not a file that the user has named
            append_summary(self.summary, validations, error, title=self.title)


def report_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Give a command the options --junit, --html and --json."""
    options = (
        click.option("--junit", type=Target([".xml"]), help="JUnit XML for a CI server."),
        click.option(
            "--html", type=Target([".html"]), help="One page with pictures of what differs."
        ),
        click.option(
            "--json",
            type=JsonTarget([".json"]),
            is_flag=False,
            flag_value=str(PRINTED),
            metavar="[FILE.json]",
            help="Write one JSON document, or print it when no file is given.",
        ),
    )
    for option in reversed(options):
        command = option(command)
    return command


def print_verdicts(
    validations: Sequence[Validation], *, details: bool, as_json: bool, only_failed: bool = False
) -> None:
    """Print the tables, or one JSON document, and on standard error what could not be run."""
    if as_json:
        click.echo(validations_as_json(validations))
    for validation in validations:
        if validation.checks and not as_json:
            print_validation(output(), validation, details=details, only_failed=only_failed)
        print_run_failures(validation.fmu, validation.run_failures)


def print_run_failures(fmu: str, run_failures: Sequence[RunFailure]) -> None:
    """Print on standard error what could not be run, and where."""
    for run_failure in run_failures:
        where = f"{fmu}: scene {run_failure.scene}{place(run_failure.at, ' at ')}: " * bool(
            run_failure.scene
        )
        click.echo(f"error: {where}{run_failure.reason}", err=True)
