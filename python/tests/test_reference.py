"""docs/python_reference.md is that of this package."""
import runpy
from pathlib import Path

FOLDER = Path(__file__).parents[1]


def test_the_reference_is_up_to_date():
    page = runpy.run_path(str(FOLDER / "tools" / "make_reference.py"))["page"]()
    expected = (FOLDER.parent / "docs" / "python_reference.md").read_text(encoding="utf-8")
    assert page == expected, "write it anew: PYTHONPATH=... python/tools/make_reference.py docs/python_reference.md"
