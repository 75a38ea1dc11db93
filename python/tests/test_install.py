"""The package installed by CMake, and its metadata for pip."""
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import kte

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(kte.__file__).resolve().parents[2]


@pytest.mark.skipif(not (BUILD / "CMakeCache.txt").exists(), reason="of a build folder only")
def test_cmake_installs_it(tmp_path):
    subprocess.run(["cmake", "--install", str(BUILD), "--component", "python", "--prefix", str(tmp_path)], check=True, capture_output=True)
    site = tmp_path / "lib" / "python3" / "dist-packages"
    code = "import kte; print(kte.__file__, kte.Chain(kte.base_3D('a')), kte.__version__)"
    environment = {**os.environ, "PYTHONPATH": str(site)}
    out = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True, cwd=tmp_path, env=environment)
    assert str(tmp_path) in out.stdout and "1 element" in out.stdout


def test_pip_builds_this_version():
    about = (ROOT / "pyproject.toml").read_text()
    assert re.search(r'^version = "(.*)"', about, re.M)[1] == kte.__version__
