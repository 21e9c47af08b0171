"""Capillary bridges between particles: exact, fast, and wherever they are needed."""

from lazy_loader import attach_stub

# The public names are those of __init__.pyi. They load on first use: the help text of the command needs none of them.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
