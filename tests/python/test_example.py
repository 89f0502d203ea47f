"""The worked example, and the Python of README.md as printed there."""

import os
import pathlib
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


def test_readme_runs_as_printed(tmp_path):
    blocks = re.findall(r"```python\n(.*?)```", (SOURCE / "README.md").read_text(), re.DOTALL)
    assert blocks
    (tmp_path / "scenes").symlink_to(SOURCE / "scenes")
    for number, block in enumerate(blocks):
        file = tmp_path / f"block{number}.py"
        file.write_text(block)
        printed = python([file], tmp_path)
        # What a block says it prints stands behind `# ->`; numbers may differ within the stated error.
        for words in re.findall(r"# -> (.*)", block):
            assert words in printed, f"{words!r} is not printed: {printed!r}"
    assert pathlib.Path(tmp_path).exists()
