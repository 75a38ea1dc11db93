"""The package as a wheel, installed by pip without network, and as pytest runs it."""
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

import kte

SOURCE = Path(__file__).resolve().parents[1]
BUILD = Path(kte.__file__).resolve().parents[2]


@pytest.mark.skipif(importlib.util.find_spec("pip") is None, reason="needs pip")
@pytest.mark.skipif(Path(kte.__file__).resolve().parents[1].name != "python", reason="of a build folder only")
@pytest.mark.parametrize("folder", [str(BUILD), os.path.relpath(BUILD, SOURCE.parent)], ids=["absolute", "relative"])
def test_pip_installs_it(folder, tmp_path):
    command = [sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-index", "--no-deps", "--target"]
    command += [str(tmp_path / "site"), f"--config-settings=build-dir={folder}", str(SOURCE)]
    subprocess.run(command, check=True, capture_output=True, text=True, cwd=tmp_path)
    code = "import kte; print(kte.__file__, kte.Chain(kte.base_3D('a')), kte.__version__)"
    environment = {**os.environ, "PYTHONPATH": str(tmp_path / "site")}
    out = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True, cwd=tmp_path, env=environment)
    assert str(tmp_path) in out.stdout and "1 element" in out.stdout
