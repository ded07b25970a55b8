"""A C function for each text of a refusal that the twins share.

Its arguments are the fields of the text, in their order: a number {x!r} becomes a double, shown
with the fewest digits that read back as the same number, as repr does; an integer {x:d} becomes a
long long, and a text {x} a text.
"""

import json
from string import Formatter

from fmu_src.generators.c_header import c_header
from fmu_src.python.slider_component import refusal_texts


def c_refusal_texts() -> str:
    """Return the text of refusal_texts.h."""
    texts = {name: text for name, text in vars(refusal_texts).items() if name.isupper()}
    return c_header(
        "Refusals that the twins share: each function writes its text and returns false.",
        "python/slider_component/refusal_texts.py",
        '#include "refusal.h"\n' + "".join(c_function(*entry) for entry in texts.items()),
    )


def c_function(name: str, text: str) -> str:
    """Return the C function for a text.

    Raises ValueError for a text that shows an argument twice or in a form that C cannot show.
    """
    form, numbers, parameters, arguments = "", [], ["Refusal *refusal"], list[str]()
    for literal, field, shape, conversion in Formatter().parse(text):
        form += literal.replace("%", "%%")
        if field is None:
            continue
        kind = {("r", ""): "double ", (None, "d"): "long long ", (None, ""): "const char *"}.get(
            (conversion, shape or "")
        )
        if kind is None or f"{kind}{field}" in parameters:
            raise ValueError(f"{text!r} must show {field} once, as text, by !r or by :d")
        parameters.append(f"{kind}{field}")
        if conversion:
            numbers.append(field)
        arguments.append(f"number_text({field}, {field}_text)" if conversion else field)
        form += "%lld" if shape else "%s"
    lines = ["refusal", json.dumps(form), *([", ".join(arguments)] if arguments else [])]
    call = ",\n                  ".join(lines)
    return (
        f"\nstatic inline bool refuse_{name.lower()}({', '.join(parameters)}) {{\n"
        + "".join(f"    char {field}_text[NUMBER_SIZE];\n" for field in numbers)
        + f"    return refuse({call});\n}}\n"
    )
