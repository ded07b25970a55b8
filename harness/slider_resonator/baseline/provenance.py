"""The provenance of golden results: FMU, scene, host and tools."""

from __future__ import annotations

import hashlib
import os
import platform
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import fmpy
import numpy as np

from slider_resonator import __version__
from slider_resonator.baseline.judge import MAX_POINTS
from slider_resonator.fmu.opening import Fmu
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.scene_files import built_in_scenes

FMU_DIGEST = "fmu_sha256"
SCENE_DIGEST = "scene_sha256"
SCENE_FILE = "scene_file"
BUILT_IN = "built in"
"""In place of the file of a built-in scene."""

Provenance = Mapping[str, str]
"""The recorded provenance, in the order of the file."""


def provenance(fmu: Fmu, scene: Scene, folder: Path) -> dict[str, str]:
    """Return FMU, scene, host and tools; the scene's file as seen from the baseline's folder."""
    description = fmu.description
    is_built_in = built_in_scenes().get(scene.name) == scene.files[0]
    return {
        "fmu": fmu.path.name,
        FMU_DIGEST: file_digest(fmu.path),
        "fmu_guid": str(description.guid),
        "model": str(description.modelName),
        "model_version": str(description.version or ""),
        "generation_tool": str(description.generationTool or ""),
        "scene": scene.name,
        SCENE_FILE: BUILT_IN if is_built_in else _seen_from(folder, scene.files[0]),
        SCENE_DIGEST: scene_digest(scene),
        "points_kept": str(MAX_POINTS),
        "harness": __version__,
        "fmpy": fmpy.__version__,
        "numpy": np.__version__,
        "python": platform.python_version(),
        "platform": f"{platform.system()} {platform.machine()}",
        "recorded": datetime.now(UTC).date().isoformat(),
    }


def file_digest(file: Path) -> str:
    """Return the SHA-256 of the content of a file."""
    return hashlib.sha256(file.read_bytes()).hexdigest()


def scene_digest(scene: Scene) -> str:
    """Return the SHA-256 of a scene without its names and expectations."""
    swept = (scene.sweep.variable, scene.sweep.values) if scene.sweep else None
    signals = [(name, s.times, s.values, s.hold) for name, s in sorted(scene.signals.items())]
    runs: tuple[Any, ...]
    runs = (sorted(scene.parameters.items()), signals, scene.stop_time, scene.step_size, swept)
    run = scene.run
    if scene.tuning or (run and (run.start_time or run.step_sizes or run.read_twice)):
        tuning = [(name, s.times, s.values, s.hold) for name, s in sorted(scene.tuning.items())]
        runs = (*runs, tuning, run)
    return hashlib.sha256(repr(runs).encode()).hexdigest()


def _seen_from(folder: Path, file: Path) -> str:
    """Return the relative path of a file, with slashes on every platform."""
    try:
        return Path(os.path.relpath(file, folder)).as_posix()
    except ValueError:  # on another drive of Windows
        return file.resolve().as_posix()
