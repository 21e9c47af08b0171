"""The example in Julia, which nobody here can run, against the header of the library: what both say, read and compared.

No Julia comes with Debian, PyPI or npm. Where one is installed, test_c_library.py runs the example.
"""

import re
from pathlib import Path

import pytest

import pendular.codes.library as library

EXAMPLE = (Path(__file__).parents[1] / "examples" / "library" / "exact.jl").read_text()
HEADER = (Path(library.__file__).parent / "pendular.h").read_text()
TYPES = {"int": "Cint", "size_t": "Csize_t", "double": "Cdouble", "pendular_pair": "Pair", "pendular_state": "State"}


def in_julia(declared):
    """Type of a C argument as Julia has it: a pointer's target in braces."""
    words = re.findall(r"\w+|\*", declared)
    name = TYPES[next(word for word in words if word != "const")]
    return f"{{{name}}}" if "*" in words else name


def of_header(text):
    """Functions (result, arguments), structures (fields with types) and constants of the header."""
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    functions = {
        name: (TYPES[result], [in_julia(each) for each in arguments.split(",")])
        for result, name, arguments in re.findall(r"^(\w+) (pendular_\w+)\(([^)]*)\);", text, re.MULTILINE)
    }
    structures = {
        TYPES[name]: [
            (field, TYPES[kind])
            for kind, fields in re.findall(r"(\w+) ([^;]+);", body)
            for field in re.split(r",\s*", fields)
        ]
        for body, name in re.findall(r"typedef struct \{(.*?)\} (\w+);", text, re.DOTALL)
    }
    constants = {name: int(number) for name, number in re.findall(r"PENDULAR_(\w+) = (\d+)", text)}
    return functions, structures, constants


def of_julia(text):
    """The same of what a program in Julia calls."""
    text = re.sub(r"#.*", "", text)
    call = r"ccall\(\(:(\w+), library\), (\w+),\s*\(([^)]*)\),"
    functions = {
        name: (result, [re.sub(r"^(Ref|Ptr)(?=\{)", "", each.strip()) for each in arguments.split(",")])
        for name, result, arguments in re.findall(call, text)
    }
    structures = {
        name: re.findall(r"(\w+)::(\w+)", body)
        for name, body in re.findall(r"^struct (\w+)\n(.*?)^end", text, re.MULTILINE | re.DOTALL)
    }
    constants = {}
    for names, numbers in re.findall(r"^const ([A-Z_, ]+) = (Cint.*)$", text, re.MULTILINE):
        first, last = (int(number) for number in re.findall(r"\d+", numbers))
        constants |= dict(zip(names.split(", "), range(first, last + 1), strict=True))
    return functions, structures, constants


def differences(julia, header):
    """What a program says of functions, structures and constants that the header says otherwise."""
    return [
        f"{name}: {said}, and in the header {known.get(name)}"
        for its, known in zip(of_julia(julia), of_header(header), strict=True)
        for name, said in its.items()
        if known.get(name) != said
    ]


def test_the_program_calls_what_the_header_declares():
    functions, structures, constants = of_julia(EXAMPLE)
    assert functions.keys() == {"pendular_rupture", "pendular_bridges"}
    assert len(structures["Pair"]) == 5
    assert len(structures["State"]) == 21
    assert constants == {"SUCTION": 0, "VOLUME": 1, "FOUND": 0, "NO_BRIDGE": 1, "FAILED": 2, "BAD_INPUT": 3}
    assert len(of_header(HEADER)[0]) == 6
    assert differences(EXAMPLE, HEADER) == []


def test_each_call_passes_as_many_arguments_as_it_names_types():
    calls = re.findall(r"ccall\(.*?\), \w+,\s*\(([^)]*)\),\s*([^\n]*)\)\n", EXAMPLE)
    assert len(calls) == 2
    for types, passed in calls:
        assert len(types.split(",")) == len(re.sub(r"\([^)]*\)", "", passed).split(","))


@pytest.mark.parametrize(
    ("program", "header"),
    [
        (("Cint, (Cint, Cdouble, Ref{Pair}", "Cint, (Cint, Ref{Pair}, Cdouble"), ()),
        ((":pendular_rupture", ":pendular_ruptured"), ()),
        (("library), Cint,", "library), Cdouble,"), ()),
        (("    neck_inside::Cdouble\n", ""), ()),
        (("area::Cdouble", "area::Cfloat"), ()),
        (("= Cint(0), Cint(1)", "= Cint(1), Cint(2)"), ()),
        (
            (),
            (
                "int control, double held, const pendular_pair *pair",
                "int control, float held, const pendular_pair *pair",
            ),
        ),
        ((), ("size_t count, const double *separation", "int count, const double *separation")),
        ((), ("    double force;", "    double strength;")),
        ((), ("PENDULAR_NO_BRIDGE = 1", "PENDULAR_NO_BRIDGE = 4")),
    ],
)
def test_what_differs_is_found(program, header, monkeypatch):
    monkeypatch.setitem(TYPES, "float", "Cfloat")
    julia, text = (said.replace(*change) if change else said for said, change in ((EXAMPLE, program), (HEADER, header)))
    assert (julia, text) != (EXAMPLE, HEADER)
    assert differences(julia, text)
