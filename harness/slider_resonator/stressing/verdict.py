"""The verdict on a case and the bounds behind it."""

import re
import shlex
from dataclasses import dataclass

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.interface import INPUTS, PARAMETERS
from slider_resonator.stressing.case import Case, name_of

PASSED = "passed"
REFUSED = "refused by name"
FAILED = "failed"
SENSITIVE = "sensitive"
NO_REFERENCE = "no reference"
"""Also the name of the check that reports why a reference gave up."""
REFERENCE = "reference"
"""Name of the check against a reference that shares no code with the FMU."""
MEANINGS = {
    PASSED: "all is within its bounds",
    REFUSED: "the FMU refused it, with name, value and what it must be",
    FAILED: "a bound is broken, or the FMU crashed or hung",
    SENSITIVE: "a random device whose reference, with values off by the allowed error, is as far",
    NO_REFERENCE: "a random device whose reference could not follow the motion",
}
"""Verdict to what it means."""

_NAMES = "|".join([*PARAMETERS, *INPUTS, "communicationStepSize"])
_NAMED = re.compile(rf"\b({_NAMES}) = (\S+) refused\b.*\bmust ")


@dataclass(frozen=True)
class BoundCheck:
    """One bound: the largest deviation found, in units of the allowed one.

    `is_deviation` is false for counts and yes-or-no answers, which have no distance to a bound.
    """

    name: str
    found: float
    words: str = ""
    is_deviation: bool = True

    @property
    def passed(self) -> bool:
        """Whether the bound holds; it does not for NaN."""
        return self.found <= 1.0


def largest(name: str, off: Array, allowed: float | Array, what: str = "") -> BoundCheck:
    """Return the check of the largest deviation `off`, of `what`; where 0 is allowed, it must be 0.

    NaN breaks the bound.
    """
    off = np.abs(np.asarray(off, dtype=float))
    shares = np.nan_to_num(off / np.maximum(allowed, np.finfo(float).tiny), nan=np.inf)
    found = float(shares.max())
    words = f"{what} off by up to {off.max():.3g}, {found:.3g} times the allowed"
    return BoundCheck(name, found, words.lstrip())


@dataclass(frozen=True)
class Verdict:
    """The verdict on one case, the bounds behind it, and the reason where it did not pass."""

    axis: str
    value: str
    model: str
    verdict: str
    reason: str = ""
    checks: tuple[BoundCheck, ...] = ()
    worst_step: float = 0.0
    period_cost: float = 0.0

    @property
    def name(self) -> str:
        """Axis, value and model, as of the case."""
        return f"{self.axis}: {self.value}: {self.model}"

    @property
    def cost_ratio(self) -> float:
        """Worst cost of a step, per period it spans (at least 1), relative to a period."""
        return self.worst_step / self.period_cost if self.period_cost > 0.0 else 0.0

    @property
    def nearest(self) -> BoundCheck | None:
        """The deviation that is nearest to its bound, or farthest beyond it."""
        deviations = [check for check in self.checks if check.is_deviation]
        return max(deviations, key=lambda check: check.found, default=None)

    def command(self, fmu: str) -> str:
        """Return the command that runs the case again and prints its values."""
        return shlex.join(("slider-resonator", "stress", fmu, "--case", self.name))


def verdict_on(case: Case, verdict: str, reason: str = "") -> Verdict:
    """Return a verdict on a case without checks: a refusal, a crash, an exceeded limit."""
    return Verdict(case.axis, case.value, name_of(case.model), verdict, reason)


def refused_by_name(case: Case, text: str) -> bool:
    """Return whether a refusal names a variable or the step, its value and the requirement."""
    found = _NAMED.search(text)
    if found is None:
        return False
    name, value = found.groups()
    if name == "communicationStepSize":
        present = {hold.size for hold in (*case.holds, *case.other_holds)} | {case.period}
    elif name in INPUTS:
        present = {float(getattr(hold, name)) for hold in case.holds}
    else:
        first = float(getattr(case.device, name))
        present = {dict(hold.tuned).get(name, first) for hold in case.holds}
    return any(value == repr(one) for one in present)
