"""YADE: its capillary tables written, read, checked, and its use of them emulated."""

from .audit import Audit, audit, contact_angle_of, folder_texts
from .errors import measure, measure_rupture
from .exact import exact_rows, exact_rupture
from .export import Export, export
from .files import RATIOS, Table, read_points, read_table, table_name, write_points, write_table
from .points import make_points
from .reader import YadeBridge, yade_bridge
from .tables import make_table

__all__ = [
    "RATIOS",
    "Audit",
    "Export",
    "Table",
    "YadeBridge",
    "audit",
    "contact_angle_of",
    "exact_rows",
    "exact_rupture",
    "export",
    "folder_texts",
    "make_points",
    "make_table",
    "measure",
    "measure_rupture",
    "read_points",
    "read_table",
    "table_name",
    "write_points",
    "write_table",
    "yade_bridge",
]
