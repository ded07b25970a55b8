"""The result in words, as plain data and as files."""

from collections.abc import Sequence
from itertools import accumulate
from pathlib import Path

from slider_resonator.device.interface import INPUTS
from slider_resonator.fmu.provenance import Provenance
from slider_resonator.output.atomic import write_text
from slider_resonator.output.json_output import to_json
from slider_resonator.stressing.case import Case
from slider_resonator.stressing.page import write_stress_page
from slider_resonator.stressing.run import StressResult


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
                "worst_step_over_period_cost": result.most_expensive
                and result.most_expensive.cost_ratio,
                "worst_step_case": result.most_expensive and result.most_expensive.name,
                "worst": {model: case.name for model, case in result.nearest.items()},
                "verdicts": result.verdicts,
            }
            for result in results
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
    before: dict[str, float] = {}
    starts = accumulate((hold.duration for hold in case.holds), initial=0.0)
    for start, hold in zip(starts, case.holds, strict=False):
        now = dict(zip(INPUTS, hold.inputs, strict=True)) | dict(hold.tuned)
        if now != before:
            words = ", ".join(f"{name} = {value!r}" for name, value in now.items())
            lines.append(f"    from {start!r} s on: {words}")
        before = now
    return "\n".join(lines)
