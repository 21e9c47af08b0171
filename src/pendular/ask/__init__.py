"""A question about a pair of solids, and its answer, in SI units."""
