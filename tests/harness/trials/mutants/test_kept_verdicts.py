from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.trials.mutants.kept_verdicts import KeptVerdicts
from slider_resonator.trials.mutants.mutant import Mutant
from slider_resonator.trials.mutants.verdict import REJECTED, SURVIVED, MutantVerdict

FIRST, SECOND = (
    Mutant("a.py", "p/a.py", line, 1, "sign", "- is dropped", 1, "-1", "1") for line in (1, 2)
)
VERDICTS = (
    MutantVerdict(FIRST, REJECTED, "off by 2 m", "scene", "position"),
    MutantVerdict(SECOND, SURVIVED, "in probe_1: \u00e9"),
)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "verdicts"
    kept = KeptVerdicts(path, "digest", [FIRST, SECOND])
    for verdict in VERDICTS:
        kept.add(verdict)
    kept.close()
    return path


def read(path: Path, digest: str = "digest") -> list[MutantVerdict]:
    kept = KeptVerdicts(path, digest, [FIRST, SECOND])
    kept.close()
    return list(kept.verdicts.values())


def test_verdicts_come_back(path: Path) -> None:
    assert read(path) == list(VERDICTS)


def test_damaged_and_cut_off_lines_are_tried_again(path: Path) -> None:
    text = path.read_text()
    path.write_text(text.replace("off by 2 m", "off by 3 m"))
    assert read(path) == [VERDICTS[1]]
    path.write_text(text[:-4])
    assert read(path) == [VERDICTS[0]]
    kept = KeptVerdicts(path, "digest", [FIRST, SECOND])
    kept.add(VERDICTS[1])
    kept.close()
    assert read(path) == list(VERDICTS), "what follows a line that was cut off must be readable"


def test_verdicts_of_another_run_are_refused(path: Path) -> None:
    with pytest.raises(HarnessError, match="holds verdicts of another run; must be of this FMU"):
        read(path, "other")
    path.write_text("something else\n")
    with pytest.raises(HarnessError, match="holds verdicts of another run"):
        read(path)


def test_a_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(HarnessError, match="cannot be read"):
        read(tmp_path)
