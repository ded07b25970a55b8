import math
from collections.abc import Mapping
from dataclasses import replace

import pytest

from slider_resonator.choosing import choosing, probe
from slider_resonator.choosing.choice import Candidate
from slider_resonator.choosing.probe import find, timed_run
from slider_resonator.device.device import Device
from slider_resonator.device.schedule import Schedule
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import Record
from slider_resonator.steady.searches import SteadyAnswer

STEP_COST = 1e-6
"""Stated cost of a communication step, s."""
PERIOD_COST = {0: 0.7e-6, 1: 5e-6}
"""Stated cost of a resolved drive period by friction law, s."""
LEAP_PERIODS = 300.0
"""Most drive periods that order 2 resolves."""
OUTPUT_COST = 1e-4
"""Stated cost of a steady output of first order, s; of second order it is twice that."""


@pytest.fixture
def stated_costs(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let runs cost what they cost on a quiet machine, about, so that choices do not scatter."""

    def run(
        instance: Instance, parameters: Mapping[str, float], schedule: Schedule
    ) -> tuple[Record, float]:
        record, _ = timed_run(instance, parameters, schedule)
        values = {**vars(Device()), **parameters}
        duration = float(schedule.times[-1] - schedule.times[0])
        periods = duration * values["drive_frequency"] / math.tau
        if values["fidelity"] == 0:
            periods = min(periods, LEAP_PERIODS) if values["averaging_order"] == 2 else 0.0
        law = int(values["friction_law"])
        return record, STEP_COST * len(schedule.times) + PERIOD_COST[law] * periods

    def steady(
        instance: Instance, values: Mapping[str, float], name: str, candidate: Candidate
    ) -> SteadyAnswer:
        found = find(instance, values, name, candidate)
        if candidate.model.fidelity > 0:
            return found
        return replace(found, seconds=OUTPUT_COST * (candidate.model.averaging_order or 1))

    for module in (probe, request.module):
        monkeypatch.setattr(module, "timed_run", run, raising=False)
    for module in (choosing, request.module):
        monkeypatch.setattr(module, "find", steady, raising=False)
    for module, rounds in ((choosing, "ROUNDS"), (request.module, "REPEATS")):
        monkeypatch.setattr(module, rounds, 1, raising=False)
