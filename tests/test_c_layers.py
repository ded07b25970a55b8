"""The layers of the C sources: they hold, and an include against them is found."""

import sys
from pathlib import Path

import pytest

from fmu_src.c_layers import faults_of, main
from fmu_src.sources import C_SOURCES, CONTROLLER_SOURCES


def sources_in(root: Path) -> dict[str, str]:
    files = root.rglob("*.[ch]")
    return {path.relative_to(root).as_posix(): path.read_text("utf-8") for path in files}


@pytest.mark.parametrize("root", [C_SOURCES, CONTROLLER_SOURCES], ids=["slider", "controller"])
def test_sources_keep_their_layers(root: Path) -> None:
    assert sources_in(root)
    assert faults_of(sources_in(root)) == []


@pytest.mark.parametrize(
    ("including", "included", "broken"),
    [
        ("device/plant.h", "../leap/leap.h", "includes leap/leap.h, which is above it"),
        ("base/refusal.c", "../component/variables.h", "variables.h, which is above it"),
        (
            *("friction/bristle.h", "system.h"),
            "friction/bristle includes friction/system includes friction/bristle: a circle",
        ),
        (
            *("friction/system.c", "bending_panel.h"),
            "friction/bending_panel includes friction/system includes friction/bending_panel",
        ),
        ("device/plant.c", "../../controller/c/component/control.h", "which is in no layer"),
    ],
)
def test_planted_include_is_found(including: str, included: str, broken: str) -> None:
    sources = sources_in(C_SOURCES)
    sources[including] = f'#include "{included}"\n{sources[including]}'
    faults = "\n".join(faults_of(sources))
    assert broken in faults
    assert including.partition(".")[0] in faults


@pytest.mark.parametrize(
    ("name", "broken"),
    [
        ("stray.h", "stray.h: must be in one of the folders base, device, "),
        ("tools/stray.h", "tools/stray.h: must be in one of the folders base, device, "),
        ("leap/plant.c", "leap/plant.c: device/plant.c has the same name; must be unique"),
    ],
)
def test_misplaced_file_is_found(name: str, broken: str) -> None:
    assert broken in "\n".join(faults_of(sources_in(C_SOURCES) | {name: ""}))


def test_command_fails_with_faults_and_without_sources(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """As `make lint` runs it."""
    monkeypatch.setattr(sys, "argv", ["c_layers", str(tmp_path)])
    with pytest.raises(SystemExit, match="1"):
        main()
    (tmp_path / "stray.h").touch()
    with pytest.raises(SystemExit, match="1"):
        main()
    assert "stray.h: must be in one of the folders" in capsys.readouterr().out
    monkeypatch.setattr(sys, "argv", ["c_layers"])
    with pytest.raises(SystemExit, match="0"):
        main()
