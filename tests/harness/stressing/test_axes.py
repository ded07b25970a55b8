from __future__ import annotations

from collections import Counter

import pytest

from slider_resonator.device.model import Model
from slider_resonator.stressing.axes import CHEAP, axis_cases
from slider_resonator.stressing.case import MODELS, Case, Hold

AXES = {
    "Omega": {f"1e{n}" for n in range(1, 8)},
    "q": {f"1e{n}" for n in range(-6, 4)},
    "alpha": {"0", "1", "1 - 1e-12", "1 + 1e-12", "100"},
    "mu": {"0", "1e-09", "10"},
    "r_m": {"1e-12", "1 - 1e-9"},
    "xi": {"0", "1e-12", "1", "100"},
    "resonance": {
        f"{cause} {where} {mode}, xi {xi}"
        for cause in ("drive", "load")
        for where in ("at", "1 ulp below", "1 ulp above")
        for mode in ("stick", "slip")
        for xi in ("0", "1e-12")
    },
    "critical damping": {
        f"{where} {mode}"
        for where in ("at", "1 ulp below", "1 ulp above")
        for mode in ("stick", "slip")
    },
    "frequency ratio": {
        *("0", "1 - 1e-12", "1 + 1e-12", "1e-6", "100", "-1", "pi", "changes every step"),
    },
    "blocking load": {"1 - 1e-12", "1", "1 + 1e-12"},
    "load at full friction": {"1 - 1e-12", "1", "1 + 1e-12"},
    "bristle stiffness": {f"1e{n}" for n in range(-3, 15)},
    "bristle damping": {"0", "1e6"},
    "tolerance": {f"1e{n}" for n in range(-14, -1)},
    "communication step": {
        *(f"1e{n} s" for n in range(-12, 5)),
        *("smallest denormal", "random, 1e-12 to 1e-2 s", "10 periods and 1e-15 s in turn"),
    },
    "start time": {"1e12 s"},
    "drive periods": {"1e+08"},
    "grazing release": {"peak below the limit", "peak at the limit", "peak above the limit"},
    "simultaneous": {"drive peaks where the load vanishes", "no force at all"},
    "inputs jump every step": {"seed 1"},
    "beat against step": {"1 beat", "90 beats", "1/3 beat"},
    "start in flight": {"ratio 0.01", "ratio -0.003", "ratio 1e-06"},
    "late jump": {"phase", "load", "frequency_ratio"},
    "neutral motions": {"ratio 2", "ratio 4"},
    "overflow": {"friction_coefficient 1e+308", "resonator_mass 1e+300"},
}
"""The values that every axis must have at least."""


@pytest.mark.parametrize("axis", AXES)
def test_every_value_is_there(axis: str) -> None:
    assert {case.value for case in axis_cases() if case.axis == axis} >= AXES[axis]


def test_every_device_is_run_by_every_model_that_covers_it() -> None:
    for axis in (
        "beat against step",
        "start in flight",
        "late jump",
        "overflow",
        "Omega",
        "q",
        "alpha",
        "mu",
        "r_m",
        "xi",
        "neutral motions",
        "frequency ratio",
    ):
        counts = Counter(case.value for case in axis_cases() if case.axis == axis)
        assert set(counts.values()) == {len(MODELS)}, axis
    for axis in ("resonance", "communication step", "grazing release"):
        counts = Counter(case.value for case in axis_cases() if case.axis == axis)
        assert set(counts.values()) == {len(CHEAP)}, axis


def test_long_runs_are_asked_for() -> None:
    added = {case.name for case in axis_cases(long=True)} - {case.name for case in axis_cases()}
    assert added == {
        *(f"drive periods: 1e+08: Coulomb, fidelity {n}" for n in (1, 2)),
        *(f"drive periods: 1e+06: LuGre, fidelity {n}" for n in (1, 2)),
    }


def test_names_are_unique() -> None:
    counts = Counter(case.name for case in axis_cases(long=True))
    assert [name for name, count in counts.items() if count > 1] == []


def test_other_steps_cover_the_same_times() -> None:
    for case in axis_cases():
        total = sum(hold.size * hold.count for hold in case.holds)
        other = sum(hold.size * hold.count for hold in case.other_holds)
        assert abs(other - total) <= 1e-12 * total, case.name
        assert case.other_holds != case.holds, case.name


def test_steps_that_cannot_be_cut_are_kept() -> None:
    case = Case("step", "denormal", Model(2, 0), {}, (Hold(5e-324), Hold(1e-3)))
    assert [hold.count for hold in case.other_holds] == [1, 3]
