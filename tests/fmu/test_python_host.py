"""What the Python FMU owes a process that goes on without it: its streams, modules and memory."""

import gc
import math
import sys
from pathlib import Path

import pytest
from fmpy.fmi1 import FMICallException

from tests.fmu.host import Instance, Unpacked
from tests.processes import run_python

STEP = 1.3e-3


def test_text_reaches_standard_error_without_a_logger(
    unpacked: Unpacked, capsys: pytest.CaptureFixture[str]
) -> None:
    instance = Instance(unpacked, logging_on=False).initialize()
    with pytest.raises(FMICallException):
        instance.set(load=float("nan"))
    instance.free()
    assert instance.log == [], "the host asked for no log"
    assert "load = nan refused: must be a finite number" in capsys.readouterr().err


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
print(asked.count("release_interpreter"))
"""


def test_each_binary_is_released_once_before_exit(python_fmu: Path, tmp_path: Path) -> None:
    expected = 2 if sys.platform == "linux" else 0
    assert int(run_python(LET_GO, python_fmu, tmp_path)) == expected, (
        "unasked, the binary on Linux frees memory twice at the end"
    )


def test_freed_instances_leave_nothing(unpacked: Unpacked) -> None:
    """No entry of the search path, nor by the references that refusals keep."""

    def alive() -> int:
        gc.collect()
        return sum(type(o).__name__ == "SliderResonatorPy" for o in gc.get_objects())

    Instance(unpacked).initialize().free()
    before = alive(), list(sys.path)
    for _ in range(20):
        instance = Instance(unpacked).initialize()
        instance.step(STEP)
        with instance.refuses("load"):
            instance.set(load=math.nan)
        instance.free()
    assert (alive(), sys.path) == before


STORM = """
import sys
from pathlib import Path
from tests.fmu.host import Instance, unpack
unpacked = unpack(Path(sys.argv[1]), Path(sys.argv[2]))
for _ in range(5):
    instance = Instance(unpacked).initialize()
    for _ in range(300):
        with instance.refuses("load = nan"):
            instance.set(load=float("nan"))
        with instance.refuses("communicationStepSize = 0.0"):
            instance.step(0.0)
    instance.slave.reset()
    instance.initialize().step(1e-3)
    instance.free()
print("alive")
"""


def test_the_host_outlives_thousands_of_refusals(python_fmu: Path, tmp_path: Path) -> None:
    """Refusals keep references, which are counted. Calls of the native FMU are fuzzed."""
    assert run_python(STORM, python_fmu, tmp_path) == "alive\n", "also when the process ends"
