"""`python -m harness` in a checkout: the commands of slider-resonator and those of the studies."""

import sys
from importlib import import_module
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import_module("studies.cli").main(prog_name="python -m harness")
