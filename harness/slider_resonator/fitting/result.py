"""What a fit found: estimates with their intervals, and what there is to say of them."""

from dataclasses import dataclass
from math import exp, isfinite, log10
from typing import TYPE_CHECKING, Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.fitting.estimation import OpenDirection
from slider_resonator.fitting.measurements import Measurements, shown
from slider_resonator.output.readable import number_of
from slider_resonator.output.shown import Drawable, Shown, Tabular

if TYPE_CHECKING:
    from matplotlib.figure import Figure


AS_STATED = 2.0
"""Residual, in stated standard deviations, up to which model and deviations count as fitting."""


@dataclass(frozen=True)
class FittedParameter:
    """An estimate in SI units with its standard deviation and 95 % profile interval.

    They are None where the data have no numbers to spare for them, or leave the parameter open. An
    end alone is None where the interval is unbounded on that side.
    """

    name: str
    unit: str
    start: float
    value: float
    deviation: float | None
    low: float | None
    high: float | None
    is_open: bool
    at_bound: bool = False

    def texts(self, is_solved: bool) -> tuple[str, str, str]:
        """Return estimate and both ends as text, in the digits that the interval gives them.

        Ends are "0.1" and "0.2", "above 0.1" and "", or two empty ones. An estimate without an
        interval has more digits where as many numbers as parameters are solved.
        """
        if self.is_open:
            return "left open", "", ""
        if self.deviation is None:
            return f"{self.value:.{8 if is_solved else 3}g}", "", ""
        if self.low is None and self.high is None:
            return f"{self.value:.3g}", "unbounded", ""
        if self.high is None:
            return f"{self.value:.3g}", f"above {self.low:.2g}", ""
        if self.low is None:
            return f"{self.value:.3g}", "", f"below {self.high:.2g}"
        width = max((self.high - self.low) / abs(self.value or 1.0), 1e-9)
        digits = max(2, 2 - round(log10(width)))
        return f"{self.value:.{digits + 1}g}", f"{self.low:.{digits}g}", f"{self.high:.{digits}g}"


@dataclass(frozen=True, repr=False)
class Fit(Shown, Tabular, Drawable):
    """The result of a fit.

    `residuals` are predicted minus measured over the standard deviation, `scale` the standard
    deviation of these as the fit shows it, 1 if all is as stated, None with as many parameters as
    numbers. `correlation` is that of the estimates, (p, p). `starts_agreeing` of `starts` led to
    the same minimum. `unmet` are the indices of numbers that as many parameters do not reach,
    `notes` what is odd about the data and their residuals.
    """

    parameters: tuple[FittedParameter, ...]
    device: Device
    open_directions: tuple[OpenDirection, ...]
    correlation: Array
    measured: Array
    predicted: Array
    residuals: Array
    scale: float | None
    starts: int
    starts_agreeing: int
    evaluations: int
    measurements: Measurements
    unmet: tuple[int, ...] = ()
    notes: tuple[str, ...] = ()

    def table(self) -> dict[str, list[Any]]:
        """Return the estimates in columns, those that the data leave open as None."""
        others = ("unit", "start", "deviation", "low", "high")
        return {
            "parameter": [one.name for one in self.parameters],
            "value": [None if one.is_open else one.value for one in self.parameters],
            **{name: [getattr(one, name) for one in self.parameters] for name in others},
        }

    def figure(self) -> "Figure":
        """Draw data and fit, with the residuals below."""
        # Imported here: drawing takes longer to load than many fits to run.
        from slider_resonator.fitting.picture import fit_figure

        numbers = np.array([self.measured, self.predicted, self.residuals])
        return fit_figure(self.measurements.points, numbers)

    def describe(self) -> list[str]:
        """Return the estimates with their intervals, and what there is to say of them."""
        lines = []
        for one in self.parameters:
            value, low, high = one.texts(self.scale is None)
            ends = f"from {low} to {high}" if low and high else low + high
            unit = "" if one.is_open else f" {one.unit}"
            lines.append(f"{one.name:<23} {value}{unit}{', 95 % ' if ends else ''}{ends}")
        return [*lines, *self.sentences()]

    def sentences(self) -> list[str]:
        """Return what there is to say beside the estimates."""
        lines = [
            f"{number_of(len(self.measured), 'number')}, "
            f"{number_of(len(self.parameters), 'free parameter')}",
            f"friction on {number_of(self.device.friction_faces, 'face')} (friction_faces)",
        ]
        if self.scale is None:
            solved = "not solved" if self.unmet else "solved, without intervals"
            lines.append(f"as many parameters as numbers: {solved}")
        elif self.measurements.knows_deviations:
            odd = ": the model or the stated deviations do not fit"
            lines.append(
                f"residuals have {self.scale:.3g} times the stated standard deviation"
                f"{odd if self.scale > AS_STATED else ''}"
            )
        for index in self.unmet:
            one = self.measurements.points[index]
            name, reached = one.quantity, self.predicted[index]
            asked = f"{name} ({one.source}, {one.row}) must be {shown(name, one.measured)}"
            found = f"the nearest found is {shown(name, reached)}"
            nearest = found if isfinite(reached) else "but no steady motion was found"
            lines.append(f"not met: {asked}, {nearest}")
        for name, size in self.measurements.root_mean_squares(self.predicted - self.measured):
            lines.append(f"{name} is off by {shown(name, size)} (rms)")
        missing = int(np.count_nonzero(~np.isfinite(self.predicted)))
        if missing:
            lines.append(f"at {missing} of the points the fitted device has no steady motion")
        for direction in self.open_directions:
            names = direction.factors
            parts = ", ".join(f"{name} x {exp(0.1 * part):.3g}" for name, part in names.items())
            reach = "hardly" if isfinite(direction.spread) else "do not"
            lines.append(
                f"the data {reach} determine {' and '.join(names)}: {parts} changes little"
            )
        lines.append(f"{self.starts_agreeing} of {self.starts} starts led to this minimum")
        at_bound = [one.name for one in self.parameters if one.at_bound]
        if at_bound:
            lines.append(f"at a bound: {', '.join(at_bound)}")
        return [*lines, *(f"note: {note}" for note in self.notes)]
