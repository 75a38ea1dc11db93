"""Writes kte/elements.py, a function for each element, from the tables of docs/elements.md.

Usage: make_elements.py docs/elements.md elements.py

A test of the C++ library compares the page with the registry of elements: types, ports, parameters and their order.
"""
import re
import sys
import textwrap

CONVERTERS = {
    "number": ("number", "float"),
    "list": ("number_list", "ArrayLike"),
    "flag": ("flag", "bool"),
    "vector": ("vector", "ArrayLike"),
    "unit vector": ("vector", "ArrayLike"),
    "rotation": ("rotation", "Rotation"),
    "matrix": ("matrix", "ArrayLike"),
    "symmetric matrix": ("symmetric", "ArrayLike"),
}
# What C++ leaves out in other ways: `point_mass(m)`, a bushing without coupling.
NO_MATRIX = "((0, 0, 0), (0, 0, 0), (0, 0, 0))"
LEFT_OUT = {
    ("inertia", "com"): "(0, 0, 0)",
    ("inertia", "inertia"): "0",
    ("bushing", "stiffness_coupling"): NO_MATRIX,
    ("bushing", "damping_coupling"): NO_MATRIX,
}
# The surface of a contact: by default the half space below z = 0, in the plane y = 0.
SURFACE = {"surface_axis": "None", "surface_radius": "0"}
# Defaults that are the value of another parameter.
SAME_AS = {"mu": "friction"}


class Row:
    def __init__(self, family, name, dimension, what, unit, text):
        self.family, self.name, self.dimension = family, name, dimension
        self.what, self.unit, self.text = what, unit, text
        self.default = self._default()

    def _default(self):
        if (self.family, self.name) in LEFT_OUT:
            return LEFT_OUT[self.family, self.name]
        if self.name in SURFACE:
            return SURFACE[self.name]
        found = re.search(r"optional(?:, default ([^:;(]+(?:::[a-z]+`)?))?", self.text)
        if not found:
            return None
        if found[1] is None:
            return "False" if self.what == "flag" else "None"
        value = found[1].strip()
        if value == "`axis::z`":
            return "(0, 0, 1)"
        if value == "identity":
            return "None"
        if value in SAME_AS:
            return "None"
        if value in ("infinity", "-infinity"):
            return value.replace("infinity", "inf")
        if self.what == "vector" and value == "0":
            return "(0, 0, 0)"
        float(value)
        return value

    @property
    def omitted(self):
        """Whether a record without it has its default."""
        return self.text.startswith("optional; ") or self.what == "flag"


