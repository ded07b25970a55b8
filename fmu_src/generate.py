"""Write the files that are generated from the tables and texts of the Python component.

`python -m fmu_src.generate` rewrites all of them. They are committed, so that the C sources can be
read and compiled without Python; a test checks that they are current.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from fmu_src.controller.variables import VARIABLES as CONTROLLER_VARIABLES
from fmu_src.generators.constants import c_constants
from fmu_src.generators.parameters import c_parameters, python_parameters
from fmu_src.generators.refusal_texts import c_refusal_texts
from fmu_src.generators.variable_table import c_controller_table, c_table
from fmu_src.python.slider_component.variables import VARIABLES
from fmu_src.sources import C_SOURCES, CONTROLLER_SOURCES, PACKAGE


def generated_files() -> Mapping[Path, str]:
    """Path -> text of every generated file; equal sources give equal texts."""
    return {
        **_in(C_SOURCES, c_table(VARIABLES)),
        **_in(CONTROLLER_SOURCES, c_controller_table(CONTROLLER_VARIABLES)),
        C_SOURCES / "parameters.h": c_parameters(VARIABLES),
        PACKAGE / "parameters.py": python_parameters(VARIABLES),
        C_SOURCES / "constants.h": c_constants(),
        C_SOURCES / "refusal_texts.h": c_refusal_texts(),
    }


def _in(folder: Path, files: Mapping[str, str]) -> dict[Path, str]:
    return {folder / name: text for name, text in files.items()}


def main() -> None:
    """Rewrite the generated files."""
    for path, text in generated_files().items():
        path.write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
