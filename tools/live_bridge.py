"""The bridge that moves on the front page: a fragment with its solver, which opens from a file as well."""

import base64
from pathlib import Path

from pendular.codes import wasm
from pendular.front.explorer.files import as_one, module_of_page
from pendular.ground.compile import has_compiler
from pendular.ground.webassembly import linker

LIVE = Path(__file__).parents[1] / "docs" / "live"


def fragment() -> str:
    """The fragment; a remark where the solver cannot be made, so that the page has its picture alone."""
    if linker() is None or not has_compiler():
        return "<!-- no bridge that moves: wasm-ld, or numba, was not installed -->\n"
    module = base64.b64encode(wasm.module()).decode()
    script = as_one(
        wasm.script(),
        module_of_page("units"),
        (LIVE / "bridge.mjs").read_text(encoding="utf-8"),
        f'begin(await load(Uint8Array.from(atob("{module}"), (letter) => letter.charCodeAt(0))));',
    )
    markup = (LIVE / "bridge.html").read_text(encoding="utf-8")
    return f'{markup}<script type="module">\n{script}\n</script>\n'
