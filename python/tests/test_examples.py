"""The examples, the notebook and the page of the documentation run."""
import contextlib
import io
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[1]
EXAMPLES = sorted((FOLDER / "examples").glob("*.py"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.stem)
def test_an_example_runs(path, tmp_path):
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    subprocess.run([sys.executable, str(path)], check=True, cwd=tmp_path, env=environment, capture_output=True, text=True)


@pytest.mark.parametrize("path", sorted((FOLDER / "examples").glob("*.ipynb")), ids=lambda p: p.stem)
def test_a_notebook_runs(path, tmp_path, monkeypatch):
    pytest.importorskip("matplotlib").use("Agg")
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "__main__"}
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), names)


def check_blocks(page, names):
    """Each block of Python continues the one before; the block after it is its output."""
    blocks = re.findall(r"^```python\n(.*?)^```\n(?:```\n(.*?)^```)?", page, re.MULTILINE | re.DOTALL)
    for code, output in blocks:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(code, names)
        if output:
            assert printed.getvalue() == output
    return len(blocks)


def test_the_page_of_the_documentation_runs_and_prints_what_it_says(tmp_path, monkeypatch):
    page = (FOLDER.parent / "docs" / "python.md").read_text(encoding="utf-8")
    monkeypatch.chdir(FOLDER.parent)
    page = page.replace('"swing.html"', "folder + '/swing.html'").replace('"arm.kte"', "folder + '/arm.kte'")
    assert check_blocks(page, {"__name__": "page", "folder": str(tmp_path)}) > 0


PAGES = [FOLDER.parent / "README.md", *sorted((FOLDER.parent / "docs").glob("tutorial_*.md"))]


@pytest.mark.parametrize("path", PAGES, ids=lambda p: p.stem)
def test_the_first_pages_run_and_print_what_they_say(path, tmp_path, monkeypatch):
    page = path.read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    for name, text in re.findall(r"in a file `([\w.]+)`:\n\n```xml\n(.*?)^```", page, re.MULTILINE | re.DOTALL):
        Path(name).write_text(text, encoding="utf-8")
    if check_blocks(page, {"__name__": "page"}) > 0:
        assert list(tmp_path.glob("*.html"))
