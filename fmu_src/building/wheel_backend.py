"""The build backend of the package: setuptools, with the finished FMUs packed into the wheel.

    pip wheel . --config-setting fmus=dist     packs the files of a folder instead of building them

An editable installation packs nothing: it uses the folder `dist` of the checkout.
"""

import shutil
import tomllib
from collections.abc import Mapping
from pathlib import Path

from setuptools import build_meta

ROOT = Path(__file__).resolve().parents[2]
FINISHED = ROOT / "harness" / "slider_resonator" / "finished"
"""In the package only while a wheel is made: in a checkout it would hide newer files in `dist`."""

SUFFIXES = (".fmu", ".ssp", ".html")

Settings = Mapping[str, str | list[str]] | None

build_sdist = build_meta.build_sdist
build_editable = build_meta.build_editable
get_requires_for_build_sdist = build_meta.get_requires_for_build_sdist
get_requires_for_build_editable = build_meta.get_requires_for_build_editable
prepare_metadata_for_build_wheel = build_meta.prepare_metadata_for_build_wheel
prepare_metadata_for_build_editable = build_meta.prepare_metadata_for_build_editable


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    """Return what builds the FMUs: the extra `build`, and fmpy for the headers of FMI."""
    if _given_folder(config_settings) is not None:
        return []
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    fmpy = [name for name in project["dependencies"] if name.startswith("fmpy")]
    return [*fmpy, *project["optional-dependencies"]["build"]]


def build_wheel(
    wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None
) -> str:
    """Build the wheel in a folder and return its file name."""
    given = _given_folder(config_settings)
    shutil.rmtree(FINISHED, ignore_errors=True)
    try:
        if given is None:
            _build(FINISHED)
        else:
            _copy(given, FINISHED)
        return str(build_meta.build_wheel(wheel_directory, None, metadata_directory))
    finally:
        shutil.rmtree(FINISHED, ignore_errors=True)


def _given_folder(settings: Settings) -> Path | None:
    folder = (settings or {}).get("fmus")
    if folder is None:
        return None
    if not isinstance(folder, str):
        raise ValueError(f"fmus = {folder!r}: must be one folder")
    return ROOT / folder


def _copy(source: Path, target: Path) -> None:
    files = [path for path in source.iterdir() if path.suffix in SUFFIXES]
    if not any(path.suffix == ".fmu" for path in files):
        raise FileNotFoundError(f"{source}: no FMU in this folder; `make build` builds them")
    target.mkdir()
    for path in files:
        shutil.copy(path, target)


def _build(target: Path) -> None:
    # Imported here: an editable installation needs none of what this needs.
    import build_fmu

    if build_fmu.main(["--out", str(target)]) != 0:
        raise RuntimeError("the FMUs could not be built; see the messages above")
