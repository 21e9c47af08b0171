"""Heaps of grains with bridges: which pairs hold one, how much water they hold, and what stress they carry."""
