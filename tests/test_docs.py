"""The pages of the site: their code runs and prints what they show, and they cover what is public."""

import importlib
import re
import shlex
from pathlib import Path

import pytest
from tools import site_parts
from tools.code_blocks import code_blocks

import pendular as pl
from documents import (
    after_uv_run,
    assert_commands_do_what_they_show,
    assert_python_prints_what_it_says,
    can_be_run,
    command_output,
    python_runs,
)
from pendular.ask.result import FIELDS
from pendular.laws import laws

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
PAGES = {str(path.relative_to(DOCS)): path for path in sorted(DOCS.glob("**/*.md")) if "made" not in path.parts}

# Pages that a command writes or that need another program, and the test that runs their code.
ELSEWHERE = {
    "laws.md": "test_law_pages.py",
    "yade.md": "test_yade.py",
    "yade_engine.md": "test_yade_engine.py",
    "other_codes.md": "test_other_codes.py",
    "explorer.md": "test_explorer_page.py",
    "speed.md": "test_table.py",
    "c_header.md": "test_c_header.py",
    "c_library.md": "test_c_library.py",
    "liggghts.md": "test_liggghts.py",
    "howto/gpu.md": "test_cuda.py",
    "howto/javascript.md": "test_wasm.py",
}
OWN = [name for name in PAGES if name not in ELSEWHERE]
GROUPS = {"lammps.md": "lammps", "howto/own_data.md": "data", "howto/mesh.md": "grains"}  # what their code needs
LONG = (
    "lammps.md",
    "howto/packings.md",
    "gallery/retention.md",
    "gallery/sand_castle.md",
    "gallery/stretched_heap.md",
)
ONLY_PICTURES = {"gallery/pictures.md"}
DRAWN_BEFOREHAND = {"gallery/wet_shear.md", "gallery/two_codes.md"}  # by tests/test_lammps_examples.py


def marks_of(name: str) -> list[pytest.MarkDecorator]:
    needed = [pytest.mark.needs(GROUPS[name])] if name in GROUPS else []
    return needed + [pytest.mark.long] * (name in LONG)


RUN_HERE = [pytest.param(name, marks=marks_of(name)) for name in OWN]


@pytest.mark.parametrize("name", sorted(ELSEWHERE.keys() & PAGES.keys()))
def test_code_that_is_run_elsewhere_has_a_test(name):
    assert (ROOT / "tests" / ELSEWHERE[name]).is_file()


def text_of(name: str) -> str:
    return PAGES[name].read_text(encoding="utf-8")


