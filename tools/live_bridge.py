"""The bridge that moves on the front page: a fragment with its solver, which opens from a file as well."""

import base64
import re
import tempfile
from pathlib import Path

from pendular.codes import wasm
from pendular.ground.compile import has_compiler
from pendular.ground.webassembly import linker

LIVE = Path(__file__).parents[1] / "docs" / "live"
EXPORT = re.compile(r"^export ", re.MULTILINE)


def fragment() -> str:
    """The fragment; a remark where the solver cannot be made, so that the page has its picture alone."""
    if linker() is None or not has_compiler():
        return "<!-- no bridge that moves: wasm-ld, or numba, was not installed -->\n"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        wasm.write(folder)
        solver = EXPORT.sub("", (folder / wasm.SCRIPT).read_text(encoding="utf-8"))
        module = base64.b64encode((folder / wasm.MODULE).read_bytes()).decode()
    script = EXPORT.sub("", (LIVE / "bridge.mjs").read_text(encoding="utf-8"))
    start = f'show(await load(Uint8Array.from(atob("{module}"), (letter) => letter.charCodeAt(0))));'
    markup = (LIVE / "bridge.html").read_text(encoding="utf-8")
    return f'{markup}<script type="module">\n{solver}\n{script}\n{start}\n</script>\n'
