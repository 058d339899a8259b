"""The stubs name what the module has: the same names, parameters, order, kinds and defaults."""
import ast
import pathlib
import re
import shutil
import subprocess
import sys

import penumbra
import pytest

STUBS = pathlib.Path(penumbra.__file__).with_name("__init__.pyi")
TREE = ast.parse(STUBS.read_text())


def parameters(node):
    """[(name, default as text or None)] with '*' where keywords begin, '**' at last, self left out."""
    args = node.args
    static = any(isinstance(d, ast.Name) and d.id == "staticmethod" for d in node.decorator_list)
    defaults = [None] * (len(args.args) - len(args.defaults)) + [ast.unparse(d) for d in args.defaults]
    out = list(zip([a.arg for a in args.args], defaults))
    if out and out[0][0] == "self" and not static:
        out = out[1:]
    if args.kwonlyargs:
        out.append(("*", None))
        out += [(a.arg, d and ast.unparse(d)) for a, d in zip(args.kwonlyargs, args.kw_defaults)]
    return out + ([("**", None)] if args.kwarg else [])


def split(text):
    """At commas outside of brackets and quotes."""
    parts, depth, current = [], 0, ""
    for c in text:
        depth += (c in "([{") - (c in ")]}")
        if c == "," and depth == 0:
            parts.append(current)
            current = ""
        else:
            current += c
    return [p.strip() for p in [*parts, current] if p.strip()]


def bound_parameters(function, name):
    """The same of a bound function, from the first line of its help."""
    found = re.match(rf"{re.escape(name)}\((.*)\) -> ", function.__doc__)
    assert found, function.__doc__
    out = []
    for part in split(found[1]):
        if part.startswith("**"):
            out.append(("**", None))
        elif part == "*":
            out.append(("*", None))
        else:
            left, _, default = part.partition(" = ")
            out.append((left.partition(":")[0], default or None))
    return [p for p in out if p[0] != "self"]


def same(stub, bound):
    return len(stub) == len(bound) and all(
        a == c and (b is None) == (d is None) and (b is None or ast.literal_eval(b) == ast.literal_eval(d))
        for (a, b), (c, d) in zip(stub, bound))


def members(node):
    return {child.name: child for child in node.body if isinstance(child, ast.FunctionDef)}


CLASSES = {node.name: node for node in TREE.body if isinstance(node, ast.ClassDef) and not node.name.startswith("_")}
FUNCTIONS = {}
for node in TREE.body:
    if isinstance(node, ast.FunctionDef):
        FUNCTIONS.setdefault(node.name, []).append(node)


def without_required(overload):
    """An overload asks for its flag; the function has a default, False."""
    return [(name, "False" if name in ("region", "stats", "report", "contacts") else default) for name, default in parameters(overload)]


def test_names_are_the_same():
    assert set(CLASSES) | set(FUNCTIONS) | {"__version__"} == set(penumbra.__all__)
    from penumbra import _penumbra
    assert {name for name in vars(_penumbra) if not name.startswith("__")} | {"__version__"} == set(penumbra.__all__)


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_functions(name):
    for overload in FUNCTIONS[name]:
        assert same(without_required(overload), bound_parameters(getattr(penumbra, name), name)), name


@pytest.mark.parametrize("name", sorted(CLASSES))
def test_classes(name):
    bound = getattr(penumbra, name)
    assert bound.__module__ == "penumbra" and bound.__doc__
    stubbed = members(CLASSES[name])
    inherited = {"__init__", "__new__", "__doc__", "__module__", "__repr__", "__weakref__", "__hash__"}
    own = {key for key in vars(bound) if not key.startswith("_pybind") and key not in inherited}
    assert own == set(stubbed) - {"__init__"}
    for key, node in stubbed.items():
        if isinstance(vars(bound).get(key), property):
            assert any(isinstance(d, ast.Name) and d.id == "property" or isinstance(d, ast.Attribute) for d in node.decorator_list)
        elif key not in ("__len__", "__eq__"):
            overloads = [n for n in CLASSES[name].body if isinstance(n, ast.FunctionDef) and n.name == key]
            for overload in overloads:
                assert same(without_required(overload), bound_parameters(getattr(bound, key), key)), f"{name}.{key}"


def test_the_version_is_one():
    project = pathlib.Path(__file__).resolve().parents[3] / "pyproject.toml"
    assert f'\nversion = "{penumbra.__version__}"\n' in project.read_text()


def test_the_comparison_can_fail():
    one = members(ast.parse("class A:\n def f(self, a: int, *, b: float = 1.0) -> int: ...").body[0])["f"]
    assert same(parameters(one), [("a", None), ("*", None), ("b", "1.0")])
    assert not same(parameters(one), [("a", None), ("*", None), ("b", "2.0")])
    assert not same(parameters(one), [("a", None), ("b", "1.0"), ("*", None)])
    assert not same(parameters(one), [("a", None), ("*", None), ("c", "1.0")])


@pytest.mark.parametrize("name", sorted(penumbra.__all__))
def test_everything_says_what_it_is(name):
    assert name == "__version__" or len(getattr(penumbra, name).__doc__) > 30


@pytest.mark.skipif(not shutil.which("mypy"), reason="mypy is not installed")
def test_mypy_reads_the_stubs():
    found = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--no-incremental", "--cache-dir=/dev/null", str(STUBS)],
                           capture_output=True, text=True)
    assert found.returncode == 0, found.stdout
