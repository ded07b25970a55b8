from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import Phase, settings

from build_fmu import build_python

# The same examples in each run; `--hypothesis-profile=explore` looks for new ones.
settings.register_profile("same", derandomize=True, deadline=None)
settings.register_profile(
    "explore", deadline=None, max_examples=1000, phases=[Phase.explicit, Phase.generate]
)
settings.load_profile("same")


@pytest.fixture(scope="session")
def python_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The Python FMU, built once for the whole run."""
    return build_python(tmp_path_factory.mktemp("fmu"))
