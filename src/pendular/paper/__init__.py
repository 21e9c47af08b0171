"""The article behind the library, drawn anew and audited: its figures, its statements, and one page with both.

C.-F. Zhao, N. P. Kruyt, O. Millet, Powder Technology 360 (2020) 622-634. Whoever wants the files calls
:func:`pendular.paper.report.write_report`; the modules can be used apart.
"""
