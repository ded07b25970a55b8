"""A candidate that was tried: its errors against what is allowed of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, isfinite

from slider_resonator.studies.choose.candidate import Candidate
from slider_resonator.studies.choose.errors import Wrong

MARGIN = 0.98
"""Share of an allowed error that a prediction may take."""


@dataclass(frozen=True)
class Tried:
    """A candidate with what it gets wrong and costs."""

    candidate: Candidate
    wrong: Mapping[str, Wrong]
    allowed: Mapping[str, float]
    cost: float

    @property
    def excess(self) -> float:
        """The largest error over what is allowed of it, with the margin."""
        return self._share(self.worst) / MARGIN

    @property
    def worst(self) -> str:
        """The need that is farthest from being met."""
        return max(self.wrong, key=self._share)

    @property
    def why(self) -> str:
        """The worst error in words."""
        wrong, allowed = self.wrong[self.worst], self.allowed[self.worst]
        if isfinite(wrong.error):
            return f"{self.worst} is off by {wrong.error:.3g}, must be at most {allowed:.3g}"
        return f"{self.worst}: {wrong.reason}"

    def _share(self, name: str) -> float:
        """Return an error over what is allowed; a relative one of 0 allows 0 only."""
        error, allowed = self.wrong[name].error, self.allowed[name]
        return error / allowed if allowed > 0.0 else inf if error > 0.0 else 0.0
