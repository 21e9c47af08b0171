"""The explorer page: a pair, its bridge and its curves under sliders, served to a browser on this machine."""
