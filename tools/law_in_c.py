"""The published laws in C, translated from their kernels: ``python -m tools.law_in_c willett2000 > willett2000.c``.

A kernel is a function of floats without objects: numbers, tuples of numbers, conditions and loops of a known length.
What else it might hold is refused here, so that nothing is translated by half. Each file stands alone, in C99.
"""

import ast
import inspect
import math
import sys
import textwrap
from collections.abc import Callable, Iterator
from typing import Any

from pendular.laws import Law, laws

Kernel = Callable[..., Any]

QUANTITIES = {
    "force": "force_star",
    "rupture": "rupture_star",
    "rupture_work": "rupture_work_star",
    "damping": "damping_star",
}
OPERATORS = {ast.Add: ("+", 4), ast.Sub: ("-", 4), ast.Mult: ("*", 5), ast.Div: ("/", 5)}
COMPARISONS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "=="}
CONSTANTS = {"math.nan": "NAN", "math.inf": "INFINITY", "math.pi": repr(math.pi)}
CONDITION, COMPARISON, UNARY, ATOM = 1, 3, 6, 7  # how strongly an expression holds together; sums are 4, products 5


def source(law: Law) -> str:
    """A file of C with all functions of a law."""
    names = {kernel: f"{law.name}_{QUANTITIES[quantity]}" for quantity, kernel in law.kernels.items()}
    order: list[Kernel] = []
    for kernel in law.kernels.values():
        _collect(kernel, order)
    for kernel in order:
        names.setdefault(kernel, f"{law.name}_{kernel.__name__.strip('_')}")
    if len(set(names.values())) != len(names):
        raise ValueError(f"{law.name}: two functions would have one name")
    bodies = [_Function(kernel, names, law).text() for kernel in order]
    return "\n\n".join([_head(law), *_types(order, law), *_tables(order, law), *bodies]) + "\n"


def _head(law: Law) -> str:
    control = "suction H* = (p_gas - p_liquid) R/gamma" if law.control == "suction" else "volume V* = V/R^3"
    told = [
        f"{law.title}. {law.reference}",
        f"Arguments: separation D* = D/R where there is one, {control}, both contact angles in radians, R/R1 and R/R2; "
        "R = 2 R1 R2/(R1 + R2), and R/R2 = 0 for a plane. A force is over 2 pi gamma R, a rupture distance over R, "
        "a work over 2 pi gamma R^2, a damping over the viscosity and R. NAN is outside of the domain of the law; "
        "beyond rupture the force is 0.",
        f"Written by python -m tools.law_in_c {law.name}.",
    ]
    lines = [line for part in told for line in textwrap.wrap(part, 100)]
    return "/* " + "\n   ".join(lines) + " */\n#include <math.h>"


def _collect(kernel: Kernel, order: list[Kernel]) -> None:
    """A kernel after those that it calls."""
    if kernel in order:
        return
    for node in ast.walk(_tree(kernel)):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            called = kernel.__globals__.get(node.func.id)
            if inspect.isfunction(called):
                _collect(called, order)
    order.append(kernel)


def _tree(kernel: Kernel) -> ast.FunctionDef:
    function = ast.parse(textwrap.dedent(inspect.getsource(kernel))).body[0]
    assert isinstance(function, ast.FunctionDef)
    return function


def _is_record(kind: Any) -> bool:
    return isinstance(kind, type) and hasattr(kind, "_fields")


def _type_name(kind: Any, law: Law) -> str:
    """Name in C of what a function takes or gives."""
    if kind in (float, "double"):
        return "double"
    if _is_record(kind):
        return f"{law.name}_{kind.__name__.lower()}"
    return f"{law.name}_{len(kind.__args__)}"


def _types(order: list[Kernel], law: Law) -> Iterator[str]:
    """Structures for tuples that are returned."""
    given = dict.fromkeys(kernel.__annotations__["return"] for kernel in order)
    for kind in given:
        if kind is float:
            continue
        fields = ", ".join(kind._fields) if _is_record(kind) else f"at[{len(kind.__args__)}]"
        yield f"typedef struct {{ double {fields}; }} {_type_name(kind, law)};"


