"""The recipes in packaging/ can be read, and name what kte needs. recipes.py FOLDER-OF-KTE"""
import ast
import json
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

folder = Path(sys.argv[1]) / "packaging"
NEEDED = {"eigen", "boost", "cereal", "tinyxml2"}


def check(recipe, names):
    """Each library that kte needs is in a name."""
    missing = sorted(n for n in NEEDED if not any(n in name for name in names))
    assert not missing, f"{recipe} does not name {', '.join(missing)}"


port = json.loads((folder / "vcpkg/kte/vcpkg.json").read_text())
assert port["name"] == "kte"
check("vcpkg", [d if isinstance(d, str) else d["name"] for d in port["dependencies"]])

conan = ast.parse((folder / "conan/conanfile.py").read_text())
check("conan", [n.args[0].value for n in ast.walk(conan)
                if isinstance(n, ast.Call) and getattr(n.func, "attr", "") == "requires"])
exported = next(n.value for n in ast.walk(conan)
                if isinstance(n, ast.Assign) and getattr(n.targets[0], "id", "") == "SOURCES")
for pattern in ast.literal_eval(exported):
    assert list(folder.parent.glob(pattern)), f"conan exports {pattern}, which is not there"

recipe = (folder / "conda/meta.yaml").read_text()
check("conda", [line.strip() for line in recipe.splitlines() if line.strip().startswith("- ")])

ros = xml.parse(folder / "ros/package.xml").getroot()
assert ros.tag == "package" and ros.get("format") == "3"
for tag in ("name", "version", "description", "maintainer", "license"):
    assert ros.find(tag) is not None, f"ros: package.xml has no {tag}"
check("ros", [d.text for d in ros.iter("depend")])
