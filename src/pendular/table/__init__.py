"""The exact answer as compiled polynomials, for one pair of contact angles: tens of nanoseconds a contact."""

from .kernels import Grid
from .table import Table, ToleranceWarning, load_table, tabulate

__all__ = ["Grid", "Table", "ToleranceWarning", "load_table", "tabulate"]