def _tables(order: list[Kernel], law: Law) -> Iterator[str]:
    """Tuples of numbers that kernels read."""
    tables = {
        node.id: kernel.__globals__[node.id]
        for kernel in order
        for node in ast.walk(_tree(kernel))
        if isinstance(node, ast.Name) and isinstance(kernel.__globals__.get(node.id), tuple)
    }
    for name, table in tables.items():
        if isinstance(table[0], tuple):
            rows = ",\n    ".join("{" + ", ".join(map(repr, row)) + "}" for row in table)
            yield f"static const double {law.name}_{name}[{len(table)}][{len(table[0])}] = {{\n    {rows}}};"
        else:
            yield f"static const double {law.name}_{name}[{len(table)}] = {{{', '.join(map(repr, table))}}};"


class _Function:
    """A kernel on its way to C."""

    def __init__(self, kernel: Kernel, names: dict[Kernel, str], law: Law) -> None:
        self.kernel, self.names, self.law = kernel, names, law
        self.tree = _tree(kernel)
        self.kinds: dict[str, Any] = {}  # of parameters and local variables
        self.places = _places(self.tree)
        self.declared: set[str] = set()

    def text(self) -> str:
        """The function in C."""
        parameters = ", ".join(self._parameter(name) for name in inspect.signature(self.kernel).parameters)
        given = _type_name(self.kernel.__annotations__["return"], self.law)
        scope = "" if self.kernel in self.law.kernels.values() else "static "
        said = (inspect.getdoc(self.kernel) or "").split("\n", 1)[0].replace(":math:", "").replace("`", "")
        head = _wrapped(f"{scope}{given} {self.names[self.kernel]}({parameters})", 100)
        body = [line for statement in self.tree.body for line in self._statement(statement, ())]
        above = [f"    double {name};" for name in self.places if self._is_above(name) and self.kinds[name] == "double"]
        used = "\n".join(body)
        idle = [name for name in inspect.signature(self.kernel).parameters if name not in _names_read(self.tree)]
        silent = [f"    (void){name};" for name in idle]
        return "\n".join([*([f"/* {said} */"] if said else []), *head, "{", *above, *silent, used, "}"])

    def _parameter(self, name: str) -> str:
        kind = self.kernel.__annotations__[name]
        self.declared.add(name)
        self.kinds[name] = kind
        if kind is float:
            self.kinds[name] = "double"
            return f"double {name}"
        if _is_record(kind):
            return f"{_type_name(kind, self.law)} {name}"
        if Ellipsis in kind.__args__:
            return f"const double (*{name})[{len(kind.__args__[0].__args__)}], int {name}_count"
        return f"const double *{name}"

    # -- statements

    def _statement(self, node: ast.stmt, block: tuple[int, ...]) -> Iterator[str]:
        indent = "    " * (len(block) + 1)
        match node:
            case ast.Expr(value=ast.Constant(value=str())):
                return
            case ast.Return(value=value) if value is not None:
                yield f"{indent}return {self._returned(value)};"
            case ast.If():
                yield f"{indent}if ({self._expression(node.test)}) {{"
                yield from self._block(node.body, (*block, id(node)))
                if node.orelse:
                    yield f"{indent}}} else {{"
                    yield from self._block(node.orelse, (*block, id(node) + 1))
                yield f"{indent}}}"
            case ast.For(target=ast.Name(id=name), iter=ast.Call(func=ast.Name(id="range"), args=limits)):
                yield f"{indent}for ({self._counting(name, limits)}) {{"
                yield from self._block(node.body, (*block, id(node)))
                yield f"{indent}}}"
            case ast.Assign(targets=[ast.Tuple(elts=targets)], value=value):
                yield from self._unpacked([target.id for target in targets], value, indent, block)  # type: ignore[attr-defined]
            case ast.Assign(targets=[ast.Name(id=name)], value=value):
                yield self._assigned(name, self._expression(value), self._kind(value), indent, block)
            case ast.AugAssign(target=ast.Name(id=name), op=op, value=value):
                yield f"{indent}{name} {OPERATORS[type(op)][0]}= {self._expression(value)};"
            case _:
                raise ValueError(f"{self.kernel.__name__}: {ast.unparse(node)} has no C here")

    def _block(self, statements: list[ast.stmt], block: tuple[int, ...]) -> Iterator[str]:
        for statement in statements:
            yield from self._statement(statement, block)

    def _counting(self, name: str, limits: list[ast.expr]) -> str:
        name = "step" if name == "_" else name
        self.kinds[name] = "int"
        if len(limits) == 1:
            return f"int {name} = 0; {name} < {self._integer(limits[0])}; {name}++"
        first, last, step = map(self._integer, limits)
        if step != "-1":
            raise ValueError(f"{self.kernel.__name__}: range of step {step} has no C here")
        return f"int {name} = {first}; {name} > {last}; {name}--"

    def _integer(self, node: ast.expr) -> str:
        match node:
            case ast.Constant(value=int(value)):
                return str(value)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return f"-{self._integer(operand)}"
            case ast.BinOp(left=left, op=ast.Sub(), right=right):
                return f"{self._integer(left)} - {self._integer(right)}"
            case ast.Call(func=ast.Name(id="len"), args=[ast.Name(id=name)]):
                return f"{name}_count"
            case ast.Name(id=name) if isinstance(self.kernel.__globals__.get(name), int):
                return str(self.kernel.__globals__[name])
        raise ValueError(f"{self.kernel.__name__}: {ast.unparse(node)} is no count")

    def _is_above(self, name: str) -> bool:
        """Whether a variable is first set in a block that it outlives."""
        first, common = self.places[name]
        return first != common

    def _assigned(self, name: str, text: str, kind: Any, indent: str, block: tuple[int, ...]) -> str:
        self.kinds.setdefault(name, kind)
        if name in self.declared or self._is_above(name):
            return f"{indent}{name} = {text};"
        self.declared.add(name)
        return f"{indent}{self._declaration(name, kind)} = {text};"

    def _declaration(self, name: str, kind: Any) -> str:
        if kind == "row":
            return f"const double *{name}"
        constant = "" if _times_set(self.tree, name) > 1 else "const "
        return f"{constant}{_type_name(kind, self.law)} {name}"

    def _unpacked(self, names: list[str], value: ast.expr, indent: str, block: tuple[int, ...]) -> Iterator[str]:
        if isinstance(value, ast.Tuple):
            texts = [self._expression(part) for part in value.elts]
            read = [set(_names_read(part)) for part in value.elts]
            for i, name in enumerate(names):
                if any(name in later for later in read[i + 1 :]):  # it is read before it is set anew
                    yield f"{indent}const double next_{name} = {texts[i]};"
                    texts[i] = f"next_{name}"
            yield from self._in_turn(names, texts, read, indent, block)
            return
        kind = self._kind(value)
        if isinstance(value, ast.Name):
            whole, reach = value.id, "" if self._is_pointer(value) else ".at"
        else:
            whole = "_".join(name.strip("_") for name in names if name != "_")
            yield f"{indent}const {_type_name(kind, self.law)} {whole} = {self._expression(value)};"
            reach = ".at"
        for i, name in enumerate(names):
            if name != "_":
                yield self._assigned(name, f"{whole}{reach}[{i}]", "double", indent, block)

    def _in_turn(
        self, names: list[str], texts: list[str], read: list[set[str]], indent: str, block: tuple[int, ...]
    ) -> Iterator[str]:
        """Set those first that wait for nobody: values that were put aside come last."""
        aside = [text.startswith("next_") for text in texts]
        for wanted in (False, True):
            for name, text, is_aside in zip(names, texts, aside, strict=True):
                if is_aside == wanted:
                    yield self._assigned(name, text, "double", indent, block)

    def _returned(self, value: ast.expr) -> str:
        if isinstance(value, ast.Tuple):
            kind = _type_name(self.kernel.__annotations__["return"], self.law)
            return f"({kind}){{{{{', '.join(map(self._expression, value.elts))}}}}}"
        return self._expression(value)

    # -- expressions

    def _kind(self, node: ast.expr) -> Any:
        """What an expression is: double, a tuple or record that a function gives, a row of a table."""
        match node:
            case ast.Name(id=name):
                return self.kinds.get(name, "double")
            case ast.IfExp(body=body):
                return self._kind(body)
            case ast.Call(func=ast.Name(id=name)) if inspect.isfunction(self.kernel.__globals__.get(name)):
                given = self.kernel.__globals__[name].__annotations__["return"]
                return "double" if given is float else given
            case ast.Subscript(value=ast.Name(id=name)) if _is_rows(self.kinds.get(name)):
                return "row"
        return "double"

    def _expression(self, node: ast.expr, least: int = 0) -> str:
        """Text of an expression, in brackets if it holds together less than it has to."""
        text, strength = self._text(node)
        return f"({text})" if strength < least else text

    def _text(self, node: ast.expr) -> tuple[str, int]:
        match node:
            case ast.Constant(value=value) if isinstance(value, int | float):
                return repr(float(value)), ATOM
            case ast.Name(id=name):
                return self._name(name), ATOM
            case ast.Attribute() if ast.unparse(node) in CONSTANTS:
                return CONSTANTS[ast.unparse(node)], ATOM
            case ast.Attribute(value=value, attr=field):
                return f"{self._expression(value, ATOM)}.{field}", ATOM
            case ast.BinOp() | ast.UnaryOp() | ast.BoolOp() | ast.Compare() | ast.IfExp():
                return self._operation(node)
            case ast.Subscript(value=value, slice=index):
                return self._element(value, index), ATOM
            case ast.Call():
                return self._call(node)
        raise ValueError(f"{self.kernel.__name__}: {ast.unparse(node)} has no C here")

    def _operation(self, node: ast.expr) -> tuple[str, int]:
        match node:
            case ast.BinOp(op=ast.Pow()):
                return f"pow({self._expression(node.left)}, {self._expression(node.right)})", ATOM
            case ast.BinOp(op=op):
                sign, strength = OPERATORS[type(op)]
                right = self._expression(node.right, strength + 1)
                return f"{self._expression(node.left, strength)} {sign} {right}", strength
            case ast.UnaryOp(op=ast.USub()):
                return f"-{self._expression(node.operand, UNARY)}", UNARY
            case ast.UnaryOp(op=ast.Not()):
                return f"!{self._expression(node.operand, UNARY + 1)}", UNARY
            case ast.BoolOp(op=op):
                sign = " && " if isinstance(op, ast.And) else " || "
                return sign.join(self._expression(part, COMPARISON) for part in node.values), CONDITION
            case ast.Compare():
                return self._comparison(node)
            case ast.IfExp():
                test, body = self._expression(node.test, CONDITION), self._expression(node.body, CONDITION)
                return f"{test} ? {body} : {self._expression(node.orelse, CONDITION)}", 0
        raise ValueError(f"{self.kernel.__name__}: {ast.unparse(node)} has no C here")

    def _name(self, name: str) -> str:
        if name in self.kinds:
            return name
        value = self.kernel.__globals__[name]
        return f"{self.law.name}_{name}" if isinstance(value, tuple) else repr(float(value))

    def _comparison(self, node: ast.Compare) -> tuple[str, int]:
        sides = [self._expression(side, COMPARISON + 1) for side in (node.left, *node.comparators)]
        parts = [
            f"{left} {COMPARISONS[type(sign)]} {right}"
            for left, sign, right in zip(sides, node.ops, sides[1:], strict=False)
        ]
        return " && ".join(parts), COMPARISON if len(parts) == 1 else CONDITION

    def _element(self, value: ast.expr, index: ast.expr) -> str:
        place = self._integer(index) if isinstance(index, ast.Constant) else self._expression(index)
        reach = ".at" if _is_tuple_value(self._kind(value)) and not self._is_pointer(value) else ""
        return f"{self._expression(value, ATOM)}{reach}[{place}]"

    def _is_pointer(self, node: ast.expr) -> bool:
        return isinstance(node, ast.Name) and node.id in inspect.signature(self.kernel).parameters

    def _call(self, node: ast.Call) -> tuple[str, int]:
        name = ast.unparse(node.func)
        arguments = [self._expression(argument) for argument in node.args]
        if name.startswith("math."):
            return f"{name.removeprefix('math.')}({', '.join(arguments)})", ATOM
        if name == "abs":
            return f"fabs({arguments[0]})", ATOM
        if name in ("min", "max"):
            first, second = (self._expression(argument, COMPARISON + 1) for argument in node.args)
            return f"{second} {'<' if name == 'min' else '>'} {first} ? {second} : {first}", 0
        called = self.kernel.__globals__[name]
        if _is_record(called):
            return f"({_type_name(called, self.law)}){{{', '.join(arguments)}}}", ATOM
        for i, (parameter, argument) in enumerate(zip(inspect.signature(called).parameters, node.args, strict=True)):
            if _is_rows(called.__annotations__[parameter]):
                arguments[i] += f", {len(self.kernel.__globals__[argument.id])}"  # type: ignore[attr-defined]
        return f"{self.names[called]}({', '.join(arguments)})", ATOM


