"""Tables as Parquet, with named columns."""

from pathlib import Path

import numpy as np

from .columns import choose, grains
from .found import Found, optional

__all__ = ["read"]


def read(path: Path) -> Found:
    """Grains of a table, of which only the columns that are needed are read.

    Parameters
    ----------
    path : Path
        Of the file.

    Returns
    -------
    Found

    Raises
    ------
    ValueError
        Without pyarrow, without columns x, y and z, or if it is damaged.
    """
    optional("pyarrow")
    parquet = optional("pyarrow.parquet")
    with parquet.ParquetFile(path) as file:
        names = file.schema_arrow.names
        columns = choose(names)
        table = file.read(columns=[names[place] for place in columns.places])
    values = [np.asarray(table.column(names[place]), float) for place in columns.places]
    return grains(np.column_stack(values), columns)
