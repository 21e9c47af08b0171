"""Grains in the files of other programs: one format a file, one door to read them and one to write them."""
