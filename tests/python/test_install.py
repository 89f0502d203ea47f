"""Tests the module where users install it: with pip in a virtual environment, and with CMake below a prefix."""

import os
import pathlib
import shutil
import subprocess
import sys

import sunfleck
from conftest import SOURCE, WORK, with_arrays

BUILD = pathlib.Path(sunfleck.__file__).parents[2]
CODE = (
    "import sys; sys.path.insert(0, sys.argv[1])\n"
    "import conftest, sunfleck, sunfleck.caribu\n"
    "print(sunfleck.__file__)\n"
    "print(sunfleck.run(conftest.with_arrays(), **conftest.WORK).table('organs.csv'), end='')\n"
)


def run(arguments, **environment):
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    outcome = subprocess.run([str(a) for a in arguments], env={**clean, **environment}, capture_output=True, text=True)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
    return outcome.stdout


def check(python, place, **environment):
    """Checks that the module comes from that place, and computes the same as the build's own module."""
    file, table = run([python, "-B", "-c", CODE, os.path.dirname(__file__)], **environment).split("\n", 1)
    assert pathlib.Path(file).is_relative_to(place)
    assert table == sunfleck.run(with_arrays(), **WORK).table("organs.csv")
    installed = pathlib.Path(file).parent / "plots"
    assert {path.name for path in installed.iterdir()} == {path.name for path in (SOURCE / "share" / "plots").iterdir()}


def test_pip(tmp_path):
    run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv"])
    # Installs from a copy, because pip leaves its build files beside the sources. The compiled part is that of this build.
    source = tmp_path / "source"
    source.mkdir()
    for name in ("CMakeLists.txt", "README.md", "pyproject.toml", "setup.py"):
        shutil.copy(SOURCE / name, source)
    for name in ("scripts", "share", "src/programs/python"):
        shutil.copytree(SOURCE / name, source / name)
    pip = [tmp_path / "venv" / "bin" / "pip", "install", "--quiet", "--no-index", source]
    run(pip, SUNFLECK_BUILD=str(BUILD))
    check(tmp_path / "venv" / "bin" / "python", tmp_path / "venv")
    shown = run([tmp_path / "venv" / "bin" / "pip", "show", "sunfleck"])
    assert f"Version: {sunfleck.__version__}" in shown


def test_cmake(tmp_path):
    run(["cmake", "--install", BUILD, "--prefix", tmp_path, "--strip"])
    (package,) = tmp_path.glob("lib/python3*/dist-packages/sunfleck")
    check(sys.executable, tmp_path, PYTHONPATH=str(package.parent))
    assert run([tmp_path / "bin" / "sunfleck", "--version"]).startswith("sunfleck ")
