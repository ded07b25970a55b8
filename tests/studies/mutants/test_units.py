from __future__ import annotations

from studies.mutants.units import unit_mutants

DESCRIPTION = """<fmiModelDescription>
  <UnitDefinitions>
    <Unit name="1">
      <BaseUnit />
    </Unit>
    <Unit name="N">
      <BaseUnit kg="1" rad="1" s="-2" />
      <DisplayUnit name="mN" factor="1000.0" />
    </Unit>
  </UnitDefinitions>
  <ScalarVariable name="load" valueReference="1">
    <Real unit="N" start="0.0" />
  </ScalarVariable>
</fmiModelDescription>
"""


def test_every_unit_is_mislabelled_in_each_way() -> None:
    found = {m.change: m for m in unit_mutants(DESCRIPTION)}
    lines = {change: m.diff.splitlines()[-2].strip("+ ") for change, m in found.items()}
    assert lines == {
        "unit 1 gets factor 1000": '<BaseUnit factor="1000.0" />',
        "unit N gets factor 1000": '<BaseUnit kg="1" rad="1" s="-2" factor="1000.0" />',
        "unit N: kg^1 becomes ^2": '<BaseUnit kg="2" rad="1" s="-2" />',
        "unit N: s^-2 becomes ^-1": '<BaseUnit kg="1" rad="1" s="-1" />',
        "display unit mN: factor is 1 % too large": '<DisplayUnit name="mN" factor="1010.0" />',
        "unit of load becomes 1": '<Real unit="1" start="0.0" />',
        "unit of load is left out": '<Real start="0.0" />',
    }
    assert found["unit of load becomes 1"].line == 12
    assert [m.line for m in found.values()] == sorted(m.line for m in found.values())
