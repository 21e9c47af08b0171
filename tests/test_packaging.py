"""What is published: one version everywhere, and what the package needs told alike to pip and to conda."""

import re
import tomllib
from pathlib import Path

import pendular as pl

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
RECIPE = (ROOT / "packaging" / "conda" / "recipe.yaml").read_text("utf-8")
CONDA_NAMES = {"matplotlib": "matplotlib-base"}


def listed(key):
    """Items of a list of the recipe."""
    (items,) = re.findall(rf"^ +{key}:\n((?: +- .+\n)+)", RECIPE, re.MULTILINE)
    return [line.strip().removeprefix("- ") for line in items.splitlines()]


def for_conda(requirement):
    name, limits = re.fullmatch(r"([\w-]+)(.*)", requirement).groups()
    return f"{CONDA_NAMES.get(name, name)} {limits}"


def test_one_version_everywhere():
    citation = (ROOT / "CITATION.cff").read_text("utf-8")
    (newest, *_) = re.findall(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    assert f"\nversion: {pl.__version__}\n" in citation
    assert newest == pl.__version__
    assert f'\n  version: "{pl.__version__}"\n' in RECIPE


def test_the_recipe_needs_what_the_package_needs():
    project = PROJECT["project"]
    (least,) = re.findall(r'python_min: "(.+)"', RECIPE)
    python, *needed = listed("run")
    assert python.replace("${{ python_min }}", least) == f"python {project['requires-python']}"
    assert needed == [for_conda(line) for line in project["dependencies"]]
    assert set(map(for_conda, PROJECT["build-system"]["requires"])) <= set(listed("host"))
    assert listed("entry_points") == [f"{name} = {where}" for name, where in project["scripts"].items()]
    assert f"\n  license: {project['license']}\n" in RECIPE


def test_what_an_index_shows_is_said():
    project = PROJECT["project"]
    assert {"description", "readme", "license", "license-files", "authors", "keywords"} <= project.keys()
    versions = {line.rpartition(" ")[2] for line in project["classifiers"] if re.search(r":: 3\.\d+$", line)}
    least, beyond = re.findall(r"3\.(\d+)", project["requires-python"])
    assert versions == {f"3.{minor}" for minor in range(int(least), int(beyond))}
    assert not any("file:" in address or "localhost" in address for address in project.get("urls", {}).values())


def test_the_citation_names_the_article_and_the_licence():
    citation = (ROOT / "CITATION.cff").read_text("utf-8")
    assert f"\nlicense: {PROJECT['project']['license']}\n" in citation
    assert re.search(r"volume: 360\n.*year: 2020\n.*start: 622\n.*end: 634\n", citation)
