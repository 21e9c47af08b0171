"""The exact solver as a library for programs in C and in all languages that call it."""
