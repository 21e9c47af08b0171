"""Studies made with the library, beside it and not in it: each asks it as anyone may."""
