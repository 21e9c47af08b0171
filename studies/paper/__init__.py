"""The article behind the library, drawn anew and audited: its figures, its statements, and one page with both.

C.-F. Zhao, N. P. Kruyt, O. Millet, Powder Technology 360 (2020) 622-634. ``python -m studies.paper --out DIR`` writes
the files, :func:`studies.paper.report.write_report` from Python; the modules can be used apart.
"""
