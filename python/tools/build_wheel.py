"""A build backend of PEP 517: a wheel by CMake, without other packages.

`pip install ./python --no-build-isolation` needs no network. With the setting `build-dir` the folder of a build with
KTE_BUILD_PYTHON is used: `--config-settings=build-dir=build/release`.
"""
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent.parent
METADATA = """Metadata-Version: 2.1
Name: kte
Version: {version}
Summary: Multibody dynamics of mechanisms and robots
License: MIT
Requires-Python: >=3.11
Requires-Dist: numpy
Provides-Extra: tables
Requires-Dist: pandas; extra == "tables"
"""


def _version():
    return re.search(r'version = "(.*)"', (HERE / "pyproject.toml").read_text())[1]


def _tag():
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"{python}-{python}-{platform}"


def _jobs():
    """How many compilers may run at once: each needs up to 2 GB."""
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    return max(1, min(os.cpu_count() or 1, memory // 2_000_000_000))


def _build(folder):
    """The package in a folder."""
    options = ["BENCH", "EXAMPLES", "PROGRAM", "TESTS"]
    subprocess.check_call(
        ["cmake", "-S", str(HERE.parent), "-B", folder, "-DKTE_BUILD_PYTHON=ON", "-DKTE_INSTALL=OFF"]
        + [f"-DKTE_BUILD_{what}=OFF" for what in options]
        + ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG", f"-DPython3_EXECUTABLE={sys.executable}"]
    )
    subprocess.check_call(["cmake", "--build", folder, "--target", "kte_python_package", "--parallel", str(_jobs())])


def _files(package):
    return [p for p in sorted(package.iterdir()) if p.suffix in (".py", ".pyi", ".so", ".typed") or p.name == "py.typed"]


def _headers():
    """Of `kte.compile`: names in the package, and bytes."""
    root = HERE.parent
    files = {p.relative_to(root): p for p in sorted((root / "include").rglob("*.hpp"))}
    for name in ("frame_named", "static_library", "static_library_of"):
        files[f"include/eval/{name}.hpp"] = root / "apps" / "kte" / "eval" / f"{name}.hpp"
    return {f"kte/{name}": p.read_bytes() for name, p in files.items()}


def _info():
    """The name of the folder of metadata, and its files."""
    wheel = f"Wheel-Version: 1.0\nGenerator: kte\nRoot-Is-Purelib: false\nTag: {_tag()}\n"
    return f"kte-{_version()}.dist-info", {"METADATA": METADATA.format(version=_version()), "WHEEL": wheel}


def _write(wheel, files):
    """A wheel of names and bytes."""
    info, about = _info()
    files.update({f"{info}/{name}": text.encode() for name, text in about.items()})
    record = ""
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{name},sha256={digest},{len(content)}\n"
        archive.writestr(f"{info}/RECORD", record + f"{info}/RECORD,,\n")


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    info, about = _info()
    folder = pathlib.Path(metadata_directory) / info
    folder.mkdir()
    for name, text in about.items():
        (folder / name).write_text(text)
    return info


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"kte-{_version()}-{_tag()}.whl"
    given = (config_settings or {}).get("build-dir")
    with tempfile.TemporaryDirectory() as temporary:
        folder = (HERE.parent / given).resolve() if given else pathlib.Path(temporary)  # pip has left the user's folder
        if not given:
            _build(str(folder))
        package = folder / "python" / "kte"
        if not package.is_dir():
            raise SystemExit(f"kte: {folder} has no python/kte: build it with KTE_BUILD_PYTHON")
        _write(pathlib.Path(wheel_directory) / name, {**{f"kte/{p.name}": p.read_bytes() for p in _files(package)}, **_headers()})
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise SystemExit("kte: a source distribution is the repository; install from there")
