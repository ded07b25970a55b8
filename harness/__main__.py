"""`python -m harness` in a checkout is `slider-resonator`, from the sources beside this file."""

import sys
from importlib import import_module
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import_module("slider_resonator.cli").main(prog_name="python -m harness")
