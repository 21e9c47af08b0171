"""Write capillary tables on the grid of YADE's own generator, with exact rows: what that grid alone does.

80 gaps evenly from contact to the largest rupture distance, at most 350 suctions from 0.002 geometrically to a largest
one for each ratio, five digits, contact angle 0.

    uv run python -m tools.yade_default_grid default && uv run pendular export yade --check default --plot default.png
"""

import sys
from pathlib import Path

import numpy as np

from pendular.codes import yade

LARGEST_SUCTIONS = (1493.0, 1567.0, 1781.0, 2137.0, 2469.0, 2849.0, 4274.0, 5644.0, 6987.0, 14370.0)


def default_table(ratio: float, largest_suction: float) -> yade.Table:
    """Table of one ratio; a last block without two rows is left out, as YADE would find nothing in it."""
    suctions = np.append(0.0, np.geomspace(0.002, largest_suction, 349))
    ruptures = yade.exact_rupture(ratio, 0.0, suctions)
    blocks = []
    for gap in np.linspace(0.0, ruptures[0], 80)[:-1]:
        rows = yade.exact_rows(ratio, 0.0, gap, suctions[ruptures > gap])
        blocks.append(np.array([[float(f"{value:.5g}") for value in row] for row in rows]))
    return yade.Table(ratio, tuple(block for block in blocks if len(block) > 1))


def write_set(folder: Path) -> None:
    """Write the ten tables."""
    folder.mkdir(parents=True, exist_ok=True)
    for ratio, largest in zip(yade.RATIOS, LARGEST_SUCTIONS, strict=True):
        yade.write_table(folder / yade.table_name(ratio), default_table(ratio, largest))


if __name__ == "__main__":
    write_set(Path(sys.argv[1]))
