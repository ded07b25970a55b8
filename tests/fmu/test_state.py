"""State that is got, set, serialized: a replay gives the same bits."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import pytest

from tests.fmu.host import Instance, Instantiate
from tests.fmu.lifecycle import REACH
from tests.fmus import both_fmus
from tests.processes import run_python

pytestmark = both_fmus

STEP = 3.1e-4

# What to set, and the contact mode in which the state is taken.
SITUATIONS: dict[str, tuple[dict[str, float], float]] = {
    "sliding forwards": ({"phase": 0.4, "load": 0.05}, 1.0),
    "sliding backwards": ({"frequency_ratio": 3.0}, -1.0),
    "sticking": ({"base_amplitude": 5e-8}, 0.0),
    "in flight": ({"normal_amplitude": 2.0}, 2.0),
    "one degree of freedom": ({"fidelity": 1}, 1.0),
}


def bring_into(instance: Instance, mode: float) -> None:
    """Small uneven steps until the contact mode is the given one."""
    for k in range(2000):
        if k > 20 and instance.get("contact_mode") == (mode,):
            return
        instance.step(1e-4 * (1.0 + 0.37 * (k % 3)))
    raise AssertionError(f"the device never came into contact mode {mode:g}")


@pytest.fixture(params=SITUATIONS.values(), ids=list(SITUATIONS))
def on_its_way(request: pytest.FixtureRequest, instantiate: Instantiate) -> Instance:
    values, mode = request.param
    instance = instantiate().initialize(**values)
    bring_into(instance, mode)
    return instance


def test_replay_in_the_same_instance(on_its_way: Instance) -> None:
    time = on_its_way.time
    state = on_its_way.slave.getFMUstate()
    first = on_its_way.run(30, STEP)
    on_its_way.set(load=1.0, phase=2.0, frequency_ratio=-0.5, normal_preload=3.0)
    on_its_way.run(3, STEP)
    on_its_way.slave.setFMUstate(state)
    on_its_way.time = time
    assert on_its_way.run(30, STEP) == first, "inputs and tunables belong to the state too"
    on_its_way.slave.setFMUstate(state)
    on_its_way.time = time
    assert on_its_way.run(30, STEP) == first, "a state can be set more than once"
    on_its_way.slave.freeFMUstate(state)


def test_replay_in_another_instance(on_its_way: Instance, instantiate: Instantiate) -> None:
    other = instantiate()
    other.restore(on_its_way.state())
    other.time = on_its_way.time
    assert other.state() == on_its_way.state(), "serializing again gives the same bytes"
    assert other.run(30, STEP) == on_its_way.run(30, STEP), "it goes on with the same bits"


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


@pytest.mark.parametrize("on_its_way", [SITUATIONS["sticking"]], indirect=True)
def test_replay_in_a_new_process(fmu: Path, on_its_way: Instance, tmp_path: Path) -> None:
    (tmp_path / "state").write_bytes(on_its_way.state())
    replayed = json.loads(run_python(REPLAY, fmu, tmp_path, STEP, on_its_way.time.hex()))
    expected = [[x.hex() for x in row] for row in on_its_way.run(30, STEP)]
    assert replayed == expected, "a new process replays the same bits"


@pytest.mark.parametrize("reached", REACH)
def test_every_state_of_life_comes_back(instantiate: Instantiate, reached: str) -> None:
    instance, other = instantiate(), instantiate().initialize(load=0.2)
    REACH[reached](instance)
    other.restore(instance.state())
    assert other.state() == instance.state()


def _foreign(data: bytes) -> dict[str, bytes]:
    return {
        "empty": b"",
        "nonsense": b"\x00\xff" * 50,
        "other JSON": b'{"position": 0.0}',
        "a list": b"[1, 2, 3]",
        "cut short": data[:-1],
        "half": data[: len(data) // 2],
        "longer": data + b"\x00",
        "twice": data + data,
    }


@pytest.mark.parametrize("kind", _foreign(b"--"))
def test_foreign_or_damaged_bytes_are_refused(instance: Instance, kind: str) -> None:
    instance.run(3, STEP)
    data = _foreign(instance.state())[kind]
    with instance.refuses("state", "refused"):
        instance.restore(data)


def test_a_deeply_nested_state_with_a_good_checksum_is_refused(
    instance: Instance,
) -> None:
    """In the Python FMU such a state is JSON behind its SHA-256."""
    instance.run(3, STEP)
    for depth in (900, 100_000):
        body = b'{"format": ' + b"[" * depth + b"]" * depth + b"}"
        with instance.refuses("state", "refused"):
            instance.restore(hashlib.sha256(body).hexdigest().encode() + b"\n" + body)
    instance.run(3, STEP)


def test_no_flipped_bit_goes_unnoticed(instance: Instance) -> None:
    instance.run(3, STEP)
    data = instance.state()
    for k in (*range(0, len(data), 7), len(data) - 1):
        with instance.refuses("state", "refused"):
            instance.restore(data[:k] + bytes([data[k] ^ (1 << k % 8)]) + data[k + 1 :])
