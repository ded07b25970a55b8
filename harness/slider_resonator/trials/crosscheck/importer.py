"""The exported tree as an importing tool sees it: through the cross-check code of FMPy."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import fmpy
from fmpy.cross_check.validate_vendor_repo import validate_test_fmu
from fmpy.util import read_csv, read_ref_opt_file, validate_result

MOST_OUTLIERS = 0.0
"""Share of points outside FMPy's tube: this is the run that the reference was made of."""


@dataclass(frozen=True)
class Imported:
    """What came of one exported folder: all `problems`, and whether it could be simulated here.

    `outliers` is the largest share of points outside FMPy's tube, None where nothing was run.
    """

    folder: Path
    problems: tuple[str, ...]
    outliers: float | None = None

    @property
    def passed(self) -> bool:
        """True when nothing is wrong with the files, and with the run where there was one."""
        return not self.problems


def imported(folder: Path) -> Imported:
    """Check files and model description of a folder and, on its platform, repeat the run."""
    problems = [str(problem) for problem in validate_test_fmu(str(folder))]
    if problems or folder.parents[2].name != fmpy.platform:
        return Imported(folder, tuple(problems))
    name = folder.name
    options = read_ref_opt_file(folder / f"{name}_ref.opt")
    reference = read_csv(folder / f"{name}_ref.csv")
    try:
        result = fmpy.simulate_fmu(
            str(folder / f"{name}.fmu"),
            start_time=options["StartTime"],
            stop_time=options["StopTime"],
            step_size=options["StepSize"],
            output_interval=options["StepSize"],
            input=read_csv(folder / f"{name}_in.csv"),
            output=reference.dtype.names[1:],
        )
    except Exception as error:  # fmpy raises bare Exception
        return Imported(folder, (f"{name}.fmu cannot be simulated: {error}",))
    outliers = float(validate_result(result, reference, options["StopTime"]))
    if outliers > MOST_OUTLIERS:
        problems.append(f"{name}_ref.csv: {outliers:.2%} of a run's points are outside FMPy's tube")
    return Imported(folder, tuple(problems), outliers)
