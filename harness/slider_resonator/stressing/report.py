"""The result as a page of HTML, with a grid for each axis, as plain data and in words."""

from collections.abc import Sequence
from pathlib import Path

from slider_resonator.device.interface import INPUTS
from slider_resonator.fmu.provenance import Provenance, provenance_html
from slider_resonator.output.files import write_text
from slider_resonator.output.html_page import escaped, rendered, section, write_page
from slider_resonator.output.json_output import to_json
from slider_resonator.output.readable import number_of
from slider_resonator.output.table import Cell, Row, Style, Table, numbers, texts, verdict
from slider_resonator.stressing.case import MODELS, RANDOM, Case, name_of
from slider_resonator.stressing.run import FAILED, MEANINGS, PASSED, StressResult, Verdict


def write_stress_page(path: Path, results: Sequence[StressResult], provenance: Provenance) -> None:
    """Write the page; HarnessError when that is impossible."""
    overview: list[Row] = [
        (Path(one.fmu).name, verdict(not one.failed, one.not_run)) for one in results
    ]
    legend: list[Row] = []
    for name, meaning in MEANINGS.items():
        count = sum(one.counts.get(name, 0) for one in results)
        style = Style.FAIL if name == FAILED and count else Style.PLAIN
        legend.append((Cell(name, style), str(count), meaning))
    parts = [
        rendered(Table(texts("FMU", "verdict"), overview)),
        rendered(Table((*texts("verdict"), *numbers("cases"), *texts("meaning")), legend)),
    ]
    if any(one.axis != RANDOM for result in results for one in result.verdicts):
        parts.append(
            "<p>A cell of a grid has the largest deviation of a case over the allowed one. Point "
            "at it for its checks.</p>"
        )
    parts += [part for result in results for part in _of_one_fmu(result)]
    write_page(path, "Stress test", [*parts, provenance_html(provenance)])


def _of_one_fmu(result: StressResult) -> list[str]:
    parts = [f"<h2>{escaped(Path(result.fmu).name)}</h2>"]
    parts += [f"<p>{escaped(line)}</p>" for line in result.summary.splitlines()]
    for name in (FAILED, *(other for other in MEANINGS if other not in (PASSED, FAILED))):
        chosen = [one for one in result.verdicts if one.verdict == name]
        if chosen:
            anchor = f"{name}-{Path(result.fmu).name}".replace(" ", "-")
            heading, count = name.capitalize(), number_of(len(chosen), "case")
            others: list[Row] = [(one.name, one.reason, one.command(result.fmu)) for one in chosen]
            table = rendered(Table(texts("case", "reason", "run it again"), others))
            parts.append(section(anchor, heading, count, table, unfolded=name == FAILED))
    for axis in dict.fromkeys(one.axis for one in result.verdicts if one.axis != RANDOM):
        parts.append(_grid(axis, [one for one in result.verdicts if one.axis == axis]))
    return parts


def _grid(axis: str, cases: Sequence[Verdict]) -> str:
    """Return a table of values over models."""
    models = [name for name in map(name_of, MODELS) if any(one.model == name for one in cases)]
    cells = {(one.value, one.model): _cell(one) for one in cases}
    rows = [
        (value, *(cells.get((value, model), "") for model in models))
        for value in dict.fromkeys(one.value for one in cases)
    ]
    grid = rendered(Table((*texts("value"), *numbers(*models)), rows))
    return f"<h3>{escaped(axis)}</h3>{grid}"


def _cell(one: Verdict) -> Cell:
    """Return a case with its checks as note: by its margin where it passed."""
    text, style = f"{one.nearest.found:.1g}" if one.nearest else "0", Style.PLAIN
    if one.verdict != PASSED:
        text, style = ("FAIL", Style.FAIL) if one.verdict == FAILED else ("refused", Style.NOTE)
    lines = [f"{one.verdict}: {one.reason}" if one.reason else one.verdict]
    for check in sorted(one.checks, key=lambda check: -check.found):
        lines.append(f"{check.name}: {check.found:.2g} of what is allowed")
    return Cell(text, style, note="\n".join(lines))


def write_results(results: Sequence[StressResult], folder: Path, provenance: Provenance) -> None:
    """Write stress.json and index.html; HarnessError when that is impossible."""
    write_text(folder / "stress.json", to_json(as_plain(results), provenance))
    write_stress_page(folder / "index.html", results, provenance)


def as_plain(results: Sequence[StressResult]) -> dict[str, object]:
    """Return the results for JSON."""
    return {
        "passed": all(result.passed for result in results),
        "fmus": [
            {
                "fmu": result.fmu,
                "passed": result.passed,
                "cases": len(result.verdicts),
                "skipped": result.skipped,
                "not_run": result.not_run,
                "counts": result.counts,
                "wall_time": result.wall_time,
                "worst_step_over_period_cost": worst and worst.cost_ratio,
                "worst_step_case": worst and worst.name,
                "worst": {model: case.name for model, (case, _) in result.nearest.items()},
                "verdicts": result.verdicts,
            }
            for result in results
            for worst in [result.most_expensive]
        ],
    }


def values_of(case: Case) -> str:
    """Return the values of a case, in lines."""
    lines = [f"  {case.name}:"]
    lines += [f"    {name} = {value!r}" for name, value in case.settings.items()]
    lines.append(
        f"    {len(case.sizes)} steps of {case.sizes.min():.3g} to {case.sizes.max():.3g} s from "
        f"{case.start_time:g} s on"
    )
    for held in case.held:
        inputs = {name: getattr(held, name) for name in INPUTS} | dict(held.tuned)
        words = ", ".join(f"{name} = {value!r}" for name, value in inputs.items())
        lines.append(f"    from {held.start!r} s on: {words}")
    return "\n".join(lines)
