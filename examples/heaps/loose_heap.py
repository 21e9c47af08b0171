"""Write a loose heap as a LAMMPS dump in millimetres: ``python examples/heaps/loose_heap.py grains.dump [grains]``."""

import sys

import pendular as pl


def main(path: str, count: int = 200) -> None:
    """Make grains of 50 µm with friction, and write them."""
    heap = pl.random_packing(count, 50e-6, friction=0.5)
    head = ["ITEM: TIMESTEP", "0", "ITEM: NUMBER OF ATOMS", str(heap.count), "ITEM: BOX BOUNDS pp pp pp"]
    head += [f"0 {1e3 * heap.cell[k, k]:.17g}" for k in range(3)]
    rows = (
        f"{i + 1} 1 {1e3 * radius:.17g} " + " ".join(f"{1e3 * x:.17g}" for x in place)
        for i, (radius, place) in enumerate(zip(heap.radii, heap.positions, strict=True))
    )
    with open(path, "w", encoding="utf-8") as dump:
        dump.write("\n".join([*head, "ITEM: ATOMS id type radius x y z", *rows]) + "\n")
    print(f"{path}: {heap.count} grains")


main(sys.argv[1], *map(int, sys.argv[2:]))
