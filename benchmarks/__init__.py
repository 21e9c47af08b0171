"""Figures that documentation quotes: how fast the library is, and how accurate."""
