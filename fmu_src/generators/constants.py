"""The constants of the twins as macros of C, from the Python module that defines them."""

from fmu_src.generators.c_header import c_header
from fmu_src.python.slider_component import constants


def c_constants() -> str:
    """Return the text of constants.h; repr gives texts that read back as the same numbers."""
    macros = [f"#define {k} {v!r}\n" for k, v in vars(constants).items() if k.isupper()]
    source = "python/slider_component/constants.py"
    return c_header("Constants that the twins share.", source, "".join(macros))
