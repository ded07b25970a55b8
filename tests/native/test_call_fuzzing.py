"""All functions of FMI 2.0 in random order, with good, bad and absurd arguments."""

import re
from collections.abc import Sequence
from pathlib import Path

import pytest

from fmu_src.controller.variables import VARIABLES
from tests.native.toolchain import COUNTS, PROGRAMS, Binary, program, run, unpacked_binary

CALLS = 300_000
FUNCTIONS = ("fmi2DoStep", "fmi2SetReal", "fmi2SetFMUstate", "fmi2DeSerializeFMUstate")
FUNCTIONS_3 = ("fmi3DoStep", "fmi3SetFloat64", "fmi3SetFMUState", "fmi3EnterStepMode")
"""Functions that are carried out more than a thousand times, and also refused."""


@pytest.fixture(scope="module")
def fuzzer(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return program(PROGRAMS / "fuzz.c", tmp_path_factory.mktemp("fuzzer"))


def fuzz(
    fuzzer: Path, binary: Binary, *arguments: float, functions: Sequence[str] = FUNCTIONS
) -> dict[str, int]:
    """Number of calls by the name of the function, none of which went wrong."""
    done = run([fuzzer, binary.library, binary.guid, *arguments])
    assert done.returncode == 0, f"{arguments}: {done.stdout}{done.stderr}"
    assert done.stdout.startswith(f"{CALLS} calls"), "the fuzzer ended before its last call"
    calls = {name: (int(n), int(k)) for name, n, k in re.findall(r"(\w+) (\d+) (\d+)", done.stdout)}
    for name in functions:
        number, carried_out = calls[name]
        assert 1000 < carried_out < number, f"{name} is both carried out and refused"
    return {name: number for name, (number, _) in calls.items()}


@pytest.mark.parametrize(
    "seed",
    [  # The first one happens upon steps of much work.
        pytest.param(0, marks=pytest.mark.nightly),
        *(pytest.param(seed, marks=pytest.mark.slow) for seed in (1, 2, 3)),
    ],
)
def test_no_call_crashes_hangs_or_is_refused_in_silence(
    fuzzer: Path, product: Binary, seed: int
) -> None:
    calls = fuzz(fuzzer, product, seed, CALLS)
    assert min(calls.values()) >= 500, f"every function is called hundreds of times: {calls}"


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_no_call_of_fmi_3_crashes_hangs_or_is_refused_in_silence(
    native_3_fmu: Path, tmp_path: Path, seed: int
) -> None:
    fuzzer = program(PROGRAMS / "fuzz3.c", tmp_path)
    binary = unpacked_binary(native_3_fmu, tmp_path, "x86_64-linux")
    fuzz(fuzzer, binary, seed, CALLS, COUNTS[0], 2.0, functions=FUNCTIONS_3)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [5, 10071])  # the second has a step of 1e296 legs
def test_no_state_with_a_valid_seal_does_harm(product: Binary, tmp_path: Path, seed: int) -> None:
    """States of random content: each one restored is stepped and read, in at most 2 s a call."""
    states = program(PROGRAMS / "states.c", tmp_path)
    done = run([states, product.library, product.guid, *COUNTS, seed, 4_000, 2.0])
    assert done.returncode == 0, done.stdout + done.stderr
    found = re.match(r"4000 states: (\d+) restored, (\d+) steps, (\d+) values", done.stdout)
    assert found is not None
    for name, number, minimum in zip(
        ("states restored", "steps", "values"), found.groups(), (1000, 3000, 10**5), strict=True
    ):
        assert int(number) > minimum, f"{name}: {number}; must be above {minimum} to show anything"


@pytest.mark.slow
def test_no_call_of_the_controller_crashes_or_hangs(
    fuzzer: Path, controller_fmu: Path, tmp_path: Path
) -> None:
    settable = sum(variable.causality != "output" for variable in VARIABLES)
    fuzz(fuzzer, unpacked_binary(controller_fmu, tmp_path), 1, CALLS, settable)
