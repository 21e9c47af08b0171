"""The exact solver as plain Python, uncompiled: for a few questions, where compiling or loading would cost more.

The very same source files are imported once more under this package, with decorators that leave a kernel as it is.
"""
