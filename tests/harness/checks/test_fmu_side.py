from __future__ import annotations

import pytest

from slider_resonator.checks.fmu_side import PREDICTED, PREDICTIONS, FmuSide
from slider_resonator.checks.measuring import MEASURES
from slider_resonator.fmu.instance import Instance
from slider_resonator.scenes.scene_files import find_scene
from tests.harness.scene_text import scene_of


def test_the_blocking_force_does_not_depend_on_the_load_of_the_scene(instance: Instance) -> None:
    loaded = FmuSide(instance, find_scene("table_1", {"load": 0.3}))
    free = FmuSide(instance, find_scene("table_1"))
    assert loaded.blocking.blocking_force == free.blocking.blocking_force


RUN = "[run]\ndrive_periods = 4\nsteps_per_period = 2\n"
SLOW = "[device]\nfidelity = 0\n" + RUN
NUMBER = '[[expect]]\nquantity = "{}"\nat_most = 1.0\nwhy = "test"\n'
SIGNAL = '[[expect]]\nquantity = "{}"\nreference = "averaged"\nrelative = 1.0\nwhy = "test"\n'


@pytest.mark.parametrize("quantity", sorted(PREDICTED))
def test_a_scene_that_expects_a_prediction_reads_it(instance: Instance, quantity: str) -> None:
    side = FmuSide(instance, scene_of(SLOW))
    assert not set(PREDICTIONS) & set(side.record.outputs), "what nobody asks for costs nothing"
    expect = SIGNAL if quantity.endswith("_in_run") else NUMBER
    expecting = FmuSide(instance, scene_of(SLOW + expect.format(quantity)))
    MEASURES[quantity](expecting)
    assert set(PREDICTIONS) <= set(expecting.record.outputs)
