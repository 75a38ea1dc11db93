"""The public names of a library of headers: `public_names(include)`; those without a doc comment: `undocumented(include)`.

Public is what stands in a namespace that is not internal, in classes what is not private. A name has a doc comment if
one of its declarations has, if it is a variable or alias on the line after a documented one, or if it is a member that
the comment of its class names. No comment is needed for member types, overriding functions, members of the contract of
elements (described in include/kte/contract) and those of tableaus (described by the methods that take them).
"""
import os
import re
from dataclasses import dataclass, field

from declarations import Unreadable, declarations

TABLES = ('_tableau', '_formula', '_coefficients', '_extension')
INTERNAL = {'detail', 'engine', 'tree', 'internal'}
CONTRACT = {'check', 'doForce', 'doMotion', 'parameters', 'ports', 'relative', 'type'}


@dataclass
class Name:
    name: str  # qualified, without kte::
    kind: str
    header: str  # as #include has it
    line: int
    entries: list = field(default_factory=list)  # (header, declaration)
    documented: bool = False


def introduction(text):
    """The comment of a header, above its first namespace."""
    return next((declaration.doc for declaration in declarations(text) if declaration.kind == 'namespace'), '')


def headers(include):
    for directory, folders, files in os.walk(include):
        folders.sort()
        for file in sorted(files):
            if file.endswith('.hpp'):
                path = os.path.join(directory, file)
                yield os.path.relpath(path, include), open(path, encoding='utf-8').read()


def share_comments(declared):
    """A comment is also that of variables and aliases on the next lines, without an empty line between them."""
    for before, after in zip(declared, declared[1:]):
        listed = before.kind == after.kind in ('variable', 'alias') and after.line == before.line + 1
        if before.doc and not after.doc and listed and before.public == after.public:
            after.doc = before.doc


def collect(listed, header, outer, named, found):
    """`named`: the comments of the classes around, which may name members."""
    share_comments(listed)
    for declaration in listed:
        if declaration.kind == 'namespace':
            if not INTERNAL & set(declaration.name.split('::')):
                collect(declaration.members, header, None, '', found)
            continue
        if not declaration.public or (declaration.kind == 'forward' and not declaration.doc):
            continue
        scope = tuple(part for part in '::'.join(declaration.scope).split('::') if part)
        if scope[:1] != ('kte',):
            continue
        scope = scope[1:]
        if declaration.special and not (declaration.kind == 'class' and (declaration.doc or scope + (declaration.name,) in found)):
            continue  # not the specialization of a documented class
        name = found.setdefault(scope + (declaration.name,), Name('::'.join(scope + (declaration.name,)), declaration.kind,
                                                                  header, declaration.line))
        name.entries.append((header, declaration))
        name.documented = name.documented or bool(declaration.doc) or (outer is not None and (
            declaration.kind == 'alias' or declaration.name in CONTRACT or outer.name.endswith(TABLES) or
            declaration.text.endswith((' override', ' final')) or
            re.search(rf'\b{re.escape(declaration.name)}\b', named) is not None))
        if declaration.kind in ('class', 'enum') and 'core' not in scope:
            of_class = ' '.join(entry.doc for _, entry in name.entries)
            collect(declaration.members, header, declaration, named + of_class, found)


def public_names(include):
    """(scope, name) -> Name, in the order of headers."""
    found = {}
    for header, text in headers(include):
        try:
            collect(declarations(text), header, None, '', found)
        except Unreadable as error:
            raise Unreadable(f'{header}:{error}') from None
    for scope, name in found.items():  # the header of the same name is first
        name.entries.sort(key=lambda entry: os.path.basename(entry[0]) != scope[-1] + '.hpp')
        name.header, name.line = name.entries[0][0], name.entries[0][1].line
    return found


def undocumented(include):
    """[(header, line, what)]"""
    return [(os.path.join('include', name.header), name.line, f'{name.kind} kte::{name.name} has no doc comment')
            for name in public_names(include).values() if not name.documented]
