from __future__ import annotations

from pathlib import Path

from slider_resonator.scenes.scene import read_scene
from studies.mutants.archive import read_python_fmu
from studies.mutants.reach import noting_source, reaches
from studies.mutants.trial import ExpectedPoint
from tests.harness import faulty_fmus

MODULE = '''"""A module."""
from __future__ import annotations

def sign(x):
    if x > 0:
        return 1
    elif x < 0:
        return -1
    def nothing():
        return 0
    return nothing()
'''


def test_a_noting_module_does_as_before_and_notes_its_lines() -> None:
    namespace: dict[str, object] = {}
    exec(noting_source(MODULE), namespace)
    sign, noted = namespace["sign"], namespace["_noted_lines"]
    assert callable(sign)
    assert isinstance(noted, set)
    for x, expected, lines in ((2, 1, {5, 6}), (-2, -1, {5, 7, 8}), (0, 0, {5, 7, 10, 11})):
        noted.clear()
        assert sign(x) == expected
        assert noted == lines


def test_a_scene_reaches_what_its_device_asks_for(python_fmu: Path, tmp_path: Path) -> None:
    slipping = faulty_fmus.scene(tmp_path, "slipping")
    sticking = faulty_fmus.scene(tmp_path, "sticking")
    text = sticking.read_text()
    sticking.write_text(text.replace("[run]", "[device]\nbase_amplitude = 0.0\n\n[run]"))
    lugre = {"friction_law": 1.0}
    points = [
        ExpectedPoint(read_scene(file, at), at)
        for file, at in ((slipping, {}), (sticking, {}), (slipping, lugre))
    ]
    reached = reaches(read_python_fmu(python_fmu), points, 60.0, jobs=1)
    found = [{file for file, _ in reach.places} for reach in reached]
    assert "first_zero.py" in found[0]
    assert "first_zero.py" not in found[1]
    assert "oscillator.py" in found[1]
    assert "lugre.py" in found[2]
    assert "lugre.py" not in found[0] | found[1]
    assert all("mean_friction.py" in files for files in found), "its rule is made at loading"
