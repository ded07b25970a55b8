"""Write the files that are generated from the tables and texts of the Python component.

`python -m fmu_src.generate` rewrites parameters.py, which is committed: a test checks that it is
current. `python -m fmu_src.generate FOLDER` also writes all C sources, as a build compiles them,
to FOLDER/slider, FOLDER/slider_3 (FMI 3.0) and FOLDER/controller.
"""

import argparse
from pathlib import Path

from fmu_src.building.c_sources import controller_sources, slider_sources, write_sources
from fmu_src.generators.parameters import python_parameters
from fmu_src.python.slider_component.variables import VARIABLES
from fmu_src.sources import PACKAGE


def main() -> None:
    """Rewrite parameters.py; write the C sources into a folder if one is named."""
    parser = argparse.ArgumentParser(prog="python -m fmu_src.generate", description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?")
    folder = parser.parse_args().folder
    text = python_parameters(VARIABLES)
    (PACKAGE / "parameters.py").write_text(text, encoding="utf-8", newline="\n")
    if folder is not None:
        write_sources(slider_sources(), folder / "slider")
        write_sources(slider_sources("3.0"), folder / "slider_3")
        write_sources(controller_sources(), folder / "controller")


if __name__ == "__main__":
    main()
