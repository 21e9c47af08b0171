"""Bridges along a path: contact lines that stay or slide, loops of approach and retraction, and what they cost."""

from .path import path
from .result import BridgePath

__all__ = ["BridgePath", "path"]
