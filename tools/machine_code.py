"""Machine code of all entries for a wheel: ``python -m tools.machine_code FILE`` writes the shared library.

A wheel gets it where ``PENDULAR_MACHINE_CODE=1`` is set: ``PENDULAR_MACHINE_CODE=1 uv build --wheel``.
"""

import sys
from pathlib import Path

from pendular.front.ahead import Made, compile_ahead
from pendular.ground import native, objects, packaged


def main(path: Path) -> None:
    """Compile every entry for the processor of the package, and link them."""
    with native.for_the_package() as entries:
        for question in compile_ahead(tell):
            sys.stdout.write(f"{question}: ready\n")
    packaged.write(path, [objects.object_of_all(entries, packaged.PROCESSOR)])
    sys.stdout.write(f"{path}: {len(entries)} kernels, {path.stat().st_size / 1e6:.1f} MB\n")


def tell(made: Made) -> None:
    """Say what was compiled."""
    sys.stdout.write(f"  {made.name} {made.seconds:.1f} s\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
