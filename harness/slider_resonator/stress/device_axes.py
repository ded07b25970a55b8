"""The axes that are properties of the device, each around table 1."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import nextafter, sqrt, tau

from slider_resonator.stress.case import (
    CHEAP,
    CHEAP_LUGRE,
    LUGRE,
    MODELS,
    RESOLVED,
    Hold,
    MatrixCell,
    Model,
)

W = 3500.0
AMPLITUDE = 1e-4
MASS = 1.1
Q = 1.301353
"""q of table 1; it is proportional to the base amplitude."""
NEAR_ONE = 1e-12

Values = Sequence[tuple[str, Mapping[str, float]]]


def device_cells() -> Iterator[MatrixCell]:
    """Yield the cells of all axes that are parameters of the device."""
    for axis, values, models in (
        ("Omega", _frequencies(), MODELS),
        ("q", _amplitudes(), MODELS),
        ("alpha", _load_variations(), MODELS),
        ("mu", _frictions(), MODELS),
        ("r_m", _mass_ratios(), MODELS),
        ("xi", _dampings(), MODELS),
        ("resonance", _resonances(), CHEAP),
        ("critical damping", _critical(), RESOLVED),
        ("bristle stiffness", _decades("bristle_stiffness", -3, 14), LUGRE),
        ("bristle damping", [("0", {"bristle_damping": 0.0}), *_decades("bristle_damping", -2, 6)],
         CHEAP_LUGRE),
        ("tolerance", _decades("tolerance", -14, -2), CHEAP_LUGRE),
    ):  # fmt: skip
        for value, parameters in values:
            for model in models:
                yield MatrixCell(axis, value, model, parameters, usual_holds(model, parameters))


def usual_holds(model: Model, parameters: Mapping[str, float]) -> tuple[Hold, ...]:
    """Return steps that show the motion: resolved 32 a period, averaged one in ten periods.

    Steps of averages of second order are long enough for leaps, their runs short enough for a
    resolved reference.
    """
    period = tau / parameters.get("drive_frequency", W)
    if model.fidelity == 0:
        return (Hold(120.0 * period, 4) if model.second_order else Hold(10.0 * period, 100),)
    return (Hold(period / 32.0, 160),)


def _decades(name: str, first: int, last: int) -> Values:
    return [(f"1e{n}", {name: float(f"1e{n}")}) for n in range(first, last + 1)]


def _frequencies() -> Values:
    """Tuned, and with q of table 1 at each frequency."""
    return [
        (
            f"1e{n}",
            {
                "drive_frequency": 10.0**n,
                "resonator_frequency": 10.0**n,
                "base_amplitude": AMPLITUDE * W / 10.0**n,
            },
        )
        for n in range(1, 8)
    ]


def _amplitudes() -> Values:
    return [(f"1e{n}", {"base_amplitude": AMPLITUDE * 10.0**n / Q}) for n in range(-6, 4)]


def _load_variations() -> Values:
    one = {"1 - 1e-12": 1.0 - NEAR_ONE, "1": 1.0, "1 + 1e-12": 1.0 + NEAR_ONE}
    alphas = {"0": 0.0, **one, "1 + 1 ulp": nextafter(1.0, 2.0), "2": 2.0, "100": 100.0}
    values = [(text, {"normal_amplitude": alpha}) for text, alpha in alphas.items()]
    return [*values, ("infinite", {"normal_preload": 0.0})]


def _frictions() -> Values:
    return [(f"{mu:g}", {"friction_coefficient": mu}) for mu in (0.0, 1e-9, 1e-3, 1.0, 10.0)]


def _mass_ratios() -> Values:
    """The total mass is kept."""
    shares = {f"1e{n}": (10.0**n, 1.0 - 10.0**n) for n in (-12, -9, -6, -3)}
    shares |= {f"1 - 1e{n}": (1.0 - 10.0**n, 10.0**n) for n in (-1, -3, -6, -9)}
    values = [
        (text, {"resonator_mass": MASS * resonator, "slider_mass": MASS * slider})
        for text, (resonator, slider) in shares.items()
    ]
    return [*values, ("0", {"resonator_mass": 0.0})]


def _dampings() -> Values:
    return [(f"{xi:g}", {"damping_ratio": xi}) for xi in (0.0, 1e-12, 0.999, 1.0, 1.5, 10.0, 100.0)]


def _around(value: float) -> Iterator[tuple[str, float]]:
    yield "at", value
    yield "1 ulp below", nextafter(value, 0.0)
    yield "1 ulp above", nextafter(value, 2.0 * value)


def _resonances() -> Values:
    """The drive, or the normal load at twice its frequency, at a resonance without damping."""
    slip = 1.0 / sqrt(1.0 - 0.1 / MASS)
    found = []
    for mode, factor in (("stick", 1.0), ("slip", slip)):
        for cause, turns in (("drive", 1.0), ("load", 2.0)):
            for where, w in _around(turns * W / factor):
                for xi in (0.0, 1e-12):
                    parameters = {"damping_ratio": xi, "resonator_frequency": w}
                    found.append((f"{cause} {where} {mode}, xi {xi:g}", parameters))
    return found


def _critical() -> Values:
    """xi = 1 is critical in stick, xi = (1 - r_m)^(1/2) in slip."""
    slip = sqrt(1.0 - 0.1 / MASS)
    return [
        (f"{where} {mode}", {"damping_ratio": xi})
        for mode, critical in (("stick", 1.0), ("slip", slip))
        for where, xi in _around(critical)
    ]
