"""Content of an FMU, and the names that follow from it."""

import hashlib
import uuid
from collections.abc import Mapping

from fmu_src.documentation import ASSETS


def digest_of(files: Mapping[str, bytes]) -> str:
    """Return the SHA-256 (hex) of names and contents, in the order of the names."""
    digest = hashlib.sha256()
    for name, data in sorted(files.items()):
        for part in (name.encode(), data):
            digest.update(len(part).to_bytes(8, "big") + part)
    return digest.hexdigest()


def guid_of(digest: str) -> str:
    """Return the GUID of an FMU whose content has this digest; different builds never share it."""
    return str(uuid.UUID(hex=digest[:32]))


def icon_and_licences(*licences: str, icon: str = "model.png") -> dict[str, bytes]:
    """Return path in the FMU -> bytes of the icon and of licences from `assets/licenses`.

    `icon` is the path of the icon, by default FMI 2.0's.
    """
    files = {icon: (ASSETS / "model.png").read_bytes()}
    for name in licences:
        files[f"documentation/licenses/{name}"] = (ASSETS / "licenses" / name).read_bytes()
    return files


def reference_experiments() -> dict[str, bytes]:
    """Return path in the FMU -> bytes of its reference experiments (FMI-LS-REF).

    `harness/studies/reference_experiments.py` writes them.
    """
    folder = ASSETS / "reference_experiments"
    return {
        f"extra/org.fmi-standard.fmi-ls-ref/{path.name}": path.read_bytes()
        for path in sorted(folder.iterdir())
    }
