"""The colours of all pictures and pages."""

INK, FAINT, HAIR = "#22303c", "#5f6b75", "#9aa4ac"  # faint text still has a contrast of 5 on white
GRAIN, GRAIN_EDGE = "#eee9df", "#a99f8d"
LIQUID, LIQUID_EDGE = "#b3d4ea", "#1d6496"
ACCENT = "#c2452d"
