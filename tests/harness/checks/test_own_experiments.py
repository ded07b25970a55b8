"""The experiments that an FMU carries: found, run, and compared with the results beside them."""

import re
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.util import read_csv

from slider_resonator.checks.own_experiments import own_experiments, validate_own
from slider_resonator.fmu.opening import Fmu
from tests.fmus import every_slider
from tests.harness.calling import call, refused
from tests.harness.faulty_fmus import altered, redescribed

OWN = "extra/org.fmi-standard.fmi-ls-ref/"


@every_slider
def test_every_build_carries_experiments_and_agrees_with_them(fmu: Fmu) -> None:
    result = call("validate", fmu.path, "--own")
    assert result.exit_code == 0, result.output
    for said in ("12 of 12 checks passed", "table_1", "lugre", "changing_inputs"):
        assert said in result.output


def test_wrong_result_has_experiment_variable_and_time(native_fmu: Path, tmp_path: Path) -> None:
    (experiment,) = (e for e in own_experiments(native_fmu) if e.scene.name == "table_1")
    value = f",{experiment.results['velocity'][50]:.12g}".encode()
    results = f"{OWN}table_1_ref.csv"
    wrong = redescribed(native_fmu, tmp_path / "a.fmu", value, value + b"1e-3", results)
    result = call("validate", wrong, "--own")
    assert result.exit_code == 1, result.output
    said = " ".join(result.output.split())
    assert re.search("FAIL table_1: velocity: .*from 0.05 s on, most at 0.05 s", said)
    assert "11 of 12 checks passed" in said


@pytest.mark.parametrize(
    ("name", "old", "new", "text"),
    [
        ("fmi-ls-manifest.xml", b"x-ma-hs-exp", b"x-other", "fmi-ls-manifest.xml names none"),
        ("fmi-ls-manifest.xml", b"<fmiReferences", b"<", "must be XML"),
        ("fmi-ls-manifest.xml", b'"experiments.exp"', b'"../../../a"', "must be a file in the FMU"),
        ("experiments.exp", b'stepSize="0.001"', b"", "stepSize = None: must be a finite number"),
        ("experiments.exp", b"lugre_in.csv", b"no.csv", "'no.csv': must be a file in the FMU"),
        ("lugre.ssv", b"friction_law", b"friction_lab", "did you mean 'friction_law'?"),
        ("lugre_ref.csv", b"position", b"positron", "unknown column 'positron'"),
        ("lugre_ref.csv", b"\n0.0005,", b"\n0.00051,", "must be a communication point"),
        ("lugre_ref.csv", b"\n0.0005,", b"\n0.0005,nan,", "_ref.csv line 3: 6 cells below 5"),
        ("lugre_ref.csv", b"\n0.0005,", b"\n0,", "times must increase strictly"),
        ("lugre_ref.csv", b"time", b"tome", "must begin with 'time'"),
        ("lugre_in.csv", b",phase", b"", "lugre_in.csv line 2: 2 cells below 1 headings"),
        ("experiments.exp", b"1e-06", b"-1", "= -1: must be a share between 0 and 1"),
        ("experiments.exp", b"1e-06", b"0", "= 0: must be a share between 0 and 1"),
        ("experiments.exp", b"UTF-8", b"klingon", "unknown encoding: klingon; must be XML"),
        ("experiments.exp", b"lugre_in", b"a" * 5000, "must be a file in the FMU"),
    ],
)
def test_experiments_that_cannot_be_read_are_named(
    native_fmu: Path, tmp_path: Path, name: str, old: bytes, new: bytes, text: str
) -> None:
    other = redescribed(native_fmu, tmp_path / "a.fmu", old, new, OWN + name)
    (validation,) = validate_own([other])
    (failure,) = validation.run_failures
    assert text in failure.reason


def test_an_fmu_without_experiments_could_not_be_judged(native_fmu: Path, tmp_path: Path) -> None:
    def alter(name: str, content: bytes) -> bytes | None:
        return None if name.startswith(OWN) else content

    bare = altered(native_fmu, tmp_path / "bare.fmu", alter)
    assert "carries no experiments" in " ".join(refused("validate", bare, "--own").split())


def test_another_tool_gets_the_results(fmu: Fmu) -> None:
    """The files of the FMU are enough: fmpy runs each experiment with its table of inputs."""
    experiments = own_experiments(fmu.path)
    assert len(experiments) == 3
    for experiment in experiments:
        scene = experiment.scene
        stimuli = fmu.folder / OWN / f"{scene.name}_in.csv"
        found = simulate_fmu(
            str(fmu.path),
            start_values=dict(scene.parameters),
            input=read_csv(str(stimuli)) if stimuli.is_file() else None,
            output=list(experiment.results),
            stop_time=scene.stop_time,
            output_interval=scene.step_size,
        )
        assert np.allclose(found["time"], experiment.times, rtol=0.0, atol=1e-9)
        for name, expected in experiment.results.items():
            off = np.abs(found[name] - expected).max() / np.abs(expected).max()
            assert off <= experiment.allowed, f"{scene.name}: {name}"
