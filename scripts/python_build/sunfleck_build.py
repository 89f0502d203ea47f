"""setuptools as the build backend of pyproject.toml, the system's own where there is one.

pip builds in an environment of its own that hides what is installed, and would fetch setuptools anew even on machines that have it
and no network. So pyproject.toml requires nothing, and this backend looks for the system's; it asks pip for setuptools only where
there is none.
"""

import sys
import sysconfig

try:
    import setuptools  # noqa: F401
except ImportError:
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    sys.path += ["/usr/lib/python3/dist-packages", f"{sys.base_prefix}/lib/{version}/site-packages", sysconfig.get_path("purelib")]

_WANTED = ["setuptools", "wheel"]

try:
    from setuptools.build_meta import *  # noqa: F403

    import wheel  # noqa: F401

    _MISSING = []
except ImportError:
    _MISSING = _WANTED


def get_requires_for_build_wheel(config_settings=None):
    return _MISSING


def get_requires_for_build_sdist(config_settings=None):
    return _MISSING
