import hashlib
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy
import pytest

import slider_resonator
from slider_resonator.errors import HarnessError
from slider_resonator.fmu import fmu_log
from slider_resonator.fmu.provenance import (
    DATE_VARIABLE,
    FmuIdentity,
    identity_of,
    provenance_html,
    provenance_markdown,
    provenance_of,
    provenance_properties,
)
from studies.mutants.archive import files_in
from tests.harness.golden import assert_as_before
from tests.harness.known_provenance import PROVENANCE


def test_an_fmu_is_identified_by_its_description_and_its_bytes(native_fmu: Path) -> None:
    root = ET.fromstring(files_in(native_fmu)["modelDescription.xml"])
    digest = hashlib.sha256(native_fmu.read_bytes()).hexdigest()
    guid, version, tool = (root.attrib[name] for name in ("guid", "version", "generationTool"))
    assert identity_of(native_fmu) == FmuIdentity(str(native_fmu), guid, digest, version, tool)
    assert version
    assert tool


def test_what_cannot_be_read_is_none_and_what_is_not_stated_is_empty(tmp_path: Path) -> None:
    path = tmp_path / "a.fmu"
    assert identity_of(path) == FmuIdentity(str(path), None, None, None, None)
    path.write_bytes(b"PK no archive")
    digest = hashlib.sha256(b"PK no archive").hexdigest()
    assert identity_of(path) == FmuIdentity(str(path), None, digest, None, None)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", "<fmiModelDescription guid='a'")
    assert identity_of(path).guid is None
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", "<fmiModelDescription instantiationToken='t'/>")
    found = identity_of(path)
    assert (found.guid, found.version, found.generation_tool) == ("t", "", "")
    assert identity_of(tmp_path).sha256 is None


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


def test_every_fact_is_in_every_form_and_hostile_names_are_escaped() -> None:
    hostile = FmuIdentity("<i>.fmu", "<script>", None, "a|b", "\x1b[31m")
    both = replace(PROVENANCE, fmus=(*PROVENANCE.fmus, hostile))
    assert_as_before("provenance.html", provenance_html(both))
    assert_as_before("provenance.md", provenance_markdown(both))
    properties = provenance_properties(both, hostile)
    assert_as_before("provenance.txt", "".join(f"{k}: {v!r}\n" for k, v in properties.items()))
    assert "fmu" not in provenance_properties(PROVENANCE, None)


def test_messages_go_to_the_log_of_their_instance() -> None:
    one, callbacks = fmu_log.collect("one")
    two, _ = fmu_log.collect("two")
    callbacks.logger(None, b"one", 3, b"", b"mass refused")
    callbacks.logger(None, b"two", 3, b"", "gr\u00f6\u00dfer".encode())
    callbacks.logger(None, b"three", 3, b"", b"not for these")
    assert (one, two) == (["mass refused"], ["gr\u00f6\u00dfer"])
    fmu_log.forget("one")
    fmu_log.forget("two")


@pytest.mark.parametrize("text", ["load = nan refused", "it's", "both ' and \"", "two\nlines"])
def test_the_text_of_a_python_exception_is_extracted(text: str) -> None:
    wrapped = f"Fatal py exception encountered: [setReal] PyObject_CallMethod\n{ValueError(text)!r}"
    assert fmu_log.plain_words(wrapped) == text
    for other in (text, wrapped.replace("ValueError(", "KeyError(3, "), wrapped[:-2] + "\\')"):
        assert fmu_log.plain_words(other) == other
