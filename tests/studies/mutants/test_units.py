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


def test_every_unit_is_mislabelled() -> None:
    found = unit_mutants(DESCRIPTION)
    assert [m.diff.splitlines()[-2].strip("+ ") for m in found] == [
        '<BaseUnit kg="2" rad="1" s="-2" />',
        '<BaseUnit kg="1" rad="1" s="-1" />',
        '<DisplayUnit name="mN" factor="1010.0" />',
        '<Real unit="1" start="0.0" />',
    ]
    assert found[-1].line == 12
