from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from studies.mutants.kept_verdicts import entry_of, open_journal, verdicts_on
from studies.mutants.mutant import Mutant
from studies.mutants.trial import ExpectedPoint
from studies.mutants.verdict import REJECTED, SURVIVED, MutantVerdict
from tests.harness.scene_text import scene_of

FIRST, SECOND = (
    Mutant("a.py", "p/a.py", line, 1, "sign", "- is dropped", 1, "-1", "1") for line in (1, 2)
)
ON_MUTANTS = (
    MutantVerdict(FIRST, REJECTED, "off by 2 m", "scene", "position"),
    MutantVerdict(SECOND, SURVIVED, "in probe_1: \u00e9"),
)


@pytest.fixture
def fmu(tmp_path: Path) -> Path:
    path = tmp_path / "my.fmu"
    path.write_bytes(b"content")
    return path


def test_verdicts_on_come_back(tmp_path: Path, fmu: Path) -> None:
    with open_journal(tmp_path / "kept", fmu, []) as journal:
        journal.add(map(entry_of, ON_MUTANTS))
    with open_journal(tmp_path / "kept", fmu, []) as journal:
        kept = verdicts_on(journal, [FIRST, SECOND])
        assert list(kept.values()) == list(ON_MUTANTS)
        assert list(verdicts_on(journal, [SECOND])) == [SECOND.name]


def test_verdicts_on_another_fmu_or_by_other_scenes_are_refused(tmp_path: Path, fmu: Path) -> None:
    with open_journal(tmp_path / "kept", fmu, []):
        pass
    scene = scene_of("")
    with pytest.raises(HarnessError, match="is of another mutation run, another FMU"):
        open_journal(tmp_path / "kept", fmu, [ExpectedPoint(scene)])
    fmu.write_bytes(b"other content")
    with pytest.raises(HarnessError, match="move the file away or name another one"):
        open_journal(tmp_path / "kept", fmu, [])
