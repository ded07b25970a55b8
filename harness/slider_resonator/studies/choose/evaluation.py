"""A candidate with its estimated errors, against those allowed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, isfinite

from slider_resonator.studies.choose.candidate import Candidate
from slider_resonator.studies.choose.errors import ErrorEstimate

MARGIN = 0.98
"""Largest share of an allowed error that an estimate may take."""


@dataclass(frozen=True)
class Evaluation:
    """A candidate with its estimated errors and its cost."""

    candidate: Candidate
    estimates: Mapping[str, ErrorEstimate]
    allowed: Mapping[str, float]
    cost: float

    @property
    def excess(self) -> float:
        """The largest error over the allowed one, with the margin."""
        return self._share(self.worst) / MARGIN

    @property
    def worst(self) -> str:
        """The need that is farthest from being met."""
        return max(self.estimates, key=self._share)

    @property
    def why(self) -> str:
        """The worst error in words."""
        estimate, allowed = self.estimates[self.worst], self.allowed[self.worst]
        if isfinite(estimate.error):
            return f"{self.worst} is off by {estimate.error:.3g}, must be at most {allowed:.3g}"
        return f"{self.worst}: {estimate.reason}"

    def _share(self, name: str) -> float:
        """Return an error over the allowed one; a relative one of 0 allows 0 only."""
        error, allowed = self.estimates[name].error, self.allowed[name]
        return error / allowed if allowed > 0.0 else inf if error > 0.0 else 0.0
