import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import Phase, settings
from hypothesis.internal.conjecture import providers

from fmu_src.building.closed_loop_ssp import build_closed_loop
from fmu_src.building.controller_fmu import build_controller
from fmu_src.building.native_fmu import build_native, build_native_3
from fmu_src.building.platforms import HOST
from fmu_src.building.python_fmu import build_python
from tests.harness.in_process import run_in_this_process

# On a CI server the tests add nothing to the page that the validation itself makes.
os.environ.pop("GITHUB_STEP_SUMMARY", None)

# The same examples in each run; `--hypothesis-profile=explore` looks for new ones.
settings.register_profile("same", derandomize=True, deadline=None)
settings.register_profile(
    "explore", deadline=None, max_examples=1000, phases=[Phase.explicit, Phase.generate]
)
settings.load_profile("same")
# Else examples change with every number in whatever modules happen to be loaded by then.
if hasattr(providers, "_get_local_constants"):
    providers._get_local_constants = lambda: providers._local_constants


@pytest.fixture(autouse=True)
def fmus_in_this_process(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run FMUs in this process, but in tests marked `isolated`."""
    if request.node.get_closest_marker("isolated") is None:
        run_in_this_process(monkeypatch)


def built(build: Callable[..., Path], **options: object) -> Any:
    """A fixture with an FMU, built once for the whole run; a native one for this machine only."""

    @pytest.fixture(scope="session")
    def fixture(tmp_path_factory: pytest.TempPathFactory) -> Path:
        return build(tmp_path_factory.mktemp("fmu"), **options)

    return fixture


python_fmu = built(build_python)
native_fmu = built(build_native, platforms=[HOST])
native_3_fmu = built(build_native_3, platforms=[HOST])
controller_fmu = built(build_controller, platforms=[HOST])


@pytest.fixture(scope="session")
def fmu(request: pytest.FixtureRequest) -> Path:
    """The Python FMU; in tests marked with `fmus.both_fmus` the native one as well."""
    found: Path = request.getfixturevalue(f"{getattr(request, 'param', 'python')}_fmu")
    return found


@pytest.fixture(scope="session")
def closed_loop_package(
    native_fmu: Path, controller_fmu: Path, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """The package of native slider and controller."""
    return build_closed_loop(tmp_path_factory.mktemp("closed_loop"), native_fmu, controller_fmu)
