"""The version, which the installed package takes from here."""

__all__ = ["__version__"]

__version__ = "0.2.0"
