"""The verdict of a check in a sentence: deviation, tolerance and time."""

from collections.abc import Mapping

from slider_resonator.checks.compare import AT_LEAST, AT_MOST, Check, Value
from slider_resonator.output.readable import readable
from slider_resonator.scenes.vocabulary import QUANTITIES

TITLE = "Slider-resonator validation"
"""Default title of a report."""
DIGITS = 9
CALLED: Mapping[str, str] = {
    "located_events": "events",
    "bristle_state": "bristles",
    "averaged": "averages",
    "closed_form": "formula",
}
"""References, by what tables call them, in 8 letters: a log has room for no more."""


def title(check: Check) -> str:
    """Return the quantity, its reference, the tube and the point of the sweep."""
    tube = "" if check.tube is None else f" in a tube of {check.tube:g} periods"
    return f"{check.quantity} against {check.against}{tube}{place(check.at, ' at ')}"


def measure_of(check: Check) -> str:
    """Return what `deviation` and `allowed` of a check are counted in: a unit, or a share."""
    quantity = QUANTITIES[check.quantity]
    if quantity.kind != "signal":
        return check.unit if check.deviation is not None else ""
    if quantity.exact:
        return "of points"
    if quantity.in_periods:
        return "periods"
    return "of scale" if near_zero(check) else "of peak"


def near_zero(check: Check) -> bool:
    """Return whether the peak of a reference counts as larger than it is."""
    return check.scale is not None and check.scale != check.reference


def sizes(check: Check) -> tuple[float | None, float | None, str]:
    """Return deviation, allowed deviation and what they are counted in, for people to read.

    Shares of a scale that is not the peak would say nothing: these are in the unit of the signal.
    """
    if check.scale is None or check.deviation is None or not near_zero(check):
        return check.deviation, check.allowed, measure_of(check)
    return check.deviation * check.scale, (check.allowed or 0.0) * check.scale, check.unit


def place(at: Mapping[str, float], before: str = "") -> str:
    """Return `before` and the point of a sweep, such as "phase 0.4"; nothing without a sweep."""
    values = ", ".join(f"{name} {value:.10g}" for name, value in at.items())
    return before + values if at else ""


def value_text(value: Value, digits: int, unit: str = "") -> str:
    """Return a value as it is shown, a number with its unit."""
    if value is None:
        return "none"
    return value if isinstance(value, str) else readable(value, digits) + unit


def sentence(check: Check) -> str:
    """Return the deviation of the FMU, its time and its ratio to the tolerance."""
    unit = "" if check.unit in ("", "1") else f" {check.unit}"
    fmu, reference = (value_text(one, DIGITS, unit) for one in (check.fmu, check.reference))
    reason = f": {check.note}" if check.note else ""
    if check.deviation is None or check.allowed is None:
        return f"the FMU gives {fmu}, expected {reference}{reason}"
    times = "must be 0"
    if check.allowed:
        of = unit if near_zero(check) else ""
        times = f"{check.severity:.3g} times the allowed {sizes(check)[1]:.2g}{of}"
    quantity = QUANTITIES[check.quantity]
    if quantity.kind != "signal":
        bound = f"{check.against} " if check.against in (AT_MOST, AT_LEAST) else ""
        off = f"off by {check.deviation:.2g}{unit}, {times}{reason}"
        return f"the FMU gives {fmu}, expected {bound}{reference}: {off}"
    if quantity.exact:
        size = f"differs at {check.deviation:.2%} of the points"
    elif quantity.in_periods:
        size = f"off by {check.deviation:.2g} drive periods"
    else:
        tube = f"a tube of {check.tube:g} drive periods to each side " if check.tube else ""
        size = "outside " + tube if tube else "off "
        if near_zero(check):
            size += f"by {sizes(check)[0]:.2g}{unit}, where the peak is {reference}"
        else:
            size += f"by {check.deviation:.2g} of the peak, which is {reference}"
    if check.first_time is None or check.worst_time is None:
        return f"{size}, {times}"
    then = [value_text(one, DIGITS, unit) for one in (check.fmu_then, check.reference_then)]
    worst = f"{check.worst_time:.9g} s, where the FMU gives {then[0]}, expected {then[1]}"
    return f"{size}, {times}; from {check.first_time:.9g} s on, most at {worst}"
