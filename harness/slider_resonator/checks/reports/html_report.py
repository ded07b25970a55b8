"""Verdicts as one HTML file that needs nothing beside it, with pictures of what differs."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from slider_resonator.checks.compare import Check, Value
from slider_resonator.checks.reports.deviation_plot import deviation_png
from slider_resonator.checks.validate import Curves, Validation, worst_of_sweeps
from slider_resonator.checks.verdict import TITLE, place, sentence, title
from slider_resonator.output.html_page import write_page
from slider_resonator.output.readable import readable
from slider_resonator.scenes.vocabulary import QUANTITIES

MOST_PICTURES = 40
"""Pictures for each FMU, of the worst point of a sweep only: a hopeless FMU fails everywhere."""


def write_html(
    path: Path, validations: Sequence[Validation], error: str = "", *, title: str = TITLE
) -> None:
    """Write the report; `error` is what kept the command from getting as far as an FMU.

    Raises HarnessError when the file cannot be written.
    """
    parts = [f'<p class="fail">Could not run: {escape(error)}</p>'] if error else []
    parts += [part for validation in validations for part in _section(validation)]
    write_page(path, title, parts)


def _section(validation: Validation) -> list[str]:
    failed = [check for check in validation.checks if not check.passed]
    passed = len(validation.checks) - len(failed)
    verdict = ("pass", "fail", "could not be run")[validation.exit_code]
    colour = "pass" if validation.passed else "fail"
    parts = [
        f"<h2>{escape(validation.fmu)}</h2>",
        f'<p><span class="{colour}">{verdict}</span>: {passed} of {len(validation.checks)} checks '
        f"passed in {validation.wall_time:.1f} s</p>",
    ]
    for run_failure in validation.run_failures:
        where = f"{run_failure.scene}{place(run_failure.at, ' at ')}: " * bool(run_failure.scene)
        parts.append(f'<p class="fail">{escape(where + run_failure.reason)}</p>')
    worst = [check for check, _ in worst_of_sweeps(failed)]
    pictures = {id(curves.check): curves for curves in validation.curves}
    for index, check in enumerate(worst):
        parts += _failure(check, pictures.get(id(check)) if index < MOST_PICTURES else None)
    parts.append(_table(validation.checks))
    return parts


def _failure(check: Check, curves: Curves | None) -> list[str]:
    parts = [
        f"<h3>{escape(check.scene)}: {escape(title(check))}</h3>",
        f'<p>{escape(sentence(check))}<br><span class="why">{escape(check.why)}</span></p>',
    ]
    if curves is not None:
        parts.append(f'<img alt="{escape(title(check))}" src="{deviation_png(curves)}">')
    return parts


def _table(checks: Sequence[Check]) -> str:
    if not checks:
        return ""
    heads = ("scene", "quantity", "FMU", "reference", "off by", "allowed", "")
    rows = "\n".join(_row(check) for check in checks)
    head = "".join(f"<th>{name}</th>" for name in heads)
    return (
        f'<details><summary>All {len(checks)} checks</summary><div class="wide"><table>'
        f"<thead><tr>{head}</tr></thead><tbody>\n{rows}\n</tbody></table></div></details>"
    )


def _row(check: Check) -> str:
    of_peak = QUANTITIES[check.quantity].relative_to_peak
    sizes = [
        "-" if size is None else f"{size:.2g}" + " of peak" * of_peak
        for size in (check.deviation, check.allowed)
    ]
    numbers = [_value(check.fmu), _value(check.reference), *sizes]
    unit = f" [{check.unit}]" * (check.unit not in ("", "1"))
    cells = "".join(f"<td>{escape(text)}</td>" for text in (check.scene, title(check) + unit))
    cells += "".join(f'<td class="n">{escape(text)}</td>' for text in numbers)
    verdict = "pass" if check.passed else "fail"
    return f'<tr title="{escape(check.why)}">{cells}<td class="{verdict}">{verdict}</td></tr>'


def _value(value: Value) -> str:
    if value is None:
        return "none"
    return value if isinstance(value, str) else readable(value, 8)
