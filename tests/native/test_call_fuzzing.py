"""All functions of FMI in random order, with good, bad and absurd arguments."""

import re
from pathlib import Path

import pytest

from fmu_src.controller.variables import VARIABLES
from tests.native.toolchain import PROGRAMS, Binary, program, run, unpacked_binary

CALLS = 300_000
FUNCTIONS = {
    "fuzz.c": ("fmi2DoStep", "fmi2SetReal", "fmi2SetFMUstate", "fmi2DeSerializeFMUstate"),
    "fuzz3.c": ("fmi3DoStep", "fmi3SetFloat64", "fmi3SetFMUState", "fmi3EnterStepMode"),
}
"""Functions that are carried out more than a thousand times, and also refused."""
SETTABLE = sum(variable.causality != "output" for variable in VARIABLES)
"""Variables of the controller that can be set."""


@pytest.mark.parametrize(
    ("fmu", "arguments"),
    [  # The first one happens upon steps of much work.
        pytest.param("native", (0, CALLS), marks=pytest.mark.nightly),
        *(pytest.param("native", (n, CALLS), marks=pytest.mark.slow) for n in (1, 2, 3)),
        *(pytest.param("native_3", (n, CALLS, 2.0), marks=pytest.mark.slow) for n in (0, 1)),
        pytest.param("controller", (1, CALLS, SETTABLE), marks=pytest.mark.slow),
    ],
    indirect=["fmu"],
)
def test_no_call_crashes_hangs_or_is_refused_in_silence(
    fmu: Path, tmp_path: Path, arguments: tuple[float, ...]
) -> None:
    source, place = "fuzz.c", "linux64"
    if fmu.stem == "SliderResonator3":
        source, place = "fuzz3.c", "x86_64-linux"
    binary = unpacked_binary(fmu, tmp_path, place)
    done = run([program(PROGRAMS / source, tmp_path), binary.library, binary.guid, *arguments])
    assert done.returncode == 0, f"{arguments}: {done.stdout}{done.stderr}"
    assert done.stdout.startswith(f"{CALLS} calls"), "the fuzzer ended before its last call"
    found = re.findall(r"(\w+) (\d+) (\d+)", done.stdout)
    calls = {name: (int(number), int(done)) for name, number, done in found}
    for name in FUNCTIONS[source]:
        number, carried_out = calls[name]
        assert 1000 < carried_out < number, f"{name} is both carried out and refused"
    assert min(number for number, _ in calls.values()) >= 500, f"each is called often: {calls}"


@pytest.mark.slow
@pytest.mark.parametrize("seed", [5, 10071])  # the second has a step of 1e296 legs
def test_no_state_with_a_valid_seal_does_harm(product: Binary, tmp_path: Path, seed: int) -> None:
    """States of random content: each one restored is stepped and read, in at most 2 s a call."""
    states = program(PROGRAMS / "states.c", tmp_path)
    done = run([states, product.library, product.guid, seed, 4_000, 2.0])
    assert done.returncode == 0, done.stdout + done.stderr
    found = re.match(r"4000 states: (\d+) restored, (\d+) steps, (\d+) values", done.stdout)
    assert found is not None
    restored, steps, values = map(int, found.groups())
    assert restored > 1000, "fewer states show nothing"
    assert steps > 3000
    assert values > 10**5
