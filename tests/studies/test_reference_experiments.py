"""The experiments that FMUs carry: results of references, which a script writes."""

import numpy as np
import pytest

from studies.reference_experiments import FOLDER, files

ROUNDING = {"table_1": 1e-10, "lugre": 1e-7, "changing_inputs": 1e-10}
"""Share of the peak within which references agree on two platforms."""


@pytest.fixture(scope="module")
def written() -> dict[str, bytes]:
    return files()


def test_the_stored_files_are_those_of_the_script(written: dict[str, bytes]) -> None:
    assert {path.name for path in FOLDER.iterdir()} == written.keys()
    for name, content in written.items():
        if not name.endswith("_ref.csv"):
            assert (FOLDER / name).read_bytes() == content, name


@pytest.mark.parametrize("name", ROUNDING)
def test_the_stored_results_are_those_of_the_references(
    written: dict[str, bytes], name: str
) -> None:
    stored = (FOLDER / f"{name}_ref.csv").read_text(encoding="utf-8").splitlines()
    lines = written[f"{name}_ref.csv"].decode().splitlines()
    assert stored[0] == lines[0]
    old, new = (np.loadtxt(rows, delimiter=",", skiprows=1) for rows in (stored, lines))
    assert np.all(np.abs(old - new) <= ROUNDING[name] * np.abs(old).max(axis=0))
