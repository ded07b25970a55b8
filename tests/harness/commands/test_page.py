"""What the page does in a browser is tested with the other hosts."""

import shutil
import zipfile
from pathlib import Path

from tests.harness.calling import call, refused
from tests.harness.public_json import assert_public_keys

PAGE = '<head></head><script type="application/json" id="devices">{"table_1": "[device]"}</script>'


def fmu_with(page: str, folder: Path) -> Path:
    with zipfile.ZipFile(folder / "with_page.fmu", "w") as archive:
        archive.writestr("documentation/slider-resonator.html", page)
    return folder / "with_page.fmu"


def test_the_page_is_in_the_fmu_or_beside_it(native_fmu: Path, tmp_path: Path) -> None:
    beside = Path(shutil.copy(native_fmu, tmp_path))
    (tmp_path / "slider-resonator.html").write_text(PAGE, encoding="utf-8")
    for fmu in (fmu_with(PAGE, tmp_path), beside):
        out = tmp_path / f"{fmu.stem}.html"
        assert_public_keys("page", call("page", fmu, "--out", out, "--json").stdout)
        assert out.read_text(encoding="utf-8") == PAGE


def test_device_and_inputs_are_those_to_start_from(tmp_path: Path) -> None:
    out = tmp_path / "page.html"
    settings = ("--set", "base_amplitude=1 um", "phase=0.5")
    call("page", fmu_with(PAGE, tmp_path), *settings, "--out", out)
    text = out.read_text(encoding="utf-8")
    assert 'id="devices">{"mine": "title = \\"Your device\\"' in text
    assert "base_amplitude = 1e-06" in text
    assert 'location.hash ||= "phase=0.5"' in text
    call("page", fmu_with(PAGE, tmp_path), "--device", "conveyor", "--out", out)
    assert '"mine": "title = \\"A part on a vibratory conveyor' in out.read_text(encoding="utf-8")


def test_an_fmu_without_a_page_is_refused(native_fmu: Path, tmp_path: Path) -> None:
    out = tmp_path / "page.html"
    assert "must be a native FMU for all platforms" in refused("page", native_fmu, "--out", out)
    for page in ("<html></html>", PAGE.replace("}", "")):
        old = fmu_with(page, tmp_path)
        assert "has no list of devices" in refused("page", old, "--out", out)
    damaged = old.read_bytes()
    old.write_bytes(damaged.replace(b"<head>", b"<hand>"))
    assert "its page cannot be read" in refused("page", old, "--out", out)
    assert not out.exists()
