"""Instances and builds beside each other in one process."""

from __future__ import annotations

import gc
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from fmpy import simulate_fmu

from build_fmu import PACKAGE, build_python
from tests.fmu.host import OUTPUTS, Instance, Unpacked, unpack

STEP = 1.3e-3


@pytest.fixture(scope="module")
def other_build(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU whose code has another coefficient of friction built in."""
    folder = tmp_path_factory.mktemp("other")
    package = folder / "slider_resonator"
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    for module, old, new in [
        ("device.py", "friction_coefficient: float = 0.1", "friction_coefficient: float = 0.2"),
        ("variables.py", 'of each face",\n        start=0.1', 'of each face",\n        start=0.2'),
    ]:
        text = (package / module).read_text()
        assert text.count(old) == 1, f"{module} no longer says {old!r}"
        (package / module).write_text(text.replace(old, new))
    return build_python(folder / "dist", package)


def test_two_builds_in_one_process_give_their_own_numbers(
    other_build: Path, instantiate: Callable[[], Instance], tmp_path: Path
) -> None:
    golden = instantiate().initialize()
    candidate = Instance(unpack(other_build, tmp_path)).initialize()
    told = instantiate().initialize(friction_coefficient=0.2)
    rows = [(golden.run(1, STEP), candidate.run(1, STEP), told.run(1, STEP)) for _ in range(20)]
    candidate.free()
    for of_golden, of_candidate, of_told in rows:
        assert of_candidate == of_told, "the other build runs its own code"
        assert of_candidate != of_golden


def test_a_state_of_another_build_is_refused(
    other_build: Path, instance: Instance, tmp_path: Path
) -> None:
    candidate = Instance(unpack(other_build, tmp_path)).initialize()
    foreign = candidate.state()
    candidate.free()
    with instance.refuses("state", "refused"):
        instance.restore(foreign)


def test_two_instances_do_not_share_anything(instantiate: Callable[[], Instance]) -> None:
    values: tuple[dict[str, float], ...] = ({"phase": 0.4}, {"load": 0.06, "fidelity": 1})
    together = [instantiate().initialize(**v) for v in values]
    rows: list[list[tuple[float, ...]]] = [[], []]
    for _ in range(20):
        for instance, collected in zip(together, rows, strict=True):
            collected += instance.run(1, STEP)
    alone = [instantiate().initialize(**v).run(20, STEP) for v in values]
    assert rows == alone


def test_each_instance_logs_to_its_own_host(instantiate: Callable[[], Instance]) -> None:
    first, second = instantiate().initialize(), instantiate().initialize()
    with first.refuses("load"):
        first.set(load=float("nan"))
    assert second.log == []


def test_reset_gives_back_a_new_instance(instantiate: Callable[[], Instance]) -> None:
    used, fresh = instantiate(), instantiate().initialize()
    used.initialize(slider_mass=3.0, phase=1.0, friction_faces=1)
    used.run(10, STEP)
    used.slave.reset()
    used.initialize()
    assert used.run(10, STEP) == fresh.run(10, STEP)


def test_reset_after_terminate(instance: Instance, instantiate: Callable[[], Instance]) -> None:
    first = instance.run(10, STEP)
    instance.slave.terminate()
    assert instance.get(*OUTPUTS) == first[-1], "results can be read after the end"
    instance.slave.reset()
    instance.initialize()
    assert instance.run(10, STEP) == first


def test_a_run_that_starts_later_is_the_same_motion(
    instance: Instance, instantiate: Callable[[], Instance]
) -> None:
    later = instantiate().initialize(start_time=1000.0)
    velocity = OUTPUTS.index("velocity")
    assert [r[velocity] for r in later.run(10, 2.0**-10)] == [
        r[velocity] for r in instance.run(10, 2.0**-10)
    ], "phases start at zero at the start time, whatever it is"


def test_the_folder_of_an_earlier_instance_may_be_gone(python_fmu: Path, tmp_path: Path) -> None:
    rows = []
    for folder in (tmp_path / "first", tmp_path / "second"):
        instance = Instance(unpack(python_fmu, folder)).initialize()
        rows.append(instance.run(3, STEP))
        instance.free()
        shutil.rmtree(folder)
    assert rows[0] == rows[1]


LET_GO = """
import atexit, sys
from pathlib import Path
from tests.fmu.host import Instance, unpack
asked, register = [], atexit.register
def note(function, *args, **kwargs):
    asked.append(getattr(function, "__name__", ""))
    return register(function, *args, **kwargs)
atexit.register = note
for folder in ("first", "second"):
    unpacked = unpack(Path(sys.argv[1]), Path(sys.argv[2], folder))
    for _ in range(3):
        Instance(unpacked).initialize().free()
print(asked.count("_let_go"))
"""


def test_each_binary_is_asked_once_to_let_go_before_the_process_ends(
    python_fmu: Path, tmp_path: Path
) -> None:
    done = subprocess.run(
        [sys.executable, "-c", LET_GO, python_fmu, tmp_path],
        cwd=Path(__file__).resolve().parents[2],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    expected = 2 if sys.platform == "linux" else 0
    assert int(done.stdout) == expected, (
        "unasked, the binary on Linux frees memory twice at the end"
    )


def test_simulate_fmu_twice(python_fmu: Path) -> None:
    first, second = (simulate_fmu(str(python_fmu), stop_time=0.05) for _ in range(2))
    assert first.tolist() == second.tolist()


def test_many_instances_leave_the_search_path_as_it_was(unpacked: Unpacked) -> None:
    Instance(unpacked).initialize().free()
    before = list(sys.path)
    for _ in range(200):
        instance = Instance(unpacked).initialize()
        instance.step(STEP)
        instance.free()
    assert sys.path == before


def test_freed_instances_are_gone(unpacked: Unpacked) -> None:
    def alive() -> int:
        gc.collect()
        return sum(type(o).__name__ == "SliderResonatorPy" for o in gc.get_objects())

    before = alive()
    for _ in range(5):
        instance = Instance(unpacked).initialize()
        with instance.refuses("load"):
            instance.set(load=float("nan"))
        instance.free()
    assert alive() == before, "references that refusals keep must not keep instances"
