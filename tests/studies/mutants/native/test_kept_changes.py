from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from studies.mutants.kept_verdicts import open_journal
from studies.mutants.native.change_verdict import ChangeVerdict
from studies.mutants.native.changes import Change
from studies.mutants.native.kept_changes import entry_of, verdicts_on

FAULT = Change("no_drag", "device/stick.c", "-1", "1", "friction drives")
ON_FAULT = ChangeVerdict(FAULT, True, "scene", "position", "off by 2 m")


def test_a_verdict_comes_back_unless_the_changed_text_is_another(tmp_path: Path) -> None:
    fmu, path = tmp_path / "my.fmu", tmp_path / "kept"
    fmu.write_bytes(b"content")
    with open_journal(path, fmu, []) as journal:
        journal.add([entry_of(ON_FAULT)])
    with open_journal(path, fmu, []) as journal:
        assert verdicts_on(journal, [FAULT]) == {"no_drag": ON_FAULT}
        explained = replace(FAULT, survives="rounding")
        assert verdicts_on(journal, [explained])["no_drag"].change == explained
        assert verdicts_on(journal, [replace(FAULT, new="2")]) == {}
