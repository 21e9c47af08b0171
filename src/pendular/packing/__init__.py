"""Heaps of grains, and the liquid between them."""
