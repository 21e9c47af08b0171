"""The explorer page as files, without a browser: one of HTML that holds all, and one that keeps it when offline."""

import json
import re
import shutil
import socket
import subprocess

import pytest

import pendular as pl
from pendular.codes import wasm
from pendular.front.cli import main
from pendular.front.explorer.files import page_files
from pendular.front.explorer.records import records
from pendular.ground import webassembly
from pendular.ground.compile import has_compiler

MAKES_IT = has_compiler() and webassembly.linker() is not None
pytestmark = pytest.mark.skipif(
    not (wasm.PACKAGED.exists() or MAKES_IT), reason="neither a module in the package, nor numba and wasm-ld to make it"
)


@pytest.fixture(scope="module")
def html():
    return page_files()["index.html"].decode()


def test_all_is_in_one_file_that_loads_nothing(html):
    assert not re.findall(r"<(?:script|link|img|iframe)\b[^>]*\b(?:src|href)=\"(?!data:)[^\"]*", html)
    assert not re.findall(r"(?m)^import ", html)
    assert "@import" not in html
    assert "url(" not in html.replace("url(#card)", "").replace("url(#inside)", "")
    assert len(html) < 480e3


def test_no_hole_is_left_in_it(html):
    style = html.partition("<style")[2].partition("</style>")[0]
    assert "{palette}" not in style
    assert "--liquid-edge: #1d6496" in style
    assert f"Pendular {pl.__version__}" in html
    assert "{digest}" not in page_files()["offline.js"].decode()


def test_the_package_may_bring_the_module(monkeypatch, tmp_path):
    module = wasm.module()
    monkeypatch.setattr(wasm, "linker", lambda: None)
    monkeypatch.setattr(wasm, "PACKAGED", tmp_path / wasm.MODULE)
    with pytest.raises(ValueError, match=r"^wasm: needs (wasm-ld, which links|numba, which compiles) it"):
        page_files()
    wasm.PACKAGED.write_bytes(module)
    assert len(page_files()["index.html"]) > len(module)


def test_a_port_in_use_is_refused_in_one_line(capsys):
    with socket.create_server(("127.0.0.1", 0)) as taken, pytest.raises(SystemExit) as end:
        main(["explore", "--no-browser", "--port", str(taken.getsockname()[1])])
    assert end.value.code == 2
    words = capsys.readouterr().err
    assert re.fullmatch(r"pendular: port: \d+ of 127\.0\.0\.1 cannot be used: .*; choose another\n", words)


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_its_script_has_no_name_twice(html, tmp_path):
    script = re.search(r'<script type="module">\n(.*)\n</script>', html, re.DOTALL)
    (tmp_path / "page.mjs").write_text(script[1], encoding="utf-8")
    subprocess.run(["node", "--check", str(tmp_path / "page.mjs")], check=True)


def test_records_are_those_of_the_registry():
    known = json.loads(json.dumps(records()))
    by_name = {law["name"]: law for law in known["laws"]}
    assert list(by_name) == [name for name, law in pl.laws.items() if {"force", "rupture"} & set(law.gives)]
    for name, told in by_name.items():
        law = pl.laws[name]
        assert (told["control"], told["reference"], told["doi"]) == (law.control, law.reference, law.doi)
        assert {name: tuple(span) for name, span in told["ranges"].items() if name in law.valid} == dict(law.valid)
    assert len(known["liquids"]) == 30
