"""Several validations of one FMU: whether verdicts and numbers are the same each time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from slider_resonator.checks.compare import Check
from slider_resonator.checks.validate import Validation


@dataclass(frozen=True)
class Repeated:
    """What came of validating an FMU several times.

    `worst` is the first of the worst runs; `verdicts` counts the runs by exit code 0, 1, 2;
    `unsteady` are the checks of the first run that gave other numbers in a later one.
    """

    worst: Validation
    verdicts: tuple[int, int, int]
    unsteady: tuple[Check, ...]

    @property
    def sentence(self) -> str:
        """Say how the runs ended, and whether all gave the same numbers."""
        passed, failed, broken = self.verdicts
        said = [f"{passed} passed", f"{failed} failed", f"{broken} could not be run"]
        ended = ", ".join(text for text, count in zip(said, self.verdicts, strict=True) if count)
        names = dict.fromkeys(f"{check.scene}: {check.quantity}" for check in self.unsteady)
        same = f"other numbers in {', '.join(names)}" if names else "the same numbers in all"
        return f"{self.worst.fmu}: of {sum(self.verdicts)} runs {ended}; {same}"


def repeated(runs: Sequence[Validation]) -> Repeated:
    """Return what several validations of one FMU, at least one, come to."""
    codes = [run.exit_code for run in runs]
    worst = max(runs, key=lambda run: (run.exit_code, sum(not c.passed for c in run.checks)))
    results = [{_place(check): _numbers(check) for check in run.checks} for run in runs]
    unsteady = [
        check for check in runs[0].checks if any(_differ(other, check) for other in results[1:])
    ]
    return Repeated(worst, (codes.count(0), codes.count(1), codes.count(2)), tuple(unsteady))


def _place(check: Check) -> tuple[object, ...]:
    return check.scene, tuple(check.at.items()), check.quantity, check.against, check.why


def _numbers(check: Check) -> str:
    """Return what was measured, as text, in which what is no number equals itself."""
    return repr((check.fmu, check.deviation))


def _differ(results: Mapping[tuple[object, ...], str], check: Check) -> bool:
    """Whether a check gave other numbers in another run; what was not judged there is the same."""
    numbers = _numbers(check)
    return results.get(_place(check), numbers) != numbers
