# What is here: the docstrings of the compiled part of the package copied into its type hints (_core.pyi), where editors
# look for them. What is not: signatures (written by hand, checked by tests/python/test_typing.py).
# Usage: PYTHONPATH=build/release/python python3 tests/python/stub_docs.py    (renews bindings/perfora/_core.pyi)
import ast
import inspect
import textwrap
from pathlib import Path
from types import ModuleType
from typing import Any, Optional, Union

Definition = Union[ast.ClassDef, ast.FunctionDef]
width = 120


def docstring_of(found: Any) -> Optional[str]:
    """Without the signature that pybind11 writes above it; None where there is none."""
    text = inspect.getdoc(found) or ""
    first, _, rest = text.partition("\n")
    if "(" in first and "->" in first:
        text = rest.strip()
    return text or None


def lines_of(text: str, indent: int) -> list[str]:
    """The docstring as it stands in a file."""
    space = " " * indent
    words = " ".join(text.split()).replace("\\", "\\\\")
    last = " " if words.endswith('"') else ""
    filled = textwrap.wrap(f'"""{words}{last}"""', width - indent, break_long_words=False, break_on_hyphens=False)
    return [space + line for line in filled]


def body_of(node: Definition) -> list[ast.stmt]:
    """Without its docstring and `...`."""
    return [one for one in node.body if not (isinstance(one, ast.Expr) and isinstance(one.value, ast.Constant))]


def first_line(node: ast.stmt) -> int:
    """Of a statement, its decorators included."""
    decorators = getattr(node, "decorator_list", [])
    return decorators[0].lineno if decorators else node.lineno


def with_docs(node: Definition, owner: Any, lines: list[str], renewed: dict[int, tuple[int, list[str]]]) -> None:
    """Notes in `renewed` what replaces the lines from the end of the head of a definition to the first of its body."""
    found = inspect.getattr_static(owner, node.name, None)
    if isinstance(found, staticmethod):
        found = found.__func__
    text = docstring_of(found) if not node.name.startswith("__") else None
    begin = first_line(node.body[0])
    head_end = begin if lines[begin - 1].rstrip().endswith(": ...") else begin - 1
    head = lines[head_end - 1].rstrip().removesuffix("...").rstrip()
    rest = body_of(node)
    stop = first_line(rest[0]) - 1 if rest else (node.end_lineno or begin)
    docs = lines_of(text, node.col_offset + 4) if text else []
    if not docs and not rest:
        head += " ..."
    renewed[head_end - 1] = (stop, [head, *docs])
    if isinstance(node, ast.ClassDef):
        for one in rest:
            if isinstance(one, ast.FunctionDef):
                with_docs(one, found, lines, renewed)


def stub_with_docs(stub: str, module: ModuleType) -> str:
    """The text of a stub whose classes and methods have the docstrings of `module`."""
    lines = stub.split("\n")
    renewed: dict[int, tuple[int, list[str]]] = {}
    for node in ast.parse(stub).body:
        if isinstance(node, ast.ClassDef):
            with_docs(node, module, lines, renewed)
    made: list[str] = []
    at = 0
    for begin, (stop, text) in sorted(renewed.items()):
        made += lines[at:begin] + text
        at = stop
    return "\n".join(made + lines[at:])


if __name__ == "__main__":
    import perfora._core

    path = Path(__file__).parents[2] / "bindings" / "perfora" / "_core.pyi"
    path.write_text(stub_with_docs(path.read_text(), perfora._core))
