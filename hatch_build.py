"""Wheels with machine code: ``PENDULAR_MACHINE_CODE=1 uv build --wheel`` compiles every kernel that arrays call.

Where ``wasm-ld`` is installed it brings the solver of the explorer page, too. Such a wheel is for one system and
processor, as its name tells, and for every Python. Any other has the source alone.
"""

import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class MachineCode(BuildHookInterface[Any]):
    """Compile the kernels, and put the library that they make into the wheel."""

    def dependencies(self) -> list[str]:
        """What compiles: all that the package needs."""
        if not _is_wanted():
            return []
        project = tomllib.loads(Path(self.root, "pyproject.toml").read_text(encoding="utf-8"))
        return list(project["project"]["dependencies"])

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Make the library before the wheel is put together."""
        if not _is_wanted() or version == "editable":
            return
        self._folder = tempfile.TemporaryDirectory()
        made = Path(self._folder.name, "machine_code.so")
        self._run("-m", "tools.machine_code", made)
        build_data["force_include"][str(made)] = "pendular/ground/machine_code.so"
        if shutil.which("wasm-ld"):
            page = Path(self._folder.name, "page")
            self._run("-c", "from pendular.front.cli import main; main()", "export", "wasm", "--out", page)
            for name in ("pendular.wasm", "solids.wasm"):
                build_data["force_include"][str(page / name)] = f"pendular/codes/wasm/{name}"
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"

    def _run(self, *command: str | Path) -> None:
        """Run Python in the repository, with what builds the wheel."""
        paths = os.pathsep.join([str(Path(self.root, "src")), *sys.path])
        environment = os.environ | {"PYTHONPATH": paths}
        subprocess.run([sys.executable, *command], cwd=self.root, env=environment, check=True)

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Drop the library that is in the wheel now."""
        if build_data["force_include"]:
            self._folder.cleanup()


def _is_wanted() -> bool:
    return os.environ.get("PENDULAR_MACHINE_CODE") == "1"
