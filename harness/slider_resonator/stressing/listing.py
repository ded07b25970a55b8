"""The result in words, as plain data and as files."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path

from slider_resonator.device.interface import INPUTS
from slider_resonator.fmu.provenance import Provenance
from slider_resonator.output.atomic import write_text
from slider_resonator.output.json_output import to_json
from slider_resonator.output.targets import make_folder
from slider_resonator.stressing.case import Case
from slider_resonator.stressing.page import write_stress_page
from slider_resonator.stressing.run import StressResult


@dataclass(frozen=True)
class Files:
    """What to write: the result as JSON, and the page; in a folder, where both are in one."""

    json: Path | None = None
    page: Path | None = None
    folder: Path | None = None

    @property
    def names(self) -> list[str]:
        """The folder, or else the files."""
        paths = [self.folder] if self.folder else [self.json, self.page]
        return [str(path) for path in paths if path is not None]


def in_folder(folder: Path, name: str) -> Files:
    """Return the files in a folder: NAME.json and index.html."""
    return Files(folder / f"{name}.json", folder / "index.html", folder)


def write_files(results: Sequence[StressResult], files: Files, provenance: Provenance) -> None:
    """Write what is asked for; HarnessError when that is impossible."""
    if files.folder is not None:
        make_folder(files.folder)
    if files.json is not None:
        write_text(files.json, to_json(as_plain(results), provenance))
    if files.page is not None:
        write_stress_page(files.page, results, provenance)


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
