"""Table 1 in every host: each fidelity with each friction law, compared with fmpy."""

from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from studies.hosts.hosts import OWN_ENVIRONMENTS, Host, hosts
from studies.hosts.runs import ALLOWED, FMI_3, run_host

pytestmark = pytest.mark.interop

ALLOWED_OF_FMI_3 = 1e-13
"""Share of the peak by which FMI 3.0, stopping at all events in fmpy, may differ from FMI 2.0."""

HOSTS = hosts(Path(__file__).parents[2] / OWN_ENVIRONMENTS)


@pytest.mark.parametrize("host", HOSTS, ids=lambda host: host.name)
def test_table_1_gives_the_numbers_of_fmpy(
    host: Host, native_fmu_for_wine: Path, python_fmu: Path, native_3_fmu: Path
) -> None:
    try:
        results = run_host(host, HOSTS[0], native_fmu_for_wine, python_fmu, native_3_fmu)
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
