"""The table [[expect]] of a scene file."""

from math import isfinite
from typing import Annotated, ClassVar

from pydantic import Field, field_validator, model_validator

from slider_resonator.errors import unknown_name
from slider_resonator.scenes.key_table import (
    KeyTable,
    Line,
    NotNegative,
    Number,
    exactly_one,
    key,
    required,
)
from slider_resonator.scenes.vocabulary import MAX_TUBE, QUANTITIES, REFERENCES, Quantity


class ExpectTable(KeyTable):
    """One expectation: a quantity of the FMU against a reference, a value or a bound."""

    rules: ClassVar[tuple[str, ...]] = (
        "Exactly one of `reference`, `value`, `at_most` and `at_least`. A signal needs a "
        "reference, a word a `value`; only numbers have bounds.",
        "The allowed deviation of a number is `absolute + relative * |reference|`. Without "
        "`absolute` a reference counts as no smaller than a hundredth of its natural scale: v_q, "
        "full friction, the fast amplitude.",
        "The allowed deviation of a signal is `relative`, a share of the reference's peak; "
        "`absolute` beside it is for a reference near zero.",
        "A real number needs a tolerance, be it 0; counts, words and contact modes need none.",
        "`tube` allows a signal to be early or late, with the references `located_events` "
        "and `bristle_state`. For `event_times` it is the tolerance, alone.",
        "`quantity` may be a list of names, which is short for an [[expect]] of each.",
        "`absolute = 0.001` with a unit of m means 1 mm: all values are in the unit of the "
        "quantity.",
    )

    quantity: str = required(
        "what is compared; the list is below", "position", enum=list(QUANTITIES)
    )
    reference: str | None = key(
        "reference that gives the expected value; which the quantity has is below",
        "located_events",
        enum=list(REFERENCES),
    )
    value: float | str | None = key("expected number or word", 0.126667)
    at_most: Number | None = key("upper bound of a number", 100.0)
    at_least: Number | None = key("lower bound of a number", 0.12)
    absolute: NotNegative = key("allowed deviation", 1e-9, unit="unit of the quantity", default=0.0)
    relative: NotNegative = key("allowed deviation, as a share", 1e-8, unit="1", default=0.0)
    tube: Annotated[float, Field(strict=True, gt=0.0, lt=MAX_TUBE)] | None = key(
        "allowed shift in time", 0.01, unit="drive periods"
    )
    why: Line = required(
        "the reason for the expectation, for the report", "the step must arrive when it is due"
    )

    @field_validator("quantity")
    @classmethod
    def _known_quantity(cls, name: str) -> str:
        if name not in QUANTITIES:
            raise ValueError(unknown_name("quantity", name, QUANTITIES))
        return name

    @field_validator("value", mode="before")
    @classmethod
    def _number_or_word(cls, value: object) -> object:
        number = isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value)
        if not (number or isinstance(value, str)):
            raise ValueError("must be a finite number or a text in quotes")
        return value

    @model_validator(mode="after")
    def _comparable(self) -> "ExpectTable":
        kinds = ("reference", "value", "at_most", "at_least")
        given = [*self.given(kinds)]
        exactly_one("expect", given, ", ".join(kinds))
        quantity = QUANTITIES[self.quantity]
        if self.reference is not None and self.reference not in quantity.references:
            name = f"reference for {self.quantity}"
            raise ValueError(unknown_name(name, self.reference, quantity.references))
        if quantity.kind == "signal" and self.reference is None:
            raise ValueError(f"{self.quantity} is a signal: it needs a reference")
        if isinstance(self.value, str) != (quantity.kind == "word") and self.value is not None:
            raise ValueError(
                f"{self.quantity} is a {quantity.kind}, the value {self.value!r} is not"
            )
        if given in (["at_most"], ["at_least"]) and quantity.kind != "number":
            raise ValueError(f"{self.quantity} is a {quantity.kind}: it cannot have a bound")
        if given in (["reference"], ["value"]):
            self._check_tolerance(quantity)
        return self

    def _check_tolerance(self, quantity: Quantity) -> None:
        if quantity.in_periods:
            given = sorted(self.model_fields_set & {"absolute", "relative"})
            if self.tube is None or given:
                raise ValueError(f"{self.quantity} needs a tube, a share of the period, alone")
            return
        if self.tube is not None and self.reference not in quantity.tube_references:
            by = " or ".join(quantity.tube_references)
            only = f"only against {by}" if by else "with no reference: delete the key"
            raise ValueError(f"tube = {self.tube!r}: {self.quantity} can have one {only}")
        signal = quantity.kind == "signal"
        alone = quantity.exact or not self.relative > 0.0
        if signal and "absolute" in self.model_fields_set and alone:
            raise ValueError(f"{self.quantity} is a signal: must be relative, not absolute alone")
        if not quantity.exact and not self.model_fields_set & {"absolute", "relative"}:
            needed = "relative, a share of the peak" if signal else "relative or absolute"
            raise ValueError(f"{self.quantity} is a real number: it needs a tolerance, {needed}")
