"""ModelStructure against what the FMU does: nothing may act that is not declared."""

from __future__ import annotations

import math
from collections.abc import Iterable

import pytest
from fmpy.model_description import Unknown

from tests.fmu.host import OUTPUTS, Instance, Instantiate, Unpacked
from tests.fmus import both_fmus

pytestmark = both_fmus

SITUATIONS: dict[str, dict[str, float]] = {
    "at rest": {},
    "sliding": {"initial_velocity": 0.3, "tangential_force": 2.0, "load": 0.1},
    "resonator released": {
        "initial_resonator_displacement": 1e-3,
        "initial_resonator_velocity": -0.2,
        "phase": 0.5,
    },
    "held by friction": {"initial_resonator_displacement": 1e-9, "phase": 0.5, "load": 0.02},
    "lifted": {"normal_amplitude": 3.0, "phase": -1.5, "initial_velocity": -0.1},
    "about to touch": {"normal_preload": 0.0, "initial_velocity": 0.1},
    "one degree of freedom": {"fidelity": 1, "load": 0.03, "phase": 1.0},
    "one degree of freedom, held": {"fidelity": 1, "base_amplitude": 1e-9, "load": 0.03},
    "bristles": {"friction_law": 1, "phase": 0.2},
    "bristles, sliding": {"friction_law": 1, "initial_velocity": 0.2, "phase": 0.2},
    "third multiple": {"frequency_ratio": 3.0, "phase": 1.5, "load": -0.01},
}
OTHER_VALUES: dict[str, float] = {
    "phase": 0.9,
    "load": 0.045,
    "frequency_ratio": -1.0,
    "amplitude_deviation": 0.3,
    "frequency_deviation": 0.05,
    "slider_mass": 1.7,
    "resonator_mass": 0.25,
    "resonator_frequency": 3100.0,
    "damping_ratio": 0.21,
    "normal_preload": 1.3,
    "normal_amplitude": 0.8,
    "base_amplitude": 2.3e-4,
    "drive_frequency": 3900.0,
    "tangential_force": 5.0,
    "friction_coefficient": 0.17,
    "friction_faces": 1,
    "averaging_order": 1,
    "bristle_stiffness": 3e5,
    "bristle_damping": 3.0,
    "tolerance": 1e-6,
    "initial_position": 0.01,
    "initial_velocity": 0.2,
    "initial_resonator_displacement": 2e-3,
    "initial_resonator_velocity": 0.7,
    "initial_bristle_deflection": 1e-6,
}

INPUTS = ("phase", "load", "frequency_ratio", "amplitude_deviation", "frequency_deviation")


def dependencies(unknowns: Iterable[Unknown]) -> dict[str, set[str]]:
    return {u.variable.name: {v.name for v in u.dependencies} for u in unknowns}


def initial_outputs(instance: Instance, values: dict[str, float]) -> dict[str, float]:
    instance.slave.reset()
    instance.initialize(**values)
    return dict(zip(OUTPUTS, instance.get(*OUTPUTS), strict=True))


@pytest.mark.parametrize("situation", SITUATIONS)
def test_initial_unknowns_declare_all_that_acts(
    unpacked: Unpacked, instance: Instance, situation: str
) -> None:
    declared = dependencies(unpacked.description.initialUnknowns)
    values = SITUATIONS[situation]
    before = initial_outputs(instance, values)
    for name, other in OTHER_VALUES.items():
        after = initial_outputs(instance, values | {name: other})
        acted_on = {output for output in OUTPUTS if after[output] != before[output]}
        undeclared = sorted(o for o in acted_on if name not in declared[o])
        assert undeclared == [], f"{name} acts on {undeclared} at the start without being declared"


def test_every_settable_number_is_tried(unpacked: Unpacked) -> None:
    settable = {v.name for v in unpacked.description.modelVariables if v.causality != "output"}
    assert settable == set(OTHER_VALUES) | {"fidelity", "friction_law"}


@pytest.mark.parametrize("situation", SITUATIONS)
def test_outputs_declare_every_input_that_acts_at_once(
    unpacked: Unpacked, instantiate: Instantiate, situation: str
) -> None:
    declared = dependencies(unpacked.description.outputs)
    instance = instantiate().initialize(**SITUATIONS[situation])
    for _ in range(14):  # a little more than a period
        instance.step(1.37e-4)
        for name in INPUTS:
            (kept,) = instance.get(name)
            before = instance.get(*OUTPUTS)
            instance.set(**{name: OTHER_VALUES[name]})
            after = instance.get(*OUTPUTS)
            instance.set(**{name: kept})
            acted_on = {o for o, x, y in zip(OUTPUTS, before, after, strict=True) if x != y}
            undeclared = sorted(o for o in acted_on if name not in declared[o])
            assert undeclared == [], f"{name} acts on {undeclared} without a step"


def test_phase_acts_on_the_normal_force_at_once(instance: Instance) -> None:
    instance.step(1e-3)
    instance.set(phase=0.9)
    expected = 1.0 + math.sin(3500.0 * 1e-3 + 0.9)
    assert instance.get("normal_force") == pytest.approx((expected,), rel=1e-12)