def _wrapped(text: str, width: int) -> list[str]:
    """Lines of a declaration, which is parted between its parameters alone."""
    whole = text.replace(" ", "\N{NO-BREAK SPACE}").replace(",\N{NO-BREAK SPACE}", ", ")
    lines = textwrap.wrap(whole, width, subsequent_indent="    ", break_long_words=False)
    return [line.replace("\N{NO-BREAK SPACE}", " ") for line in lines]


def _is_tuple_value(kind: Any) -> bool:
    return hasattr(kind, "__args__") and not _is_rows(kind)


def _is_rows(kind: Any) -> bool:
    return Ellipsis in getattr(kind, "__args__", ())


def _names_read(node: ast.AST) -> list[str]:
    return [part.id for part in ast.walk(node) if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Load)]


def _times_set(tree: ast.FunctionDef, name: str) -> int:
    return sum(
        isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store) and part.id == name for part in ast.walk(tree)
    )


def _places(tree: ast.FunctionDef) -> dict[str, tuple[tuple[int, ...], tuple[int, ...]]]:
    """Block in which each local variable is first set, and the innermost block around all its uses."""
    found: dict[str, list[tuple[int, ...]]] = {}

    def walk(statements: list[ast.stmt], block: tuple[int, ...]) -> None:
        for statement in statements:
            inner = [(statement.body, 0), (statement.orelse, 1)] if isinstance(statement, ast.If) else []
            inner = [(statement.body, 0)] if isinstance(statement, ast.For) else inner
            own = [statement.test] if isinstance(statement, ast.If) else [] if inner else [statement]
            for part in own:
                for node in ast.walk(part):
                    if isinstance(node, ast.Name):
                        found.setdefault(node.id, []).append(block)
            for body, which in inner:
                walk(body, (*block, id(statement) + which))

    walk(tree.body, ())
    stored = {n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    first = _first_set(tree)
    return {name: (first[name], _common(found[name])) for name in stored if name in found and name in first}


def _first_set(tree: ast.FunctionDef) -> dict[str, tuple[int, ...]]:
    first: dict[str, tuple[int, ...]] = {}

    def walk(statements: list[ast.stmt], block: tuple[int, ...]) -> None:
        for statement in statements:
            if isinstance(statement, ast.Assign):
                for node in ast.walk(statement):
                    if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                        first.setdefault(node.id, block)
            elif isinstance(statement, ast.If):
                walk(statement.body, (*block, id(statement)))
                walk(statement.orelse, (*block, id(statement) + 1))
            elif isinstance(statement, ast.For):
                walk(statement.body, (*block, id(statement)))

    walk(tree.body, ())
    return first


def _common(blocks: list[tuple[int, ...]]) -> tuple[int, ...]:
    shared = blocks[0]
    for block in blocks[1:]:
        length = next((i for i, (a, b) in enumerate(zip(shared, block, strict=False)) if a != b), None)
        shared = shared[: min(len(shared), len(block)) if length is None else length]
    return shared


def main() -> None:
    """Print a law in C."""
    sys.stdout.write(source(laws[sys.argv[1]]))


if __name__ == "__main__":
    main()
