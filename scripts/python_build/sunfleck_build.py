"""Provides setuptools as the build backend of pyproject.toml, the system's own if there is one.

pip builds in a separate environment that hides installed packages, and would download setuptools even on machines that have it but
no network. So pyproject.toml requires nothing, and this backend looks for the system's setuptools; it asks pip for setuptools only
if there is none.
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
