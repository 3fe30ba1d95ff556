"""Documentation and units of the fields of a dataclass, see analytic.fields."""

from analytic.fields import field_docs, units

__all__ = ["field_docs", "units"]
