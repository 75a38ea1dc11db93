"""Shows kte's vectors, typed constants and static chains in GDB: `source kte.py`, or in ~/.gdbinit.

    (gdb) print link
    $1 = rigid_link_2D(joint, tip) = {position = (0.5, 0_c, 0_c), rotation = none}
    (gdb) print pendulum
    $2 = static chain of 3 elements = {[0] = revolute_joint_2D(q, base, joint), ...}

Frames and coordinates are then shown by their members. Names of chains come from the names of their types.
"""

import re

import gdb
import gdb.printing
import gdb.types


def split(name):
    """'a<b<c>, d>' gives ('a', ['b<c>', 'd']); commas in texts and in other templates are no ends."""
    begin = name.find("<")
    if begin < 0:
        return name, []
    parts, depth, text, part = [], 0, False, ""
    for i, c in enumerate(name[begin + 1 : name.rindex(">")]):
        if c == '"' and not part.endswith("\\"):
            text = not text
        depth += 0 if text else (c in "<({") - (c in ">)}")
        if c == "," and depth == 0 and not text:
            parts.append(part.strip())
            part = ""
        else:
            part += c
    return name[:begin], parts + [part.strip()]


def unescaped(text):
    """g++ writes bytes above 127 as octal numbers of negative integers."""
    octal = re.compile(rb"\\(?:37777777([0-7]{3})|([0-7]{1,3})|(.))")
    byte = lambda m: m.group(3) or bytes([int(m.group(1) or m.group(2), 8) % 256])
    return octal.sub(byte, text.encode()).decode("utf-8", "replace")


def key_text(name):
    """The text of a key: g++ has it as {"q"} in the name of its base, clang as {{113, 0}}."""
    base = gdb.lookup_type(name).strip_typedefs()
    while base.fields() and base.fields()[0].is_base_class:
        base = base.fields()[0].type
        quoted = re.search(r'\{"(.*)"\}', base.name)
        if quoted:
            return unescaped(quoted.group(1))
        numbers = re.search(r"\{\{([-\d, ]+)\}\}", base.name)
        if numbers:
            codes = [int(n) % 256 for n in numbers.group(1).split(",")]
            return bytes(codes[:-1]).decode("utf-8", "replace")
    return name


def core_name(name):
    """'kte::core::rigid_link<(kte::kind)1, ...>' is a rigid_link_2D."""
    stem, arguments = split(name)
    stem = stem.split("::")[-1]
    if stem == "placed_joint":
        return core_name(arguments[0])
    for kind, suffix in (("0", "gen"), ("1", "2D"), ("2", "3D")):
        if arguments and re.fullmatch(r"\(kte::kind\)%s|kte::kind::(frame_)?%s" % (kind, suffix), arguments[0]):
            return stem + "_" + suffix
    return stem


def element_text(name):
    _, (core, *keys) = split(name)
    return "%s(%s)" % (core_name(core), ", ".join(key_text(k) for k in keys))


def type_of(value):
    return gdb.types.get_basic_type(value.type)


def members(value):
    """Names and values of the members that take room, those of bases first."""
    for f in type_of(value).fields():
        if hasattr(f, "bitpos"):  # which static ones have not
            yield from members(value[f]) if f.is_base_class else [(f.name, value[f])]


class constant:
    """0_c, 1_c, -1_c: the number is the type."""

    def __init__(self, value):
        self.text = split(type_of(value).name)[1][0] + "_c"

    def to_string(self):
        return self.text


class no_rotation:
    def __init__(self, value):
        pass

    def to_string(self):
        return "none"


class row:
    """Vectors, and matrices by rows."""

    def __init__(self, value):
        self.value = value

    def to_string(self):
        return "(%s)" % ", ".join(x.format_string() for _, x in members(self.value))


class element:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        return element_text(type_of(self.value).name)

    def children(self):
        return members(self.value["core"])


class static_chain:
    def __init__(self, value):
        self.elements = split(type_of(value).name)[1][1:]

    def to_string(self):
        return "static chain of %d elements" % len(self.elements)

    def children(self):
        for i, e in enumerate(self.elements):
            yield "[%d]" % i, element_text(e)


def printers():
    all_of = gdb.printing.RegexpCollectionPrettyPrinter("kte")
    for name, printer in (
        ("constant", constant),
        ("no_rotation", no_rotation),
        ("(vec2|vec3|mat3|sym3)", row),
        ("element", element),
        ("static_chain", static_chain),
    ):
        all_of.add_printer(name, "^kte::%s(<.*>)?$" % name, printer)
    return all_of


gdb.printing.register_pretty_printer(None, printers(), replace=True)
