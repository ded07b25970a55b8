"""The page as a file; what it does in a browser is tested with the other hosts."""

import json
import re
from pathlib import Path

import pytest

from fmu_src.building import build_folder, cache, platforms
from fmu_src.building.native_fmu import build_native
from fmu_src.building.web_page import NAME, build_page
from fmu_src.python.slider_component.variables import VARIABLES
from studies.mutants.archive import files_in


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_page(tmp_path_factory.mktemp("page"))


@pytest.mark.slow
def test_the_fmu_for_all_platforms_has_the_page(
    page: Path, native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(platforms, "PLATFORMS", {"linux64": platforms.PLATFORMS["linux64"]})
    inside = f"documentation/{NAME}"
    assert files_in(build_native(tmp_path))[inside] == page.read_bytes()
    assert inside not in files_in(native_fmu)


@pytest.mark.slow
def test_equal_sources_give_equal_bytes(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in (build_folder, cache):  # compiled anew, in another folder
        monkeypatch.setattr(module, "cache_folder", lambda: None)
    assert build_page(tmp_path).read_bytes() == page.read_bytes()


@pytest.mark.interop
def test_one_small_file_that_names_no_other(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert len(text.encode()) <= 300_000
    assert re.findall(r"""(?:src|href)=["'](?!data:)""", text) == []
    assert "{{" not in re.sub(r"<script>.*?</script>", "", text, flags=re.DOTALL)


@pytest.mark.interop
def test_every_variable_is_known_by_its_value_reference(page: Path) -> None:
    found = re.search(r'id="variables">(.*?)</script>', page.read_text(encoding="utf-8"))
    assert found is not None
    rows = json.loads(found[1])
    assert [(row["reference"], row["name"]) for row in rows] == [
        (reference, variable.name) for reference, variable in enumerate(VARIABLES)
    ]
