from slider_resonator.fmu.provenance import FmuIdentity, Provenance

PROVENANCE = Provenance(
    fmus=(FmuIdentity("folder/a.fmu", "{guid}", "0123abcd", "1.2", "a tool"),),
    harness="0.3",
    fmpy="0.4",
    python="3.11",
    platform="Linux x86_64",
    cpu="a processor, 2 logical cores",
    date="2026-01-02T03:04:05+00:00",
)
