"""The stubs say what the module has, all of it and nothing else; all of it is documented."""

import ast
import inspect
import pathlib

import pytest

import dpe
from dpe import _core

PACKAGE = pathlib.Path(dpe.__file__).parent
# What every class has, or what types need not say.
UNSPOKEN = {"__doc__", "__module__", "__weakref__", "__dict__", "__new__", "__reduce__",
            "__getstate__", "__setstate__", "__hash__", "__class__"}


def members(cls):
    names = set(vars(cls)) - UNSPOKEN
    # pybind11 gives every class an __init__ that raises.
    if not (vars(cls).get("__init__").__doc__ or "").startswith("__init__(self"):
        names -= {"__init__"}
    elif "pickle" in cls.__name__ or "__setstate__" in vars(cls):
        names -= {"__init__"}
    return {n for n in names if not n.startswith("_pybind11")}


def stub():
    return ast.parse((PACKAGE / "_core.pyi").read_text()).body


def stub_classes():
    return {node.name: node for node in stub() if isinstance(node, ast.ClassDef)}


def module_classes():
    return {n: c for n, c in vars(_core).items()
            if inspect.isclass(c) and not issubclass(c, BaseException)}


def is_setter(node):
    return any(isinstance(d, ast.Attribute) and d.attr == "setter"
               for d in node.decorator_list)


def test_classes():
    errors = {n for n, c in vars(_core).items()
              if inspect.isclass(c) and issubclass(c, BaseException)}
    assert set(stub_classes()) == set(module_classes()) | errors
    assert errors == {"SceneError", "SceneWarning", "SimulationError"}


@pytest.mark.parametrize("name", module_classes())
def test_members(name):
    cls, node = module_classes()[name], stub_classes()[name]
    functions = [f for f in node.body if isinstance(f, ast.FunctionDef)]
    assert {f.name for f in functions} == members(cls)
    settable = {f.name for f in functions if is_setter(f)}
    assert settable == {n for n, m in vars(cls).items()
                        if isinstance(m, property) and m.fset is not None}


def argument_names(node):
    return [a.arg for a in node.args.posonlyargs + node.args.args + node.args.kwonlyargs
            if a.arg != "self"]


def documented_names(doc):
    """Of a pybind11 signature: its first line is `name(self: T, a: int = 1, ...) -> T`."""
    text = doc.split("\n")[0].replace("dpe._core.", "")
    head = text[: text.rindex(") ->")] + "): pass"
    function = ast.parse("def " + head.replace("<", "'").replace(">", "'")).body[0]
    return [n for n in argument_names(function) if n != "arg0"]


@pytest.mark.parametrize("name", module_classes())
def test_arguments_of_methods(name):
    cls, node = module_classes()[name], stub_classes()[name]
    for function in (f for f in node.body if isinstance(f, ast.FunctionDef)):
        member = getattr(cls, function.name)
        if isinstance(member, property) or function.name.startswith("__"):
            continue
        assert argument_names(function) == documented_names(member.__doc__)


def test_functions():
    functions = {n: f for n, f in vars(_core).items()
                 if inspect.isroutine(f) and not n.startswith("__")}
    nodes = {f.name: f for f in stub() if isinstance(f, ast.FunctionDef)}
    assert set(nodes) == set(functions)
    for name, function in functions.items():
        assert argument_names(nodes[name]) == documented_names(function.__doc__)


def test_everything_public_is_exported():
    public = {n for n in vars(_core) if not n.startswith("_")}
    assert public | {"estimate"} == set(dpe.__all__)
    assert (PACKAGE / "py.typed").exists()


def test_everything_is_documented():
    for name in dpe.__all__:
        thing = getattr(dpe, name)
        assert thing.__doc__ and len(thing.__doc__) > 20, name
        if name not in module_classes():
            continue
        for member, value in vars(thing).items():
            if member.startswith("_"):
                continue
            doc = value.__doc__ or getattr(thing, member).__doc__ or ""
            text = doc if isinstance(value, property) else doc.partition("\n")[2]
            assert len(text.strip()) > 3, (name, member)
