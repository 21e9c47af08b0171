"""The explorer page as files, without a browser: one of HTML that holds all, and one that keeps it when offline."""

import json
import re
import shutil
import subprocess

import pytest

import pendular as pl
from pendular.front.explorer.files import page_files
from pendular.front.explorer.records import records
from pendular.ground import webassembly

pytestmark = [
    pytest.mark.needs("numba"),
    pytest.mark.skipif(webassembly.linker() is None, reason="wasm-ld is not installed: apt-get install lld"),
]


@pytest.fixture(scope="module")
def html():
    return page_files()["index.html"].decode()


def test_all_is_in_one_file_that_loads_nothing(html):
    assert not re.findall(r"<(?:script|link|img|iframe)\b[^>]*\b(?:src|href)=\"(?!data:)[^\"]*", html)
    assert not re.findall(r"(?m)^import ", html)
    assert "@import" not in html
    assert "url(" not in html.replace("url(#card)", "").replace("url(#inside)", "")
    assert len(html) < 400e3


def test_no_hole_is_left_in_it(html):
    style = html.partition("<style")[2].partition("</style>")[0]
    assert "{palette}" not in style
    assert "--liquid-edge: #1d6496" in style
    assert f"Pendular {pl.__version__}" in html
    assert "{digest}" not in page_files()["offline.js"].decode()


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_its_script_has_no_name_twice(html, tmp_path):
    script = re.search(r'<script type="module">\n(.*)\n</script>', html, re.DOTALL)
    (tmp_path / "page.mjs").write_text(script[1], encoding="utf-8")
    subprocess.run(["node", "--check", str(tmp_path / "page.mjs")], check=True)


def test_records_are_those_of_the_registry():
    known = json.loads(json.dumps(records()))
    by_name = {law["name"]: law for law in known["laws"]}
    assert list(by_name) == [name for name, law in pl.laws.items() if set(law.gives) != {"rupture_work"}]
    for name, told in by_name.items():
        law = pl.laws[name]
        assert (told["control"], told["reference"], told["doi"]) == (law.control, law.reference, law.doi)
        assert {name: tuple(span) for name, span in told["ranges"].items() if name in law.valid} == dict(law.valid)
    assert len(known["liquids"]) == 30
