"""The exported tree, read by the cross-check code of FMPy and compared with what it must hold."""

from __future__ import annotations

from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.cross_check.cross_check import cross_check
from fmpy.cross_check.validate_vendor_repo import validate_repo
from fmpy.util import read_csv

from slider_resonator.device.device import Device
from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fmu.drive import instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.references.resolved import located_events
from slider_resonator.trials.crosscheck.cases import CASES, OUTPUTS, STEP_SIZE, Case
from slider_resonator.trials.crosscheck.export import export, input_rows
from slider_resonator.trials.crosscheck.importer import imported

TOOL = "slider-resonator"


@pytest.fixture(scope="module")
def tree(native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("crosscheck")
    with open_fmu(native_fmu) as fmu, instantiate(fmu) as instance:
        export(instance, out, TOOL)
    return out


def case_folder(tree: Path, name: str) -> Path:
    platform: str = fmpy.platform
    (folder,) = (tree / "fmus" / "2.0" / "cs" / platform / TOOL).glob(f"*/{name}")
    return folder


def test_a_tree_that_cannot_be_finished_is_not_begun(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    copies: list[str] = []

    def full_disk(_source: object, target: Path) -> None:
        copies.append(target.name)
        if len(copies) == len(CASES):
            raise OSError(28, "No space left on device")
        target.write_bytes(b"")

    monkeypatch.setattr("slider_resonator.trials.crosscheck.export.shutil.copyfile", full_disk)
    full = pytest.raises(HarnessError, match="cannot be written: No space left")
    with open_fmu(native_fmu) as fmu, instantiate(fmu) as instance, full:
        export(instance, tmp_path, TOOL)
    assert list(tmp_path.iterdir()) == [], "the next export meets no half of this one"


def test_fmpy_finds_nothing_wrong_with_the_repository(tree: Path) -> None:
    fmus, _, problems = validate_repo(str(tree))
    assert fmus == 2 * len(CASES), "each case for this platform and as C sources"
    assert problems == []


def test_fmpy_repeats_every_run_and_passes_it(
    tree: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # FMPy draws with plotly, which its checks do not need.
    monkeypatch.setattr("fmpy.cross_check.cross_check.plot_result", lambda *args, **options: None)

    def simulate(options: dict[str, object]) -> np.ndarray:
        result: np.ndarray = fmpy.simulate_fmu(
            options["fmu_filename"],
            step_size=options["step_size"],
            stop_time=options["stop_time"],
            input=read_csv(options["input_filename"]),
            output=options["output_variable_names"],
        )
        return result

    results = tmp_path / "results"
    arguments = (str(tree / "fmus"), str(tmp_path / "report.html"), str(results), simulate)
    cross_check(*arguments, "FMPy", fmpy.__version__, lambda options: False, None)
    assert len(list(results.rglob("passed"))) == 2 * len(CASES)
    assert not [*results.rglob("failed"), *results.rglob("rejected")]
    assert 'class="label label-danger"' not in (tmp_path / "report.html").read_text()


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_reference_results_are_those_of_the_equations(tree: Path, case: Case) -> None:
    reference = read_csv(case_folder(tree, case.name) / f"{case.name}_ref.csv")
    assert reference.dtype.names == ("time", *OUTPUTS)
    motion = located_events.simulate(Device(), case.schedule.held(), reference["time"])
    for name in ("position", "velocity", "resonator_displacement", "normal_force"):
        expected = getattr(motion, name)
        error = np.abs(reference[name] - expected).max()
        assert error < 1e-8 * np.abs(expected).max(), name
    assert reference["reversals"][-1] == motion.reversals


def test_a_case_has_the_files_of_the_rules(tree: Path) -> None:
    for case in CASES:
        folder = case_folder(tree, case.name)
        found = {path.name for path in folder.iterdir()}
        endings = (".fmu", "_in.csv", "_ref.csv", "_ref.opt")
        assert found == {"ReadMe.md", *(f"{case.name}{end}" for end in endings)}
        header = (folder / f"{case.name}_in.csv").read_text().splitlines()[0]
        assert header == '"time","phase","load","frequency_ratio"'


def test_inputs_jump_at_communication_points_only() -> None:
    for case in CASES:
        rows = np.array(input_rows(case))
        assert np.allclose(rows[:, 0] / STEP_SIZE, np.rint(rows[:, 0] / STEP_SIZE), atol=1e-9)
        assert (np.diff(rows[:, 0]) >= 0.0).all()
        assert [rows[0, 0], rows[-1, 0]] == [0.0, case.schedule.times[-1]]


def test_a_wrong_reference_is_found(tree: Path, tmp_path: Path) -> None:
    folder = case_folder(tree, CASES[0].name)
    copy = tmp_path / folder.relative_to(tree)
    copy.mkdir(parents=True)
    for path in folder.iterdir():
        (copy / path.name).write_bytes(path.read_bytes())
    assert imported(copy).passed
    file = copy / f"{copy.name}_ref.csv"
    header, *rows = file.read_text().splitlines()
    turned = [f"{row.split(',')[0]},{','.join(['0.05'] * len(OUTPUTS))}" for row in rows]
    file.write_text("\n".join([header, *turned]) + "\n")
    result = imported(copy)
    assert "outside FMPy's tube" in result.problems[0]
    file.write_text("\n".join([header.replace("velocity", "speed"), *rows]) + "\n")
    assert "does not exist in the FMU" in imported(copy).problems[0]


def test_nothing_is_overwritten(tree: Path, native_fmu: Path) -> None:
    with (
        open_fmu(native_fmu) as fmu,
        instantiate(fmu) as instance,
        pytest.raises(HarnessError, match="is there already"),
    ):
        export(instance, tree, TOOL)


def test_an_fmu_that_needs_python_is_refused(python_fmu: Path, tmp_path: Path) -> None:
    with (
        open_fmu(python_fmu) as fmu,
        instantiate(fmu) as instance,
        pytest.raises(FmuError, match="needs a Python interpreter"),
    ):
        export(instance, tmp_path, TOOL)
