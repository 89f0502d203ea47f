"""Tests the worked example, and the Python code of docs/python.md as printed there."""

import os
import re
import subprocess
import sys

from conftest import SOURCE

PNG = b"\x89PNG\r\n\x1a\n"


def python(arguments, folder):
    environment = {**os.environ, "MPLCONFIGDIR": str(folder)}
    outcome = subprocess.run([sys.executable, "-B", *map(str, arguments)], cwd=folder, env=environment, capture_output=True, text=True)
    assert outcome.returncode == 0, outcome.stderr
    return outcome.stdout


def test_worked_example_draws_its_figure(tmp_path):
    lines = python([SOURCE / "scenes" / "light_by_leaf.py", tmp_path / "figure.png", "0.2"], tmp_path).splitlines()
    assert (tmp_path / "figure.png").read_bytes().startswith(PNG)
    absorbed = [float(line.split()[-1]) for line in lines if "absorbed by leaves" in line]
    assert len(absorbed) == 3 and absorbed == sorted(absorbed)


def test_manual_runs_as_printed(tmp_path):
    section = (SOURCE / "docs" / "python.md").read_text().split("## An example\n")[1].split("\n## ")[0]
    (block,) = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    (expected,) = re.findall(r"prints\n\n```text\n(.*?)```", section, re.DOTALL)
    (tmp_path / "block.py").write_text(block)
    assert python([tmp_path / "block.py"], tmp_path) == expected
