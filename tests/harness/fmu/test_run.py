from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from slider_resonator.device.schedule import schedule
from slider_resonator.device.signal import constant, ramp, steps
from slider_resonator.errors import NotApplicable, Refusal
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from tests.fmus import both_fmus

pytestmark = both_fmus

PERIOD = 2.0 * pi / 3500.0


def test_a_run_records_every_output_at_every_point(instance: Instance) -> None:
    record = run(instance, {}, schedule(10 * PERIOD, PERIOD))
    assert record.times.shape == (11,)
    assert record["position"].shape == (11,)
    assert record["position"][0] == 0.0
    assert record.final("reversals") == 19.0, "two reversals in each period but the first"
    assert record.wall_time > 0.0
    assert record.start_cpu > 0.0
    assert record.step_cpu > 0.0


def test_a_second_run_starts_afresh(instance: Instance) -> None:
    first = run(instance, {"base_amplitude": 2e-4}, schedule(5 * PERIOD, PERIOD))
    again = run(instance, {}, schedule(5 * PERIOD, PERIOD))
    fresh = run(instance, {}, schedule(5 * PERIOD, PERIOD))
    assert np.array_equal(again["position"], fresh["position"])
    assert not np.array_equal(first["position"], again["position"])


def test_inputs_reach_the_fmu_at_their_time_and_not_before(instance: Instance) -> None:
    at = 3.5 * PERIOD
    loaded = schedule(6 * PERIOD, PERIOD, load=steps([(0.0, 0.0), (at, 0.5)]))
    free = schedule(6 * PERIOD, PERIOD, load=steps([(0.0, 0.0), (at, 0.0)]))
    one, two = run(instance, {}, loaded), run(instance, {}, free)
    before = one.times <= at
    assert np.array_equal(one["velocity"][before], two["velocity"][before])
    assert np.all(one["velocity"][~before] < two["velocity"][~before]), "load opposes +X"


def test_a_refusal_in_a_run_is_raised_and_no_short_record_returned(instance: Instance) -> None:
    bad = schedule(4 * PERIOD, PERIOD, load=constant(float("1e308")))
    with pytest.raises(Refusal):
        run(instance, {"friction_coefficient": -1.0}, bad)


def test_progress_is_reported(instance: Instance) -> None:
    shares: list[float] = []
    run(instance, {}, schedule(20 * PERIOD, PERIOD), progress=lambda _, share: shares.append(share))
    assert shares[-1] == 1.0
    assert shares == sorted(shares)


@pytest.mark.slow
def test_lines_are_passed_on_where_the_fmu_takes_derivatives(instance: Instance) -> None:
    line = {"load": ramp([(0.0, 0.0), (10 * PERIOD, 2.0)])}
    fine = run(instance, {}, schedule(10 * PERIOD, PERIOD / 200, **line))
    plan = schedule(10 * PERIOD, 5 * PERIOD, None, True, **line)
    if not instance.fmu.interpolates:
        with pytest.raises(NotApplicable, match="needs canInterpolateInputs = true"):
            run(instance, {}, plan)
        with pytest.raises(NotApplicable):
            instance.set_input_rates([0.0, 1.0, 0.0])
        return
    found = run(instance, {}, plan)
    coarse = run(instance, {}, replace(plan, interpolates=False))
    off, held = (abs(r.final("position") - fine.final("position")) for r in (found, coarse))
    assert off < 2e-3 * abs(fine.final("position"))
    assert off < 1e-2 * held
