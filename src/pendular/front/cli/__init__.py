"""The command line: a question with units is read, put to the library, and its answer shown.

Each module holds the commands of one subject. To add one: write its module, which registers its commands with
`_app.app`, and import it here; the order of the imports is that of the help.
"""

from . import (  # noqa: F401, registers the commands
    bridges,
    changes,
    compile,
    data,
    export,
    export_c,
    export_lammps,
    export_library,
    export_liggghts,
    export_pair_table,
    export_table,
    export_wasm,
    export_yade_engine,
    films,
    fits,
    laws,
    packing,
    page,
)
from ._app import app, main

__all__ = ["app", "main"]
