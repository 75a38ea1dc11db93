"""Pages that show mechanisms."""
from __future__ import annotations

import html
import os
import tempfile
from pathlib import Path
from typing import Iterable, Optional, Union

from ._kte import Chain, Recording, Robot, _write_page


class Page:
    """A page that shows a mechanism: one HTML file. Jupyter shows it inline."""

    def __init__(self, text: str, path: Optional[Path] = None, height: int = 480) -> None:
        self.text = text
        #: the file, if there is one
        self.path = path
        #: of the page in a notebook, pixels
        self.height = height

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the page to a file."""
        Path(path).write_text(self.text, encoding="utf-8")

    def _repr_html_(self) -> str:
        return (
            f'<iframe srcdoc="{html.escape(self.text)}" width="100%" height="{self.height}" style="border:0" '
            'sandbox="allow-scripts allow-downloads"></iframe>'
        )

    def __repr__(self) -> str:
        where = f", in {self.path}" if self.path else ""
        return f"<kte.Page: {len(self.text)} characters of HTML{where}>"


def view(
    what: Union[Chain, Robot, Recording],
    path: Union[None, str, "os.PathLike[str]"] = None,
    *,
    title: str = "",
    columns: Iterable[str] = (),
    height: int = 480,
    mesh_bytes: int = 4 << 20,
    recording_bytes: int = 8 << 20,
) -> Page:
    """A page of a chain, a robot or a recording, which needs no network; with `path` also as a file.

    `columns` are quantities to plot, as in `Recording.columns`. Pages have at most `mesh_bytes` of meshes, and
    `recording_bytes` of motion.
    """
    if path is not None:
        _write_page(what, Path(path), title, tuple(columns), mesh_bytes, recording_bytes)
        return Page(Path(path).read_text(encoding="utf-8"), Path(path), height)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "page.html"
        _write_page(what, file, title, tuple(columns), mesh_bytes, recording_bytes)
        return Page(file.read_text(encoding="utf-8"), None, height)
