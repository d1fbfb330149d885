"""The package as a whole: its examples, its types, its exceptions, and the words of the program."""

import ast
import doctest
import importlib
import inspect
import os
import re
import subprocess
from pathlib import Path

import hssh
import hssh._hssh as native
import pytest

ROOT = Path(__file__).parents[2]
FIXTURES = ROOT / "fixtures"


@pytest.mark.parametrize("page", ["python/README.md", "docs/python.md"])
def test_the_examples_of_the_pages_run(page, monkeypatch):
    monkeypatch.chdir(ROOT)
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(), re.DOTALL)
    assert blocks
    names: dict = {"__name__": page}
    for number, block in enumerate(blocks, 1):
        exec(compile(block, f"{page}, example {number}", "exec"), names)


def test_the_examples_of_the_docstrings_run():
    finder = doctest.DocTestFinder(exclude_empty=True)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    modules = [importlib.import_module(f"hssh.{name}") for name in ("answer", "mapping", "places", "travel")]
    tests = [test for module in modules for test in finder.find(module)]
    classes = [value for value in vars(native).values() if inspect.isclass(value)]
    parser = doctest.DocTestParser()
    tests += [parser.get_doctest(cls.__doc__ or "", {}, cls.__name__, None, 0) for cls in classes]
    for test in tests:
        runner.run(test)
    assert runner.failures == 0 and runner.tries > 20


def test_the_stubs_say_what_is_there():
    stub = ast.parse((Path(hssh.__file__).parent / "_hssh.pyi").read_text())
    public = {name for name in vars(native) if not name.startswith("_")}
    told = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert public == {name for name in told if not name.startswith("_")}
    for name, node in told.items():
        thing = getattr(native, name)
        if isinstance(node, ast.FunctionDef):
            same_parameters(thing, node, name, skip=0)
            continue
        members = {member.name: member for member in node.body if isinstance(member, ast.FunctionDef)}
        there = {member for member in vars(thing) if not member.startswith("_")}
        assert there == {member for member in members if not member.startswith("_")}, name
        for member, definition in members.items():
            decorators = {decorator.id for decorator in definition.decorator_list}
            if "property" not in decorators and not member.startswith("__"):
                same_parameters(getattr(thing, member), definition, f"{name}.{member}", skip="staticmethod" not in decorators)
            assert "property" not in decorators or inspect.isgetsetdescriptor(vars(thing)[member])


def same_parameters(thing, definition, name, skip):
    parameters = list(inspect.signature(thing).parameters)[int(skip) :]
    arguments = definition.args
    told = [argument.arg for argument in [*arguments.posonlyargs, *arguments.args][int(skip) :] + arguments.kwonlyargs]
    assert parameters == told, name


def test_everything_public_is_documented():
    assert (Path(hssh.__file__).parent / "py.typed").exists()
    for name in hssh.__all__:
        thing = getattr(hssh, name)
        if inspect.isclass(thing) or inspect.isfunction(thing):
            assert thing.__doc__, name
        if inspect.isclass(thing) and thing.__module__ == "hssh":
            for member, value in vars(thing).items():
                assert member.startswith("_") or value.__doc__, f"{name}.{member}"


def test_one_tree_of_exceptions():
    raised = [value for value in vars(hssh.errors).values() if inspect.isclass(value) and value.__module__ == "hssh.errors"]
    for error in raised:
        assert issubclass(error, hssh.Error) != issubclass(error, KeyboardInterrupt)
    assert issubclass(hssh.ArgumentError, ValueError) and issubclass(hssh.FormatError, ValueError)
    assert issubclass(hssh.FileError, OSError) and issubclass(hssh.SolveError, ArithmeticError)
    with pytest.raises(hssh.FileError) as caught:
        hssh.read("no-such-file.ron")
    assert caught.value.errno == 2 and str(caught.value).startswith("cannot read no-such-file.ron: ")
    with pytest.raises(hssh.FormatError) as caught:
        hssh.PoseGraph.from_text("EDGE_SE2 0 1 1 0\n")
    assert caught.value.line == 1 and caught.value.column is None


def test_files_are_told_apart_by_their_content():
    assert isinstance(hssh.read(FIXTURES / "aces.ron"), hssh.Exploration)
    assert isinstance(hssh.read(FIXTURES / "graphs" / "two-laps.g2o"), hssh.PoseGraph)
    assert isinstance(hssh.read(FIXTURES / "bags" / "usual"), hssh.Log)
    assert isinstance(hssh.read(FIXTURES / "grids" / "floor.yaml"), hssh.Grid)
    with pytest.raises(hssh.ArgumentError, match="standard input"):
        hssh.read("-")


def program():
    """The program, if it is built."""
    built = [ROOT / "target" / profile / "hssh" for profile in ("debug", "release", "quick")]
    found = [path for path in [Path(os.environ.get("HSSH_PROGRAM", "")), *built] if path.is_file()]
    return found[0] if found else None


@pytest.mark.parametrize(
    "command, read, file",
    [
        ("check", hssh.read_exploration, "malformed/exit_is_closed.ron"),
        ("check", hssh.read_exploration, "malformed/several_problems.ron"),
        ("check", hssh.read_exploration, "malformed/binary_png.ron"),
        ("check", hssh.read_exploration, "no-such-file.ron"),
        ("graph", hssh.read_pose_graph, "aces.ron"),
        ("graph", hssh.read_pose_graph, "grids/floor.yaml"),
        ("track", hssh.read_log, "graphs/two-laps.g2o"),
        ("track", hssh.read_log, "bags/no-laser"),
    ],
)
def test_errors_have_the_words_of_the_program(command, read, file, monkeypatch):
    monkeypatch.chdir(FIXTURES)
    if program() is None:
        pytest.skip("the program is not built: cargo build, or HSSH_PROGRAM names it")
    told = subprocess.run([program(), command, file], capture_output=True, text=True)
    with pytest.raises(hssh.Error) as raised:
        read(file)
    words = told.stderr.strip().removeprefix("error: ")
    assert str(raised.value).strip().removeprefix("error: ") == words


def test_answers_are_those_of_the_program(monkeypatch):
    monkeypatch.chdir(FIXTURES)
    if program() is None:
        pytest.skip("the program is not built: cargo build, or HSSH_PROGRAM names it")

    def lasting(text):
        return [line for line in text.splitlines() if '"seconds' not in line and '"bytes' not in line]

    told = subprocess.run([program(), "map", "aces.ron", "--planar", "--json"], capture_output=True, text=True)
    assert lasting(hssh.map("aces.ron", planar=True).to_json()) == lasting(told.stdout)
    told = subprocess.run([program(), "graph", "graphs/two-laps.g2o", "--json"], capture_output=True, text=True)
    assert lasting(hssh.read_pose_graph("graphs/two-laps.g2o").optimize().to_json()) == lasting(told.stdout)
    told = subprocess.run([program(), "stars", "grids/floor.yaml", "--json"], capture_output=True, text=True)
    assert lasting(hssh.find_places("grids/floor.yaml").to_json()) == lasting(told.stdout)
