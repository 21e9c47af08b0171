"""Bridges between solids of any shape: the kernels for spheres, retold, on the smooth pieces of each shape."""
