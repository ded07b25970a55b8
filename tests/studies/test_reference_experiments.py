"""The experiments that FMUs carry: results of references, which a script writes."""

import numpy as np
import pytest

from studies.reference_experiments import FOLDER, files

ROUNDING = {"table_1": 1e-10, "lugre": 1e-7, "changing_inputs": 1e-10}
"""Share of the peak within which references agree on two platforms."""
FILES = files()


def test_the_stored_files_are_those_of_the_script() -> None:
    assert {path.name for path in FOLDER.iterdir()} == FILES.keys()
    for name, content in FILES.items():
        if not name.endswith("_ref.csv"):
            assert (FOLDER / name).read_bytes() == content, name


@pytest.mark.parametrize("name", ROUNDING)
def test_the_stored_results_are_those_of_the_references(name: str) -> None:
    stored = (FOLDER / f"{name}_ref.csv").read_text(encoding="utf-8").splitlines()
    written = FILES[f"{name}_ref.csv"].decode().splitlines()
    assert stored[0] == written[0]
    old, new = (np.loadtxt(lines, delimiter=",", skiprows=1) for lines in (stored, written))
    assert np.all(np.abs(old - new) <= ROUNDING[name] * np.abs(old).max(axis=0))
