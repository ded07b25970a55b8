"""States and instances beside each other; steady velocities of another program."""

import json
import shutil
from pathlib import Path

import pytest

from fmu_src.building import native_fmu
from fmu_src.building.c_sources import slider_sources
from fmu_src.building.native_fmu import build_native
from fmu_src.building.platforms import HOST
from fmu_src.building.python_fmu import build_python
from fmu_src.sources import PACKAGE
from tests.fmu.host import Instance, Instantiate, Unpacked, unpack
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


def _edited(text: str, old: str) -> str:
    """The text with another start value of the coefficient of friction, 0.1 in `old`."""
    assert text.count(old) == 1, f"the code no longer says {old!r}"
    return text.replace(old, old.replace("0.1", "0.2"))


def _python_build(folder: Path) -> Path:
    package = folder / "slider_component"
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    for name, old in (
        ("parameters.py", "friction_coefficient: float = 0.1"),
        ("variables.py", "friction_coefficient 1, start 0.1"),
    ):
        (package / name).write_text(_edited((package / name).read_text(), old))
    return build_python(folder / "dist", package)


def _native_build(folder: Path) -> Path:
    code, name = slider_sources(), "component/variables.c"
    code[name] = _edited(code[name], '{"friction_coefficient", false, false, 0.1')
    return build_native(folder, platforms=[HOST], code=code)


@pytest.fixture(scope="session")
def other_build(unpacked: Unpacked, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU whose code has another coefficient of friction built in."""
    native = unpacked.description.modelName == native_fmu.MODEL
    return (_native_build if native else _python_build)(tmp_path_factory.mktemp("other"))


def test_two_builds_in_one_process_stay_independent(
    other_build: Path, instantiate: Instantiate, tmp_path: Path
) -> None:
    """The other build runs its own code, and neither takes the state of the other."""
    golden = instantiate().initialize()
    candidate = Instance(unpack(other_build, tmp_path)).initialize()
    tuned = instantiate().initialize(friction_coefficient=0.2)
    for _ in range(20):
        rows = [instance.run(1, 1.3e-3) for instance in (golden, candidate, tuned)]
        assert rows[0] != rows[1] == rows[2]
    foreign = candidate.state()
    candidate.free()
    with golden.refuses("state", "refused"):
        golden.restore(foreign)
