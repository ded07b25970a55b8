"""Results on disk: what was measured, under a key that changes with all that it depends on."""

from __future__ import annotations

import hashlib
import inspect
import json
from collections.abc import Mapping
from pathlib import Path
from types import FunctionType
from typing import Any

from slider_resonator import references
from slider_resonator.output.atomic import replacing
from slider_resonator.output.json_output import to_json
from slider_resonator.output.targets import make_folder
from slider_resonator.steady import blocking_force as blocking
from slider_resonator.steady import bracketing, bristle_reading, newton, periodic, search, shooting
from slider_resonator.steady import steady_velocity as steady
from slider_resonator.studies.paper import mapping, measure

_SHOOTING = (blocking, bracketing, bristle_reading, newton, periodic, search, shooting, steady)


def key_of(parameters: Mapping[str, Any], fmu_guid: str, measurement: FunctionType) -> str:
    """Return a digest of the parameters, the FMU's GUID, and the code that results come from.

    That is the code that measures, and all references, which theory lines and deviations are from.
    """
    digest = hashlib.sha256()
    digest.update(to_json({"parameters": parameters, "guid": fmu_guid}).encode())
    sources = [inspect.getsourcefile(code) for code in (measurement, mapping, measure, *_SHOOTING)]
    for source in (*sources, *sorted(Path(references.__path__[0]).glob("*.py"))):
        if source is not None:
            digest.update(Path(source).read_bytes())
    return digest.hexdigest()


def stored(path: Path, key: str) -> Any | None:
    """Return the data stored at ``path`` under this key, None where there are none."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    if not isinstance(content, dict) or content.get("key") != key:
        return None
    return content.get("data")


def store(path: Path, key: str, data: Any) -> Any:
    """Write data under a key, in a folder made if need be, and return them as they will be read.

    Raises HarnessError when the file cannot be written.
    """
    text = to_json({"key": key, "data": data})
    make_folder(path.parent)
    with replacing(path) as temporary:
        temporary.write_text(text + "\n", encoding="utf-8")
    return json.loads(text)["data"]
