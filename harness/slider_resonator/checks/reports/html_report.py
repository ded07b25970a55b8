"""Verdicts as one HTML file that needs no other, with pictures of what differs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from slider_resonator.checks.compare import Check
from slider_resonator.checks.reports.deviation_plot import deviation_png
from slider_resonator.checks.reports.headline import headline
from slider_resonator.checks.reports.scene_sections import scene_sections
from slider_resonator.checks.validate import (
    Curves,
    Validation,
    provenance_of_all,
    worst_of_sweeps,
)
from slider_resonator.checks.verdict import (
    TITLE,
    judged_without,
    not_applied,
    place,
    sentence,
    title,
)
from slider_resonator.fmu.provenance_text import provenance_html
from slider_resonator.output.hover_plot import hover_scripts, hover_style
from slider_resonator.output.html_page import escaped, folded, rendered, write_page
from slider_resonator.output.readable import number_of
from slider_resonator.output.table import Table, numbers, texts

MAX_PICTURES = 40
"""Maximum pictures for each FMU, one per sweep: a very faulty FMU fails everywhere."""


def write_html(
    path: Path, validations: Sequence[Validation], error: str = "", *, title: str = TITLE
) -> None:
    """Write the report; `error` is what stopped the command before it reached an FMU.

    Raises HarnessError when the file cannot be written.
    """
    parts = [f'<p class="fail">Could not run: {escaped(error)}</p>'] if error else []
    for number, validation in enumerate(validations):
        parts += _section(number, validation)
    parts.append(provenance_html(provenance_of_all(validations)))
    write_page(path, title, parts, hover_scripts(), hover_style())


def _section(number: int, validation: Validation) -> list[str]:
    failed = [check for check in validation.checks if not check.passed]
    passed = len(validation.checks) - len(failed)
    outcome = ("pass", "fail", "could not be run")[validation.exit_code]
    colour = "pass" if validation.passed else "fail"
    parts = [
        f"<h2>{escaped(validation.fmu)}</h2>",
        f'<p><span class="{colour}">{outcome}</span>: {passed} of {len(validation.checks)} checks '
        f"passed in {validation.wall_time:.1f} s</p>",
    ]
    for heading, rows in headline(validation.checks):
        cells = [(name, passed, value, off) for name, value, off, passed in rows]
        answer = Table((*texts("", ""), *numbers("", "")), cells)
        parts.append(f"<h3>{escaped(heading.text)}</h3>{rendered(answer)}")
    without = judged_without(validation)
    if without:
        parts.append(f"<p>{escaped(without)}</p>")
    for failure in validation.run_failures:
        where = f"{failure.scene}{place(failure.at, ' at ')}: " if failure.scene else ""
        parts.append(f'<p class="fail">{escaped(where + failure.reason)}</p>')
    pictures = {id(curves.check): curves for curves in validation.curves}
    for index, (check, _) in enumerate(worst_of_sweeps(failed)):
        parts += _failure(check, pictures.get(id(check)) if index < MAX_PICTURES else None)
    if validation.checks:
        parts += scene_sections(validation, f"scene-{number}")
    if validation.not_applied:
        columns = texts("scene", "quantity", "not applicable because")
        table = Table(columns, not_applied(validation))
        label = number_of(len(validation.not_applied), "check") + " that do not apply"
        parts.append(folded(label, rendered(table)))
    return parts


def _failure(check: Check, curves: Curves | None) -> list[str]:
    parts = [
        f"<h3>{escaped(check.scene)}: {escaped(title(check))}</h3>",
        f'<p>{escaped(sentence(check))}<br><span class="note">{escaped(check.why)}</span></p>',
    ]
    if curves is not None:
        parts.append(f'<img alt="{escaped(title(check))}" src="{deviation_png(curves)}">')
    return parts
