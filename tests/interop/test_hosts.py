"""Table 1 in every host, compared with fmpy: each fidelity and friction law; the closed loop."""

import sys
from pathlib import Path

import numpy as np
import pytest

from slider_resonator.device.interface import OUTPUTS
from slider_resonator.errors import HarnessError
from studies.closed_loop.duty import Duty
from studies.closed_loop.judge import judge_agreement, judge_interval
from studies.closed_loop.loop import HOSTS, run_loop
from studies.closed_loop.prediction import predicted_errors
from studies.hosts.hosts import OWN_ENVIRONMENTS, Host, hosts
from studies.hosts.runs import ALLOWED, CASES, FMI_3, by_case, run_host, run_jobs, table_1_jobs
from tests.harness.faulty_fmus import altered
from tests.processes import ROOT, run_command

pytestmark = pytest.mark.interop

ALLOWED_OF_FMI_3 = 1e-13
"""Share of the peak by which FMI 3.0, stopping at all events in fmpy, may differ from FMI 2.0."""

FMPY, *OTHERS = hosts(ROOT / OWN_ENVIRONMENTS)
(LINUX,) = (host for host in OTHERS if host.module == "driver_host")
(WINDOWS,) = (host for host in OTHERS if host.module == "wine_host")


@pytest.mark.parametrize(
    "host", [host for host in (FMPY, *OTHERS) if host != WINDOWS], ids=lambda host: host.name
)
def test_table_1_gives_the_numbers_of_fmpy(
    host: Host, native_fmu: Path, python_fmu: Path, native_3_fmu: Path
) -> None:
    try:
        results = run_host(host, FMPY, native_fmu, python_fmu, native_3_fmu)
    except HarnessError as error:
        pytest.fail(str(error))
    assert [result.fmu for result in results] == expected_fmus(host.name)
    for result in results:
        for case, comparison in result.comparisons.items():
            assert comparison.error is None, f"{result.fmu}, {case.title}: {comparison.error}"
            allowed = ALLOWED_OF_FMI_3 if result.fmu == FMI_3 else ALLOWED
            assert comparison.deviation is not None
            assert comparison.deviation <= allowed, f"{result.fmu}, {case.title}"


def expected_fmus(host: str) -> list[str]:
    if host in ("fmpy", "newest fmpy", "ecos"):
        return ["native", "Python", FMI_3]
    if host in ("libcosimpy", "pathsim-fmi", "cofmupy"):
        return ["native", "Python"]
    return ["native behind Python"] if host == "fmu_manipulation_toolbox" else ["native"]


def test_windows_gives_the_bits_of_linux(native_fmu_for_wine: Path) -> None:
    """By the Windows binary in Wine, from the C driver, which is compared with fmpy above."""
    jobs = table_1_jobs(native_fmu_for_wine)
    linux, windows = (run_jobs(host, jobs) for host in (LINUX, WINDOWS))
    for case, ours, theirs in zip(CASES, linux, windows, strict=True):
        assert ours.error is None, f"{case.title}: {ours.error}"
        assert theirs.error is None, f"{case.title}: {theirs.error}"
        differ = (np.asarray(ours.rows) != np.asarray(theirs.rows)).any(axis=0)
        names = [name for name, other in zip(OUTPUTS, differ, strict=True) if other]
        assert names == [], f"{case.title}: other bits in Wine"


def test_sources_compiled_by_fmutool_give_the_same_numbers(
    native_fmu: Path, tmp_path: Path
) -> None:
    """By a tool that knows only the description."""
    stripped, compiled = tmp_path / "stripped.fmu", tmp_path / "compiled.fmu"
    altered(native_fmu, stripped, lambda name, text: None if name[:8] == "binaries" else text)
    fmutool = Path(sys.executable).with_name("fmutool")
    done = run_command(fmutool, "-input", stripped, "-compile-sources", "-output", compiled)
    assert compiled.is_file(), done.stdout + done.stderr
    ours = [answer.rows for answer in run_jobs(FMPY, table_1_jobs(native_fmu))]
    compared = by_case(ours, run_jobs(FMPY, table_1_jobs(compiled)))
    failed = {case.title: compared[case] for case in CASES if not compared[case].passed}
    assert failed == {}, "another compiler must not make another motion"


@pytest.mark.parametrize("host", HOSTS[1:], ids=lambda host: host.name)
def test_another_master_matches_fmpy_in_closed_loop(closed_loop_package: Path, host: Host) -> None:
    """Masters that hand values on without fmpy's delay of the inputs."""
    duty = Duty()
    fmpy, other = (run_loop(closed_loop_package, chosen, duty) for chosen in (HOSTS[0], host))
    for record in other:
        held = [judge_interval(record, duty, interval) for interval in duty.intervals]
        failed = [one for one in held if not one.passed]
        assert failed == [], "the velocity has to come back after each step of the load"
    predicted = predicted_errors(closed_loop_package, other[0], duty)
    for agreement in judge_agreement(*other, duty, predicted):
        assert agreement.passed, agreement
    for theirs, ours in zip(other, fmpy, strict=True):
        ends = np.searchsorted(
            ours.times, [interval.end - 0.5 * duty.step for interval in duty.intervals]
        )
        assert theirs.velocity[ends] == pytest.approx(ours.velocity[ends], rel=1e-3)
        assert theirs.phase[ends] == pytest.approx(ours.phase[ends], abs=1e-3)