def plain(text):
    """Without Markdown."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return text.replace("`", "").replace("\\", "\\\\").strip()


def read(path):
    """Of each family: its text, and its rows."""
    families, family, in_text = {}, None, False
    for line in open(path, encoding="utf-8"):
        line = line.rstrip("\n")
        if line.startswith("#"):
            found = re.match(r"## `(\w+)`$", line)
            family, in_text = (found[1] if found else None), True
            if family:
                families[family] = ([], [])
        elif family and line.startswith("| `"):
            in_text = False
            cells = [c.strip() for c in line.strip("|").split(" | ")]
            name, (what, _, unit) = cells[0].strip("` |"), cells[2].partition(", ")
            for dimension in cells[1].split(", "):
                text = cells[3] if len(cells) > 3 else ""
                families[family][1].append(Row(family, name, dimension, what, unit, text))
        elif family and in_text and not line.startswith(("|", "```", "<!--")):
            families[family][0].append(line)
        elif line.startswith("|") or line.startswith("```"):
            in_text = False
    return families


def function(family, dimension, text, rows):
    name = family if dimension == "-" else f"{family}_{dimension}"
    ports = [r for r in rows if r.what == "port"]
    ports.sort(key=lambda r: r.name not in ("loop", "contact"))  # the name of a closure or contact first, as in C++
    parameters = [r for r in rows if r.what not in ("port", "axis z")]
    taken = {p.name for p in ports}
    for p in parameters:
        p.argument = p.name + "_length" if p.name in taken else p.name  # of a crank, which is a coordinate too
    planar = dimension == "2D"

    arguments, needed, optional = [f"{p.name}: str" for p in ports], [], False
    for p in parameters:
        kind = CONVERTERS[p.what][1]
        if planar and p.what == "symmetric matrix":
            kind = "ArrayLike"
        if p.default is not None:
            optional = True
            kind = f"Optional[{kind}]" if p.default == "None" else kind
            arguments.append(f"{p.argument}: {kind} = {p.default}")
        elif optional:  # the order is that of the page
            needed.append(p.argument)
            arguments.append(f"{p.argument}: {kind} = to.required")
        else:
            arguments.append(f"{p.argument}: {kind}")

    doc = [plain(line) if not line.startswith("    ") else line.replace("\\", "\\\\") for line in text]
    doc = "\n".join(doc).strip()
    if ports:
        doc += "\n\nPorts:"
        for p in ports:
            doc += f"\n    {p.name}: {p.unit}" + (f"; {plain(p.text)}" if plain(p.text) else "")
    if parameters:
        doc += "\n\nParameters:"
        for p in parameters:
            unit = p.what + (f", {p.unit}" if p.unit else "")
            description = plain(p.text).replace("axis::z", "(0, 0, 1)")
            description = re.sub(r"; axis::x.*| 1 in files:.*| \(in files [^)]*\)", "", description)
            if p.name == "surface_axis":
                description += "; by default the half space below z = 0, in the plane y = 0, or with a radius a ball"
            description = re.sub(r"; \.at\(position, rotation\) sets the placement.*", "; placement of the joint in its base", description)
            doc += f"\n    {p.argument}: {unit}" + (f"; {description}" if description else "")

    connections = ", ".join(f'("{p.name}", {p.name})' for p in ports)
    values = []
    for p in rows:
        if p.what == "port":
            continue
        if p.what == "axis z":
            values.append(f'("{p.name}", [0.0, 0.0, 1.0])')
            continue
        converter = CONVERTERS[p.what][0]
        if planar and p.what in ("vector", "unit vector", "rotation", "symmetric matrix"):
            converter = "planar_" + CONVERTERS[p.what][0]
        same = re.search(r"default (\w+)$", p.text)
        if same and same[1] in SAME_AS:
            values.append(f'("{p.name}", to.{converter}("{p.name}", {SAME_AS[same[1]]} if {p.argument} is None else {p.argument}))')
        elif p.name == "surface_axis":
            values.append(f'("{p.name}", to.{"planar_" if planar else ""}surface_axis("{p.name}", {p.argument}, surface_radius))')
        elif p.omitted and p.what != "flag":
            values.append(f'("{p.name}", None if {p.argument} is None else to.{converter}("{p.name}", {p.argument}))')
        else:
            values.append(f'("{p.name}", to.{converter}("{p.name}", {p.argument}))')

    lines = [f"def {name}(" + ", ".join(arguments) + ") -> Element:"]
    if len(lines[0]) > 118:
        lines = [f"def {name}("] + [f"    {a}," for a in arguments] + [") -> Element:"]
    lines.append(textwrap.indent(f'"""{doc}\n"""', "    "))
    if needed:
        lines.append(f'    to.require("{name}", ' + ", ".join(f"{a}={a}" for a in needed) + ")")
    lines.append("    return make(")
    lines.append(f'        "{name}",')
    lines.append(f"        [{connections}],")
    lines.append("        [")
    lines += [f"            {v}," for v in values]
    lines.append("        ],")
    lines.append("    )")
    return name, "\n".join(lines)


def main(page, out):
    made = []
    for family, (text, rows) in read(page).items():
        for dimension in dict.fromkeys(r.dimension for r in rows):
            made.append(function(family, dimension, text, [r for r in rows if r.dimension == dimension]))
    head = [
        '"""The elements: joints, links, inertias, forces, motors, sensors, closures of loops, contacts. SI units.',
        "",
        "Ports take the names of coordinates, frames and signals, as strings; parameters are positional or keywords. Those with the",
        "default `required` follow optional ones, and must be given.",
        '"""',
        "from __future__ import annotations",
        "",
        "from math import inf",
        "from typing import Optional",
        "",
        "from numpy.typing import ArrayLike",
        "",
        "from . import _element as to",
        "from ._element import Element, Rotation, make",
        "",
        "__all__ = [",
    ]
    head += [f'    "{name}",' for name, _ in made] + ["]"]
    text = "\n".join(head) + "\n\n\n" + "\n\n\n".join(body for _, body in made) + "\n"
    with open(out, "w", encoding="utf-8") as f:
        f.write(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
