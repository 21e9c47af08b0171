"""The pages of the laws: their texts and pictures are what the command writes."""

import re
import shlex

import pytest
from tools import law_pages

from pendular.front.cli import main
from pendular.laws import laws


def labels(path):
    """The texts of a picture, which stand beside their outlines."""
    return re.findall(r"<!-- (.*?) -->", path.read_text(encoding="utf-8"), re.DOTALL)


def test_the_texts_are_what_the_command_writes():
    assert law_pages.PAGE.read_text("utf-8") == law_pages.page()
    written = {path.stem: path.read_text("utf-8") for path in law_pages.PAGES.glob("*.md")}
    assert written == {law.name: law_pages.law_page(law) for law in laws.values()}


def test_every_law_has_a_page_and_a_line():
    text = law_pages.PAGE.read_text("utf-8")
    for name, law in laws.items():
        page = (law_pages.PAGES / f"{name}.md").read_text("utf-8")
        assert law.formula in page
        assert law.reference in page
        assert "```{math}" in page
        assert all(law_pages.in_symbols(erratum) in page for erratum in law.errata)
        assert text.count(f"[`{name}`](laws/{name}.md)") == 1


def test_the_pictures_are_what_the_command_writes(tmp_path):
    law_pages.draw(tmp_path)
    drawn = sorted(path.name for path in tmp_path.iterdir())
    assert drawn == sorted(name for name, _ in law_pages.pictures())
    for name in drawn:
        stored = law_pages.DOCS / "images" / name
        assert labels(stored) == labels(tmp_path / name)
        assert stored.stat().st_size < 200_000


def test_a_command_of_the_page_draws_its_picture(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    name, command = list(law_pages.pictures())[1]
    with pytest.raises(SystemExit) as end:
        main(shlex.split(command)[1:])
    assert (end.value.code, capsys.readouterr().err) == (0, "")
    assert labels(tmp_path / name) == labels(law_pages.DOCS / "images" / name)


def test_the_command_writes_page_and_pictures(tmp_path, monkeypatch):
    (tmp_path / "images").mkdir()
    monkeypatch.setattr(law_pages, "DOCS", tmp_path)
    monkeypatch.setattr(law_pages, "PAGE", tmp_path / "laws.md")
    monkeypatch.setattr(law_pages, "PAGES", tmp_path / "laws")
    monkeypatch.setattr(law_pages, "ANGLES", ("20",))
    (tmp_path / "laws").mkdir()
    (tmp_path / "laws" / "gone1999.md").touch()
    law_pages.main()
    assert (tmp_path / "laws.md").read_text("utf-8").startswith("# Laws\n")
    assert len(list((tmp_path / "images").iterdir())) == 2
    assert {path.stem for path in (tmp_path / "laws").iterdir()} == set(laws)