@pytest.mark.parametrize("name", RUN_HERE)
def test_code_of_the_page_does_what_it_shows(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("pendular.laws._registry._registered", {})  # a page registers a law
    (tmp_path / "made").mkdir()
    (tmp_path / "docs").symlink_to(DOCS)  # for code that reads files of the repository
    assert_commands_do_what_they_show(text_of(name))
    assert_python_prints_what_it_says(text_of(name))


@pytest.mark.parametrize("name", OWN)
def test_every_code_block_has_a_language_that_is_run(name):
    languages = {block.language for block in code_blocks(text_of(name))}
    assert languages <= {"python", "console", "sh", "text"}
    assert text_of(name).count("\n```\n") >= len(code_blocks(text_of(name)))


@pytest.mark.parametrize("name", PAGES)
def test_no_line_is_lost_as_a_comment(name):
    assert not re.search(r"^ *%", re.sub(r"```.*?```", "", text_of(name), flags=re.DOTALL), re.MULTILINE)


@pytest.mark.parametrize("name", [name for name in PAGES if name.startswith("gallery/") and name not in ONLY_PICTURES])
def test_a_worked_problem_has_an_answer_numbers_a_picture_and_a_script(name):
    text = text_of(name)
    (script, *_) = re.findall(r"\{literalinclude\} \.\./\.\./(examples/\w+\.py)", text)
    assert (ROOT / script).is_file()
    assert re.search(r"!\[[^]]+\]\(\.\./(made|images)/\w+\.svg\)", text)
    assert f"gallery/{Path(name).name}" in text_of("gallery.md")
    if name not in DRAWN_BEFOREHAND:
        assert "## In words" in text
        assert "| | value | source |" in text
        assert f"$ python {script}\n" in text  # run, and its output compared, by the test of the page


def test_the_gallery_has_ten_worked_problems():
    assert sum(name.startswith("gallery/") for name in PAGES) - len(ONLY_PICTURES | DRAWN_BEFOREHAND) >= 10


def test_a_wrong_promise_is_found():
    ((_, printed, told),) = python_runs("```python\nprint(1 + 1)  # 3\n```\n")
    assert printed != told
    ((_, printed, told),) = python_runs("```python\nprint(1 + 1)\n```\n\n```text\n3\n```\n")
    assert printed != told
    with pytest.raises(AssertionError):
        assert_commands_do_what_they_show("```console\n$ pendular --version\npendular 0\n```\n")
    with pytest.raises(AssertionError):
        assert_commands_do_what_they_show("```sh\nno-such-program\n```\n")


def test_all_public_names_are_in_the_reference():
    reference = "".join(path.read_text("utf-8") for path in (DOCS / "reference").glob("*.md"))
    documented = set(re.findall(r"^\.\. auto\w+:: (\w+)", reference, re.MULTILINE))
    assert {name for name in pl.__all__ if name not in ("laws", "__version__")} <= documented
    assert {name for name in importlib.import_module("pendular.laws").__all__ if name != "laws"} <= documented


def test_generated_parts_cover_their_subject():
    assert sum(line.startswith("| `") for line in site_parts.fields()) == len(FIELDS)
    assert {line[3:] for line in site_parts.law_functions() if line.startswith("## ")} == set(laws)
    _, help_text, _ = command_output("pendular --help")
    listed = re.findall(r"^  (\w+) ", help_text.partition("Commands:")[2].partition("Example")[0], re.MULTILINE)
    shown = [line[3:].split()[0] for line in site_parts.command_pages() if line.startswith("## ")]
    assert list(dict.fromkeys(shown)) == listed


def test_commands_for_contributors_can_be_run():
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    in_text = re.findall(r"`(uv run [^`]+|\.ci/run)`", text)
    in_blocks = [
        line.strip() for block in re.findall(r"^ *```sh\n(.*?)```", text, re.M | re.S) for line in block.splitlines()
    ]
    assert len(in_text) > 10
    for line in filter(None, in_text + in_blocks):
        words = shlex.split(after_uv_run(line))
        if words[:2] == ["python", "-m"]:
            assert (ROOT / Path(*words[2].split("."))).with_suffix(".py").is_file(), line
        else:
            assert can_be_run(words[0], words[1:]), line
        assert all((ROOT / word).exists() for word in words if word.startswith("tests/")), line


@pytest.mark.parametrize("path", sorted((ROOT / "benchmarks").glob("[a-z]*.py")), ids=lambda path: path.stem)
def test_benchmarks_import_what_is_there(path):
    try:
        importlib.import_module(f"benchmarks.{path.stem}")
    except ModuleNotFoundError as error:
        if error.name is None or error.name.startswith("pendular"):
            raise
        pytest.skip(f"{error.name} is not installed")


def test_files_named_to_contributors_exist():
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    for name in re.findall(r"`((?:src|tests|docs|tools)/[\w/.]+)`", text):
        assert (ROOT / name).exists() or "author_year" in name, name


@pytest.mark.needs("docs")
def test_a_page_that_loads_from_elsewhere_is_found():
    from tools import site

    assert site.loaded_from_outside('<script src="https://host/x.js">') == ["https://host/x.js"]
    assert site.loaded_from_outside('<link rel="stylesheet" href="//host/x.css">') == ["//host/x.css"]
    assert site.loaded_from_outside('<a href="https://host"><img src="made/x.svg">') == []


@pytest.mark.needs("docs")
def test_a_link_that_leads_nowhere_is_found(tmp_path):
    from tools import site

    (tmp_path / "a").mkdir()
    (tmp_path / "x.svg").touch()
    (tmp_path / "b.html").write_text(
        '<p id="here"><a href="#here"></a><a href="#there"></a><a href="a/c.html#far"></a>'
    )
    (tmp_path / "a" / "c.html").write_text(
        '<p id="far"><img src="../x.svg"><img src="x.svg"><a href="../b.html#near"></a><a href="https://doi.org/10.1/x"></a>'
        '<a href="../../outside.html"></a><a href="mailto:a@b.c"></a>'
    )
    links = {path: site.Links(path.read_text()) for path in tmp_path.glob("**/*.html")}
    assert sorted(site.broken_links(tmp_path, links)) == [
        "a/c.html: ../../outside.html is not there",
        "a/c.html: ../b.html#near has no such place",
        "a/c.html: x.svg is not there",
        "b.html: #there has no such place",
    ]
    assert site.links_outside(tmp_path, links) == {"https://doi.org/10.1/x": {"a/c.html"}}


@pytest.mark.needs("docs")
def test_a_search_that_needs_a_server_is_found(tmp_path):
    from tools import site

    (tmp_path / "_static").mkdir()
    assert site.why_not_searched(tmp_path) == [
        "searchindex.js is not there",
        "documentation_options.js is not there",
    ]
    (tmp_path / "searchindex.js").touch()
    options = tmp_path / "_static" / "documentation_options.js"
    options.write_text("SHOW_SEARCH_SUMMARY: true,")
    assert len(site.why_not_searched(tmp_path)) == 1
    options.write_text("SHOW_SEARCH_SUMMARY: false,")
    assert site.why_not_searched(tmp_path) == []


def test_pages_name_no_address_outside_and_no_missing_file():
    for name, path in PAGES.items():
        for target in re.findall(
            r"\]\(([^)#]+)(?:#[^)]*)?\)", re.sub(r"```.*?```", "", text_of(name), flags=re.DOTALL)
        ):
            if not target.startswith("http"):
                assert "made/" in target or (path.parent / target).exists(), f"{name}: {target}"
