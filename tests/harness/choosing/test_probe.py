"""The part of a scene that is resolved to confirm a choice."""

from __future__ import annotations

from math import inf

import pytest

from slider_resonator.choosing.candidate import Candidate, Model
from slider_resonator.choosing.coverage import HEAD_PERIODS, SHORT
from slider_resonator.choosing.probe import CAUTION, Probe
from slider_resonator.choosing.resolved_cost import RESOLVED
from slider_resonator.fmu.instance import Instance
from tests.harness.scene_text import scene_of

PERIOD = RESOLVED[2, 0].sliding
"""Cost (s) of a drive period of table 1."""
RUN = "[run]\ndrive_periods = {}\nsteps_per_period = 0.1\n[need]\n{} = {{ rel = 0.1 }}\n"


@pytest.mark.parametrize(
    ("periods", "inputs", "device", "covers"),
    [
        (0.9 * SHORT / PERIOD, "", "", "whole"),
        (1.1 * SHORT / PERIOD, "", "", "windows"),
        (1e6, "load = { ramp = [[0, 0], [100, 0.1]] }", "", "windows"),
        (20_000, "frequency_ratio = 1.01", "", "whole"),
        (1e6, "frequency_ratio = 1.01", "", "beginning"),
        (20_000, "", "damping_ratio = 1e-3", "whole"),
        (1e6, "", "damping_ratio = 1e-3", "beginning"),
        (1e6, "", "base_amplitude = 1e-7", "beginning"),
        (20_000, "", "friction_law = 1\ndamping_ratio = 1e-3", "whole"),
        (2e5, "", "friction_law = 1\ndamping_ratio = 1e-3", "beginning"),
        (350, "", "friction_law = 1\nbristle_stiffness = 1e20\nbase_amplitude = 1e-8", "whole"),
    ],
)
def test_a_scene_is_resolved_in_windows_where_averaged_motion_connects_them(
    instance: Instance, periods: float, inputs: str, device: str, covers: str
) -> None:
    """Not beats that are faster than the windows lie, a long memory, nor friction that sticks."""
    text = f"[inputs]\n{inputs}\n[device]\n{device}\n{RUN.format(periods, 'mean_velocity')}"
    probe = Probe(instance, scene_of(text))
    assert probe.covers == covers
    if covers == "whole":
        assert probe.probed_duration == probe.duration
    else:
        assert probe.probed_duration <= HEAD_PERIODS * probe.scales.period * (1.0 + 1e-12)


def test_partial_probe_confirms_only_the_resolved_model(
    instance: Instance,
) -> None:
    text = f"[inputs]\nfrequency_ratio = 1.01\n{RUN.format(1e6, 'position')}"
    probe = Probe(instance, scene_of(text))
    step = probe.scene.step_size
    averaged = probe.run_errors(Candidate(Model(0, 0, 1), 1e-8, step))["position"]
    resolved = probe.run_errors(Candidate(Model(2, 0), 1e-8, step))["position"]
    assert averaged.error == inf
    assert "too long" in averaged.reason
    grown = CAUTION * 1e6 / HEAD_PERIODS
    assert resolved.error == pytest.approx(grown * 1e-12 * resolved.magnitude)


def test_the_resolved_periods_are_counted(instance: Instance) -> None:
    probe = Probe(instance, scene_of(RUN.format(500, "mean_velocity")))
    for fidelity in (0, 1, 2):
        probe.run_errors(Candidate(Model(fidelity, 0), 1e-8, probe.duration))
    assert probe.drive_periods == pytest.approx(3 * 500.0)
