"""What comes after a refused call: the host lives on, and knows of it."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException

from tests.fmu.host import Instance, Unpacked
from tests.fmus import both_fmus
from tests.processes import run_python

pytestmark = both_fmus

STEP = 1.7e-3
MALTREATMENT: tuple[Callable[[Instance], object], ...] = (
    lambda i: i.set(load=math.nan),
    lambda i: i.set(normal_preload=-1.0),
    lambda i: i.set(slider_mass=2.0),
    lambda i: i.set(friction_faces=1),
    lambda i: i.set(position=0.0),
    lambda i: i.slave.doStep(i.time, 0.0),
    lambda i: i.slave.doStep(i.time, math.nan),
    lambda i: i.slave.doStep(i.time + 1.0, STEP),
    lambda i: i.slave.setupExperiment(startTime=0.0),
    lambda i: i.slave.exitInitializationMode(),
    lambda i: i.slave.getReal([999]),
    lambda i: i.slave.getInteger([0]),
    lambda i: i.restore(b"not a state"),
)


def maltreat(instance: Instance) -> None:
    for call in MALTREATMENT:
        with pytest.raises(FMICallException):
            call(instance)


STORM = """
import sys, tempfile
from pathlib import Path
from tests.fmu.host import Instance, unpack
from tests.fmu.test_after_refusals import maltreat
unpacked = unpack(Path(sys.argv[1]), Path(sys.argv[2]))
for _ in range(5):
    instance = Instance(unpacked).initialize()
    for _ in range(40):
        maltreat(instance)
    instance.step(1e-3)
    instance.slave.reset()
    instance.initialize().step(1e-3)
    maltreat(instance)
    instance.free()
print("alive", instance.time)
"""


def test_the_host_outlives_thousands_of_refusals(fmu: Path, tmp_path: Path) -> None:
    printed = run_python(STORM, fmu, tmp_path)
    assert printed.startswith("alive"), "no crash, also when the process ends"


def changing(name: str, before: float, after: float) -> dict[str, object]:
    """A run in which a variable changes after 0.05 s."""
    rows = [(0.0, before), (0.05, before), (0.05, after), (0.1, after)]
    return {"input": np.array(rows, dtype=[("time", float), (name, float)])}


REFUSED_RUNS: dict[str, dict[str, object]] = {
    "start value not finite": {"start_values": {"load": math.nan}},
    "start value out of bounds": {"start_values": {"slider_mass": 0.0}},
    "choice out of bounds": {"start_values": {"friction_faces": 3}},
    "values that do not fit": {"start_values": {"friction_law": 1, "friction_coefficient": 0.0}},
    "input turns into nan": changing("load", 0.0, math.nan),
    "input turns infinite": changing("phase", 0.0, math.inf),
    "tunable leaves its bounds": changing("normal_preload", 1.0, -1.0),
    "tunable turns into nan": changing("base_amplitude", 1e-4, math.nan),
    "step of zero": {"output_interval": 0.0, "stop_time": 0.1},
}


@pytest.mark.parametrize("run", REFUSED_RUNS.values(), ids=REFUSED_RUNS)
def test_simulate_fmu_raises(fmu: Path, unpacked: Unpacked, run: dict[str, object]) -> None:
    reached: list[float] = []

    def note(time: float, _: object) -> bool:
        reached.append(time)
        return True

    with pytest.raises(FMICallException) as caught:
        simulate_fmu(str(fmu), **({"stop_time": 0.1, "step_finished": note} | run))
    assert caught.value.status == unpacked.status_of_refusals, (
        "fmi2Discard would end the run short without a word"
    )
    if "input" in run:
        assert 0.04 < reached[-1] < 0.06, "the first half is fine, the refusal comes in the middle"
