"""The modules of the explorer page as files that Node imports, and scripts beside them that are asked by JSON."""

import json
import subprocess
from importlib.resources import files
from pathlib import Path
from typing import Any

from pendular.codes import wasm
from pendular.front.explorer.records import records

__all__ = ["answer_of_script", "write_modules"]


def write_modules(folder: Path) -> Path:
    """Write them into a folder, with the solver and what the library tells them."""
    wasm.write(folder)
    for file in (files("pendular.front.explorer") / "static").iterdir():
        if file.name.endswith(".mjs"):
            (folder / file.name).write_text(file.read_text(encoding="utf-8"), encoding="utf-8")
    told = json.dumps(records())  # with Infinity, which is a number in JavaScript
    (folder / "records.mjs").write_text(f"export const RECORDS = {told};", encoding="utf-8")
    return folder


def answer_of_script(folder: Path, script: str, asked: Any) -> Any:
    """What a script in the folder of the modules prints for what is asked on its input."""
    (folder / "asked.mjs").write_text(script, encoding="utf-8")
    done = subprocess.run(
        ["node", "asked.mjs"], cwd=folder, input=json.dumps(asked), capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
