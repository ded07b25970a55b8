"""Verdicts as a table on a terminal or in a log."""

from collections.abc import Iterator, Mapping, Sequence

from rich.console import Console
from rich.text import Text

from slider_resonator.checks.compare import Check
from slider_resonator.checks.reports.headline import headline
from slider_resonator.checks.validate import Validation, worst_of_sweeps
from slider_resonator.checks.verdict import CALLED, near_zero, place, sentence, sizes, value_text
from slider_resonator.output.readable import escaped, number_of
from slider_resonator.output.table import Cell, Row, Style, Table, numbers, texts, verdict
from slider_resonator.output.terminal import STYLES, show_table, words
from slider_resonator.scenes.vocabulary import QUANTITIES

MAX_DETAILED = 3
"""Number of scenes up to which every check is shown; of more only the failed ones."""
MAX_SCENES = 12
"""Number of scenes with a line each: those farthest beyond a bound, or nearest to it."""
MAX_FAILED = 24
"""Number of failed checks that are shown, the worst."""
SIGNAL = "*"


def print_validation(
    console: Console, validation: Validation, *, details: bool = False, only_failed: bool = False
) -> None:
    """Print the table of verdicts, the reasons of failures, and a summary line.

    Show the worst point of a sweep; with `details` every point, and why each value is expected.
    Without it give of many scenes one line to each of the worst, and show of many failures the
    worst. With `only_failed` leave out what has passed.
    """
    for heading, answers in () if only_failed else headline(validation.checks):
        console.print(Text(escaped(heading.text), STYLES[heading.style]))
        indented = [(f"  {first}", *others) for first, *others in answers]
        show_table(console, Table([*texts(""), *numbers("", ""), *texts("")], indented))
    scenes = validation.scenes
    if len(scenes) > MAX_DETAILED and not (details or only_failed):
        _print_overview(console, scenes)
        only_failed = True
    checks = validation.failed if only_failed else validation.checks
    rows = [(check, 1) for check in checks] if details else worst_of_sweeps(checks)
    count = len(rows)
    if only_failed and not details:
        worst = sorted(rows, key=lambda row: -row[0].severity)[:MAX_FAILED]
        rows = [row for row in rows if row in worst]
    if rows:
        show_table(console, _table(rows, details))
    if any(_of_peak(check) for check, _ in rows):
        peaks = "relative to the peak of a signal; all others are in their unit"
        console.print(words(f"{SIGNAL} off by and allowed are {peaks}", console.width))
    for check, _ in rows:
        if not check.passed:
            text = f"{check.scene}: {check.quantity}{place(check.at, ' at ')}: {check.why}"
            shown = words(escaped(f"FAIL {text}\n     {sentence(check)}"), console.width, "     ")
            console.print(Text.assemble(("FAIL", STYLES[Style.FAIL]), shown.removeprefix("FAIL")))
    if len(rows) < count:
        more = number_of(count - len(rows), "more check")
        _print_line(console, Text(f"{more} failed (--details lists all)"))
    for text in _not_applied_lines(validation, details):
        _print_line(console, Text(escaped(f"not applicable: {text}")))
    summary = Text(f"{escaped(validation.fmu)}: ")
    wrong = {"failed": validation.failed, "could not be run": validation.run_failures}
    for what, found in wrong.items():
        if found:
            summary.append(f"{len(found)} {what}", STYLES[Style.FAIL]).append(", ")
    summary.append(validation.count)
    if validation.without:
        summary.append(f"; {escaped(validation.without)}", STYLES[Style.NOTE])
    _print_line(console, summary)


def _not_applied_lines(validation: Validation, details: bool) -> Iterator[str]:
    """Yield a line for each check, or without `details` one for all of the same reason."""
    by_reason: dict[str, list[tuple[str, str]]] = {}
    for scene, quantity, reason in validation.inapplicable:
        by_reason.setdefault(reason, []).append((scene, quantity))
    for reason, checks in by_reason.items():
        if details or len(checks) == 1:
            yield from (f"{scene}: {quantity}: {reason}" for scene, quantity in checks)
        else:
            scenes = len({scene for scene, _ in checks})
            alike = f"{number_of(len(checks), 'check')} of {number_of(scenes, 'scene')}"
            yield f"{alike}: {reason} (--details lists them)"


def _print_line(console: Console, line: Text) -> None:
    """Print a line: in one piece for a log, between words on a terminal."""
    console.print(line, soft_wrap=not console.is_terminal)


def _print_overview(console: Console, scenes: Mapping[str, Sequence[Check]]) -> None:
    """Print a line for each of the worst scenes.

    It has the check nearest to its limit, or farthest beyond it.
    """
    worst = {name: max(checks, key=lambda check: check.severity) for name, checks in scenes.items()}
    listed = sorted(scenes, key=lambda name: -worst[name].severity)[:MAX_SCENES]
    rows: list[Row] = []
    for scene in sorted(listed, key=[*scenes].index):
        count, total = sum(check.passed for check in scenes[scene]), len(scenes[scene])
        off, allowed, measure = sizes(worst[scene])
        cells = (scene, f"{count} of {total}", worst[scene].quantity)
        rows.append((*cells, _size(off), _size(allowed), measure, verdict(count == total)))
    columns = (
        *(*texts("scene"), *numbers("passed"), *texts("nearest to its bound")),
        *(*numbers("off by", "allowed"), *texts("in", "")),
    )
    show_table(console, Table(columns, rows))
    if more := len(scenes) - len(listed):
        nearer = f"{number_of(more, 'more scene')}, none nearer to a bound"
        _print_line(console, Text(f"{nearer} (--details lists all)"))


def _table(checks: Sequence[tuple[Check, int]], details: bool) -> Table:
    """Return a line for each check, with the number of points of a sweep that it covers."""
    swept = any(check.at for check, _ in checks)
    where = texts("at" if details else "worst at") if swept else []
    columns = (
        *(*texts("quantity"), *where, *numbers("FMU", "reference"), *texts("against")),
        *(*numbers("off by", "allowed"), *texts("")),
    )
    rows: list[Row] = []
    scene = ""
    for check, points in checks:
        if check.scene != scene:
            scene = check.scene
            rows.append([Cell(f"{scene}, {points} points" if points > 1 else scene, Style.HEADING)])
        unit = f", {check.unit}" if check.unit not in ("", "1") else ""
        mark = SIGNAL if _of_peak(check) else ""
        cells = [f" {check.quantity}{mark}{unit}", *([place(check.at)] if swept else [])]
        cells += [value_text(value, 8) for value in (check.fmu, check.reference)]
        cells.append(CALLED.get(check.against, check.against))
        cells += [_size(size) for size in sizes(check)[:2]]
        rows.append((*cells, verdict(check.passed)))
        if details:
            rows.append([Cell(check.why, Style.NOTE)])
    return Table(columns, rows)


def _of_peak(check: Check) -> bool:
    quantity = QUANTITIES[check.quantity]
    return quantity.kind == "signal" and not (quantity.in_periods or near_zero(check))


def _size(size: float | None) -> str:
    return "-" if size is None else f"{size:.1e}" if size else "0"
