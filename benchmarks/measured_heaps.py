"""Made heaps beside what was measured on wet beads: bridges a grain, and who carries the stress.

``python -m benchmarks.measured_heaps [grains]`` prints, for heaps made with three frictions, whose liquid is at one
suction after a wet start:

- bridges a grain less contacts a grain. By tomography of wet sphere packings it is about 2, whatever the solid fraction
  [1]_. The abstract, which is all that was at hand, tells no amount of liquid.
- the share of the mean capillary stress in bridges that meet no other. By tomography of sheared wet beads the bridges
  of two grains carry nearly 85 % where the liquid is 0.05 of the solid, by volume [2]_; from its abstract as well.

References
----------
.. [1] S. Weis, G. Schröder-Turk, M. Schröter, Structural similarity between dry and wet sphere packings,
   arXiv:1808.04342.
.. [2] A. Awdi et al., Morphology-resolved stress contributions in sheared wet granular materials, arXiv:2605.12152.
"""

import math
import sys

import numpy as np

import pendular as pl
from pendular.packing.meetings import mark_meetings

WATER = pl.Liquid.water()
RATIOS = (0.005, 0.01, 0.02, 0.03, 0.05)  # liquid over solid, by volume
FRICTIONS = (0.0, 0.3, 10.0)
ANGLES = (0.0, 20.0)


def main(grains):
    """Print the table."""
    print("friction  solid fraction  angle  liquid/solid  bridges - contacts  stress in bridges that do not meet")
    for friction in FRICTIONS:
        heap = pl.random_packing(grains, 50e-6, friction=friction, seed=1)
        solid = float(np.sum(4.0 / 3.0 * math.pi * heap.radii**3))
        touching = 1e-3 * 50e-6  # as no tomography tells gaps more finely
        for degrees in ANGLES:
            for ratio in RATIOS:
                w = pl.wet(heap, math.radians(degrees), liquid_volume=ratio * solid, liquid=WATER)
                contacts = 2.0 * np.count_nonzero(w.bridges.separation <= touching) / heap.count
                meet = mark_meetings(heap, w.bridges.neighbours, w.bridges.normal, w.bridges._shape).bridges
                weights = w.bridges.force * w.bridges.length
                print(
                    f"{friction:8g}  {solid / heap.volume:14.4f}  {degrees:4g}°  {ratio:12g}  "
                    f"{w.coordination - contacts:18.2f}  {100 * np.sum(weights[~meet]) / np.sum(weights):30.0f} %"
                )


if __name__ == "__main__":
    main(*map(int, sys.argv[1:] or ["400"]))
