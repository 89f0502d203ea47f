"""Builds the compiled part of the Python module with CMake, for `pip install .`; all else stands in pyproject.toml.

If SUNFLECK_BUILD names a build folder that already holds the module (./demo.sh makes one, build/release), that module is
taken.
"""

import os
import pathlib
import re
import shutil
import subprocess

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


def version() -> str:
    """Returns the version that CMakeLists.txt states."""
    return re.search(r"project\(sunfleck VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


class CMakeBuild(build_ext):
    def build_extension(self, extension: Extension) -> None:
        build = os.environ.get("SUNFLECK_BUILD")
        folder = pathlib.Path(build) if build else self._built()
        (module,) = (folder / "python" / "sunfleck").glob("_core*.so")
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(module, target)
        # The scripts of its plots, beside it; in the source tree it finds them in share.
        if not self.inplace:
            shutil.copytree(ROOT / "share" / "plots", target.parent / "plots", dirs_exist_ok=True)

    def _built(self) -> pathlib.Path:
        folder = pathlib.Path(self.build_temp).resolve()
        options = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DSUNFLECK_TESTS=OFF"]
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, *options], check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "sunfleck_python"], check=True)
        return folder


setup(version=version(), ext_modules=[Extension("sunfleck._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
