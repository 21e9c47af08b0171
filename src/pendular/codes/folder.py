"""A folder of files for another program, each whole or not there."""

from collections.abc import Mapping
from pathlib import Path

from ..ground.files import in_one_line, whole

__all__ = ["write_folder"]


def write_folder(folder: Path, contents: Mapping[str, bytes]) -> list[Path]:
    """Write files into a folder, which is made if it is not there; what was written, in their order.

    Raises
    ------
    ValueError
        If one of them cannot be written.
    """
    with in_one_line("out", folder):
        folder.mkdir(parents=True, exist_ok=True)
    written = [folder / name for name in contents]
    for path in written:
        with in_one_line("out", path), whole(path) as draft:
            draft.write_bytes(contents[path.name])
    return written
