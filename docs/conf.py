"""How the site is built: ``sphinx-build -W docs out/site``; nothing on its pages comes from the network."""

import re
import sys
from importlib.metadata import version as version_of
from pathlib import Path

from sphinx.application import Sphinx

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))  # for the tools of the repository

project = "Pendular"
author = "The Pendular developers"
project_copyright = author
version = release = version_of("pendular")

extensions = [
    "myst_parser",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",  # the files of MathJax, copied into the site
    "sphinx_copybutton",
]
exclude_patterns = ["made/*.md"]  # written by the build, for other pages to include

myst_enable_extensions = ["amsmath", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
myst_dmath_double_inline = True
autodoc_typehints = "none"  # the docstrings tell more
autodoc_member_order = "bysource"
numpydoc_show_class_members = False
copybutton_prompt_text = "$ "
copybutton_only_copy_prompt_lines = True

html_theme = "furo"
html_title = "Pendular"
html_favicon = "../src/pendular/front/explorer/static/logo.svg"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False
html_show_search_summary = False  # it would ask for the pages found, which a browser grants no file
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#15607a", "color-brand-content": "#15607a"},
    "dark_css_variables": {"color-brand-primary": "#7cc4dd", "color-brand-content": "#7cc4dd"},
}


def keep_initials(app: Sphinx, what: str, name: str, thing: object, options: object, lines: list[str]) -> None:
    """Keep a reference that begins with an initial, ``J. Jasper``, from becoming item J of a list."""
    lines[:] = [re.sub(r"^( *\.\. \[[^]]+\] )(?=[A-Z]\. )", r"\1\\", line) for line in lines]


def tell_variable(app: Sphinx, what: str, name: str, thing: object, options: object, lines: list[str]) -> None:
    """Say what a variable of laws means, in place of what its class is."""
    if what == "data" and hasattr(thing, "text"):
        lines[:] = [f"``{thing.name}``: {thing.text}, [{thing.unit}], from {thing.low:g} to {thing.high:.6g}."]
    elif what == "data" and hasattr(thing, "size_words"):
        lines[:] = [f"{thing.angle_words}, {thing.size_words}."]


def skip_fields(app: Sphinx, what: str, name: str, thing: object, skip: bool, options: object) -> bool | None:
    """Leave out the fields of named tuples: the signature has them, and Python's text for them says nothing."""
    return True if getattr(thing, "__doc__", None) and thing.__doc__.startswith("Alias for field number") else None


def opening(picture: re.Match[str]) -> str:
    """A picture that opens by itself, unless it leads elsewhere; a wide one twice, for its two parts on a phone."""
    image = picture[0]
    if picture[1]:
        return image
    rest = re.sub(r'\balt="[^"]*"', 'alt=""', image).replace('class="wide"', 'class="wide rest"')
    return f'<a class="picture" href="{picture[2]}">{image}{rest if rest.count("wide rest") else ""}</a>'


def finish(app: Sphinx, page: str, template: str, context: dict, doctree: object) -> None:
    """Let a picture open by itself, to be seen larger, and give citations the numbers that numpydoc hides."""
    if "body" in context:
        body = re.sub(r'(<a\b[^>]*>\s*)?<img\b[^>]*\bsrc="([^"]*)"[^>]*>', opening, context["body"])
        context["body"] = re.sub(r"\[R[0-9a-f]{12}-(\d+)\]", r"[\1]", body)


def setup(app: Sphinx) -> None:
    """Have the pictures and tables of the site made before its pages are read."""
    from tools.site_parts import make, write_explorer

    app.connect("builder-inited", lambda app: make(Path(app.srcdir)))
    app.connect("build-finished", lambda app, error: None if error else write_explorer(Path(app.outdir) / "explore"))
    app.connect("autodoc-process-docstring", keep_initials, priority=900)  # after numpydoc
    app.connect("autodoc-process-docstring", tell_variable, priority=900)
    app.connect("autodoc-skip-member", skip_fields)
    app.connect("html-page-context", finish)
