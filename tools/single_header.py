#!/usr/bin/env python3
"""Writes kte/static.hpp with all headers of kte that it includes as one file, as for Compiler Explorer.

Usage: single_header.py OUTPUT [COMPILER [OPTIONS]]    by default: c++ -I/usr/include/eigen3

The compiler says which lines include a header, because some stand below conditions: those of a program without KTE_COMPILED.
"""
import re
import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[1]
INCLUDE = FOLDER / "include"
WHOLE = "kte/static.hpp"
OF_KTE = re.compile(r"\s*#\s*include\s*<(kte/[^>]+)>")


def opened(compiler):
    """The headers of kte in the order in which the compiler opens them."""
    command = [*compiler, "-std=c++20", "-H", "-fsyntax-only", "-x", "c++", f"-I{INCLUDE}", "-"]
    run = subprocess.run(command, input=f"#include <{WHOLE}>\n", capture_output=True, text=True)
    if run.returncode != 0:
        raise SystemExit(run.stderr)
    lines = [line for line in run.stderr.splitlines() if line.startswith(".") and f" {INCLUDE}/" in line]
    return [line.split(f"{INCLUDE}/")[1] for line in lines]


def expand(rest, out):
    """The text of the first of the headers, with those that it opens next."""
    header = rest.pop(0)
    out.append(f"// {header}")
    for line in (INCLUDE / header).read_text(encoding="utf-8").splitlines():
        found = OF_KTE.match(line)
        if found and rest and found[1] == rest[0]:
            expand(rest, out)
        elif not found and line.strip() != "#pragma once":
            out.append(line)


if __name__ == "__main__":
    lines = [f"// {WHOLE} and all of kte that it includes, by tools/single_header.py", "//"]
    lines += [f"// {line}".rstrip() for line in (FOLDER / "LICENSE").read_text(encoding="utf-8").splitlines()]
    lines.append("#pragma once")
    headers = opened(sys.argv[2:] or ["c++", "-I/usr/include/eigen3"])
    expand(headers, lines)
    if headers:
        raise SystemExit(f"single_header: found no place for {headers[0]}")
    output = Path(sys.argv[1])
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text("\n".join(lines) + "\n", encoding="utf-8")
