import hashlib
import zipfile
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy
import pytest

import slider_resonator
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.provenance import (
    DATE_VARIABLE,
    FmuIdentity,
    Provenance,
    identity_of,
    provenance_of,
)
from slider_resonator.fmu.provenance_text import (
    provenance_html,
    provenance_markdown,
    provenance_properties,
)
from slider_resonator.output.json_output import to_json
from tests.harness.known_provenance import PROVENANCE


def test_an_fmu_is_identified_by_its_description_and_its_bytes(native_fmu: Path) -> None:
    with zipfile.ZipFile(native_fmu) as archive:
        root = ET.fromstring(archive.read("modelDescription.xml"))
    digest = hashlib.sha256(native_fmu.read_bytes()).hexdigest()
    found = identity_of(native_fmu)
    assert found == FmuIdentity(
        str(native_fmu),
        root.attrib["guid"],
        digest,
        root.get("version"),
        root.get("generationTool"),
    )
    assert found.version
    assert found.generation_tool


def test_what_cannot_be_read_is_none(tmp_path: Path) -> None:
    path = tmp_path / "a.fmu"
    assert identity_of(path) == FmuIdentity(str(path), None, None, None, None)
    path.write_bytes(b"PK no archive")
    digest = hashlib.sha256(b"PK no archive").hexdigest()
    assert identity_of(path) == FmuIdentity(str(path), None, digest, None, None)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", "<fmiModelDescription guid='a'")
    assert identity_of(path).guid is None
    assert identity_of(tmp_path).sha256 is None


def test_an_fmu_of_fmi_3_has_a_token_and_may_state_no_version(tmp_path: Path) -> None:
    path = tmp_path / "a.fmu"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", "<fmiModelDescription instantiationToken='t'/>")
    found = identity_of(path)
    assert (found.guid, found.version, found.generation_tool) == ("t", "", "")


def test_versions_and_machine_are_those_here(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(DATE_VARIABLE, "86399")
    found = provenance_of()
    assert found.harness == slider_resonator.__version__
    assert found.fmpy == fmpy.__version__
    assert found.date == "1970-01-01T23:59:59+00:00"
    assert found == provenance_of()
    assert all(vars(found)[name] for name in ("python", "platform", "cpu"))


@pytest.mark.parametrize("date", ["tomorrow", "-1", "1.5", "253402300800", "\u0661"])
def test_a_date_that_is_none_is_refused(monkeypatch: pytest.MonkeyPatch, date: str) -> None:
    monkeypatch.setenv(DATE_VARIABLE, date)
    with pytest.raises(HarnessError, match=f"{DATE_VARIABLE} = '{date}': must be whole seconds"):
        provenance_of()


def test_every_fact_is_in_every_form() -> None:
    facts = [*vars(PROVENANCE).values(), *vars(PROVENANCE.fmus[0]).values()]
    shown = [fact for fact in facts if isinstance(fact, str) and fact != "folder/a.fmu"]
    assert len(shown) == 10
    page, text = provenance_html(PROVENANCE), provenance_markdown(PROVENANCE)
    properties = provenance_properties(PROVENANCE, PROVENANCE.fmus[0])
    for fact in shown:
        assert fact in page
        assert fact in text.replace("\\", "")
        assert fact in properties.values()
    assert properties["fmu"] == "folder/a.fmu"
    assert "fmus" not in properties


def test_properties_leave_out_what_is_unknown() -> None:
    unknown = FmuIdentity("a.fmu", None, None, None, None)
    assert "fmu_guid" not in provenance_properties(PROVENANCE, unknown)
    assert "fmu" not in provenance_properties(PROVENANCE, None)


def test_hostile_names_are_escaped() -> None:
    hostile = FmuIdentity("<i>.fmu", "<script>", None, "a|b", "\x1b[31m")
    known = Provenance(**{**vars(PROVENANCE), "fmus": (hostile,)})
    assert "<script>" not in provenance_html(known)
    assert "<i>" not in provenance_html(known)
    assert "\x1b" not in provenance_html(known)
    assert "a\\|b" in provenance_markdown(known)


def test_json_begins_with_it_in_every_object() -> None:
    assert to_json([{"a": 1}], PROVENANCE).count('"provenance"') == 1
    assert '"provenance"' not in to_json({"a": 1})
