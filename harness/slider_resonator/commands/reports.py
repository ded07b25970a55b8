"""Write the verdicts of a command to the terminal and to report files."""

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import wraps
from pathlib import Path
from typing import Any

import click

from slider_resonator.checks.reports import for_ci
from slider_resonator.checks.reports.terminal import print_validation
from slider_resonator.checks.validate import RunFailure, Validation
from slider_resonator.commands.options import Parsed, target
from slider_resonator.output.console import output, print_text
from slider_resonator.output.files import distinct, writable, write_text
from slider_resonator.output.readable import indented

PRINTED = Path("-")
"""The value of `--json` without a file."""


@dataclass(frozen=True)
class Reports:
    """The report files of a command; None for a report that was not requested."""

    title: str
    junit: Path | None
    html: Path | None
    json: Path | None
    summary: Path | None

    def spare(self, sources: Mapping[str, Path]) -> None:
        """Raise HarnessError for a report that would replace one of the sources."""
        written = None if self.prints_json else self.json
        distinct({"--junit": self.junit, "--html": self.html, "--json": written}, sources)

    @property
    def prints_json(self) -> bool:
        """Whether only JSON goes to standard output."""
        return self.json == PRINTED

    def print(
        self, validations: Sequence[Validation], *, details: bool, only_failed: bool = False
    ) -> None:
        """Print the tables or one JSON document, and the run failures on standard error."""
        if self.prints_json:
            click.echo(for_ci.validations_as_json(validations))
        for validation in validations:
            if (validation.checks or validation.not_applied) and not self.prints_json:
                print_validation(output(), validation, details=details, only_failed=only_failed)
            print_run_failures(validation.fmu, validation.run_failures)
            if validation.exit_code == 2 and not validation.run_failures:
                print_text(f"error: {validation.fmu}: {validation.outcome}", err=True)

    def write(self, validations: Sequence[Validation], error: str = "") -> None:
        """Write all requested reports; HarnessError when one cannot be written."""
        if self.json is not None and not self.prints_json:
            write_text(self.json, for_ci.validations_as_json(validations, error) + "\n")
        if self.junit is not None:
            for_ci.write_junit(self.junit, validations, error, title=self.title)
        if self.html is not None:
            # Imported here: drawing takes longer to load than everything else.
            from slider_resonator.checks.reports.html_report import write_html

            write_html(self.html, validations, error, title=self.title)
        if self.summary is not None:  # last, for it may fail and the user has not named it
            for_ci.append_summary(self.summary, validations, error, title=self.title)


def report_options(title: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return what adds --junit, --html and --json to a command, which gets them as `reports`."""

    def add(command: Callable[..., Any]) -> Callable[..., Any]:
        @click.option("--junit", type=target([".xml"]), help="JUnit XML for a CI server.")
        @click.option(
            "--html", type=target([".html"]), help="One page with pictures of what differs."
        )
        @click.option(
            "--json",
            type=Parsed("FILE", lambda name: PRINTED if name == "-" else writable(name, [".json"])),
            is_flag=False,
            flag_value=str(PRINTED),
            metavar="[FILE.json]",
            help="Write one JSON document, or print it when no file is given.",
        )
        @wraps(command)
        def with_reports(
            junit: Path | None, html: Path | None, json: Path | None, **others: Any
        ) -> Any:
            summary = os.environ.get(for_ci.VARIABLE)
            path = Path(summary) if summary else None
            return command(reports=Reports(title, junit, html, json, path), **others)

        return with_reports

    return add


def print_run_failures(fmu: str, run_failures: Sequence[RunFailure]) -> None:
    """Print the run failures on standard error."""
    for failure in run_failures:
        where = f"{fmu}: scene {failure.where}" if failure.scene else ""
        print_text(indented(f"error: {where}{failure.reason}"), err=True)
