"""State that is serialized: a new process replays the same bits. Scenes replay in one process."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.fmu.host import Instance, Instantiate
from tests.fmus import both_fmus
from tests.processes import run_python

pytestmark = both_fmus

STEP = 3.1e-4

REPLAY = """
import json, sys
from pathlib import Path
from tests.fmu.host import Instance, unpack
fmu, folder, step, time = Path(sys.argv[1]), Path(sys.argv[2]), float(sys.argv[3]), sys.argv[4]
instance = Instance(unpack(fmu, folder))
instance.restore((folder / "state").read_bytes())
instance.time = float.fromhex(time)
print(json.dumps([[x.hex() for x in row] for row in instance.run(30, step)]))
"""


def test_replay_in_a_new_process(fmu: Path, instance: Instance, tmp_path: Path) -> None:
    instance.set(base_amplitude=5e-8)
    instance.run(21, STEP)
    (tmp_path / "state").write_bytes(instance.state())
    replayed = json.loads(run_python(REPLAY, fmu, tmp_path, STEP, instance.time.hex()))
    expected = [[x.hex() for x in row] for row in instance.run(30, STEP)]
    assert replayed == expected, "a new process replays the same bits"


REACH: dict[str, Callable[[Instance], object]] = {
    "instantiated": lambda i: None,
    "experiment set up": lambda i: i.slave.setupExperiment(startTime=0.0, stopTime=1.0),
    "initializing": lambda i: i.enter_initialization(slider_mass=2.0, phase=0.3),
    "stepping": lambda i: i.initialize().step(1e-3),
    "terminated": lambda i: i.initialize().slave.terminate(),
}
"""How an instance gets into each state of its life."""


@pytest.mark.parametrize("reached", REACH)
def test_every_state_of_life_comes_back(instantiate: Instantiate, reached: str) -> None:
    instance, other = instantiate(), instantiate().initialize(load=0.2)
    REACH[reached](instance)
    other.restore(instance.state())
    assert other.state() == instance.state()
