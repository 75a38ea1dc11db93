"""The declarations of a C++ header with their doc comments, read from its text: `declarations(text)`.

Compilers and Doxygen 1.9.4 lose the line breaks of doc comments, and Doxygen the constraints of templates; here both stay
as written. The headers must be formatted by clang-format. Text that does not parse raises `Unreadable` with its line.
"""
import re
from dataclasses import dataclass, field, replace

TOKEN = re.compile(
    r'''(?P<doc>///<?[^\n]*) | (?P<comment>//[^\n]*|/\*.*?\*/) | (?P<directive>^[ \t]*\#(?:[^\n\\]|\\.)*)
    | (?P<raw>R"(?P<mark>[^(]*)\(.*?\)(?P=mark)") | (?P<string>"(?:[^"\\]|\\.)*") | (?P<number>\d(?:[\w.]|'\d|[eE][+-])*)
    | (?P<char>'(?:[^'\\]|\\.)+') | (?P<word>[A-Za-z_]\w*) | (?P<mark2>::|->|<<|&&|\|\||[^\s])''',
    re.X | re.S | re.M)
OPEN, CLOSE = {'(': ')', '[': ']', '{': '}'}, {')', ']', '}'}
SPECIFIERS = {'inline', 'constexpr', 'static', 'virtual', 'explicit', 'friend', 'extern', 'consteval', 'constinit',
              'mutable', 'typename', 'const', 'KTE_INLINE', 'KTE_EXTERN'}


class Unreadable(Exception):
    pass


@dataclass
class Declaration:
    kind: str  # namespace, class, concept, function, variable, alias, enum, enumerator
    name: str
    scope: tuple  # names of namespaces and classes around it
    line: int
    text: str  # as declared, without body
    doc: str = ''
    members: list = field(default_factory=list)
    public: bool = True
    special: bool = False  # a specialization, constructor, destructor, operator, friend, using of another's name


@dataclass
class Token:
    text: str
    kind: str
    start: int
    end: int


def doc_text(lines):
    """Of `///` lines, without marks and common indentation."""
    return '\n'.join(re.sub(r'^///<? ?', '', line) for line in lines).strip('\n')


class Reader:
    def __init__(self, text):
        self.text, self.tokens, self.docs, self.trailing = text, [], {}, {}
        pending, last_line = [], -1
        for match in TOKEN.finditer(text):
            kind, start, end = match.lastgroup, match.start(), match.end()
            if kind == 'mark':
                kind = 'raw'
            if kind in ('directive', 'comment'):
                continue
            if kind == 'doc':
                line = self.line(start)
                begin = text.rfind('\n', 0, start) + 1
                if text[begin:start].strip():  # behind a declaration
                    self.trailing.setdefault(len(self.tokens) - 1, []).append(match.group())
                    tail, tail_line = len(self.tokens) - 1, line
                elif match.group().startswith('///<'):
                    self.trailing.setdefault(len(self.tokens) - 1, []).append(match.group())
                else:
                    if pending and line != last_line + 1:
                        pending = []
                    pending.append(match.group())
                    last_line = line
                continue
            if pending:
                self.docs[len(self.tokens)] = doc_text(pending)
                pending = []
            self.tokens.append(Token(match.group(), kind, start, end))
        self.at = 0

    def line(self, offset):
        return self.text.count('\n', 0, offset) + 1

    def fail(self, what):
        at = self.tokens[min(self.at, len(self.tokens) - 1)]
        raise Unreadable(f'{self.line(at.start)}: {what}')

    def peek(self, ahead=0):
        return self.tokens[self.at + ahead].text if self.at + ahead < len(self.tokens) else ''

    def skip_balanced(self):
        """Past the bracket that opens here and what it holds."""
        depth = 0
        while self.at < len(self.tokens):
            token = self.tokens[self.at]
            if token.kind == 'mark2':
                depth += (token.text in OPEN) - (token.text in CLOSE)
            self.at += 1
            if depth == 0:
                return
        self.fail('a bracket is not closed')

    def skip_angles(self):
        """Past the `<` here and what it holds."""
        depth = 0
        while self.at < len(self.tokens):
            if self.peek() in OPEN:
                self.skip_balanced()
                continue
            depth += {'<': 1, '<<': 2, '>': -1}.get(self.peek(), 0)
            self.at += 1
            if depth == 0:
                return
        self.fail('a template list is not closed')

    def skip_constraint(self):
        """Past a requires-clause, `requires` itself read."""
        while True:
            while self.peek() == '!':
                self.at += 1
            if self.peek() == '(':
                self.skip_balanced()
            elif self.peek() == 'requires':
                self.at += 1
                if self.peek() == '(':
                    self.skip_balanced()
                self.skip_balanced()
            else:
                while True:
                    self.at += 1
                    if self.peek() == '<':
                        self.skip_angles()
                    if self.peek() != '::':
                        break
                    self.at += 1
            if self.peek() not in ('&&', '||'):
                return
            self.at += 1

    def slice(self, first, last):
        """The text of tokens first to last, without comments; last is not in it."""
        if last <= first:
            return ''
        text = self.text[self.tokens[first].start:self.tokens[last - 1].end]
        return re.sub(r'[ \t]*//[^\n]*', '', text)

    def doc_of(self, first, last):
        parts = [self.docs[first]] if first in self.docs else []
        trailing = self.trailing.get(last - 1) or self.trailing.get(last)
        if trailing:
            parts.append(doc_text(trailing))
        return '\n'.join(parts)

    def scope(self, around, kind, class_name=''):
        """The declarations until the brace that closes the scope; a class starts private if `kind` says so."""
        found, public = [], kind != 'class'
        while self.at < len(self.tokens) and self.peek() != '}':
            if self.peek() in ('public', 'private', 'protected') and self.peek(1) == ':':
                public = self.peek() == 'public'
                self.at += 2
                continue
            declaration = self.declaration(around, class_name)
            if declaration:
                declaration.public = public
                found += [replace(declaration, name=name) for name in declaration.name.split(',')]
        return found

    def declaration(self, around, class_name):
        first, special = self.at, False
        start = self.tokens[first].start
        if self.peek() == ';':
            self.at += 1
            return None
        if re.fullmatch(r'[A-Z][A-Z_0-9]+', self.peek()) and self.peek(1) == '(':  # a macro
            self.at += 1
            self.skip_balanced()
            return None

        def made(kind, name, last, **more):
            text = self.slice(first, last)
            doc = self.doc_of(first, self.at)
            return Declaration(kind, name, around, self.line(start), text, doc, special=special, **more)

        # Template heads, attributes, specifiers.
        while True:
            word = self.peek()
            if word == 'template':
                self.at += 1
                if self.peek() != '<':  # an explicit instantiation
                    return self.rest_is_skipped()
                special = special or self.peek(1) == '>'
                self.skip_angles()
                if self.peek() == 'requires':
                    self.at += 1
                    self.skip_constraint()
            elif word == '[' and self.peek(1) == '[':
                self.skip_balanced()
            elif word == 'explicit' and self.peek(1) == '(':
                self.at += 1
                self.skip_balanced()
            elif word in SPECIFIERS:
                special = special or word == 'friend'
                self.at += 1
            else:
                break

        word = self.peek()
        if word == 'namespace':
            self.at += 1
            name = ''
            while self.peek() not in ('{', ';', '='):
                name += self.peek()
                self.at += 1
            if self.peek() != '{':
                return self.rest_is_skipped()
            self.at += 1
            parts = tuple(name.split('::'))
            members = self.scope(around + parts, 'namespace')
            if self.peek() != '}':
                self.fail(f'namespace {name} is not closed')
            self.at += 1
            return Declaration('namespace', name, around, self.line(start), '', self.docs.get(first, ''), members=members)
        if word in ('static_assert',) or (word == 'using' and self.peek(1) == 'namespace'):
            return self.rest_is_skipped()
        if word == 'concept':
            name = self.peek(1)
            self.to_semicolon()
            return made('concept', name, self.at)
        if word == 'using':
            name, alias = self.peek(1), self.peek(2) in ('=', '[')
            self.to_semicolon()
            if not alias:
                name, special = self.tokens[self.at - 2].text, True  # documented where it is declared
            return made('alias', name, self.at)
        if word == 'typedef':
            return self.rest_is_skipped()
        if word in ('class', 'struct', 'union', 'enum'):
            return self.type_declaration(around, class_name, word, made)
        return self.function_or_variable(first, class_name, made)

    def rest_is_skipped(self):
        self.to_semicolon()
        return None

    def to_semicolon(self):
        while self.peek() != ';':
            if self.at >= len(self.tokens):
                self.fail('a declaration has no end')
            if self.peek() in OPEN:
                self.skip_balanced()
            else:
                self.at += 1
        self.at += 1

    def type_declaration(self, around, class_name, kind, made):
        self.at += 1
        if kind == 'enum' and self.peek() in ('class', 'struct'):
            self.at += 1
        while self.peek() in ('[', 'alignas'):
            self.at += self.peek() == 'alignas'
            self.skip_balanced()
        name, specialized = '', False
        while re.fullmatch(r'[A-Za-z_]\w*', self.peek()) and self.peek() != 'final':
            name = self.peek()
            self.at += 1
            if self.peek() == '<':
                specialized = True
                self.skip_angles()
            if self.peek() == '::':
                self.at += 1
        while self.peek() not in ('{', ';'):
            if self.peek() in OPEN:
                self.skip_balanced()
            elif self.peek() == '<':
                self.skip_angles()
            else:
                self.at += 1
        last = self.at
        if self.peek() == ';':
            self.at += 1
            found = made('forward', name, last)
            return found
        self.at += 1
        if kind == 'enum':
            members = self.enumerators(around + (name,))
        else:
            members = self.scope(around + (name,), kind, name)
        if self.peek() != '}':
            self.fail(f'{name} is not closed')
        self.at += 1
        if self.peek() not in (';', '{', '=') and not around[-1:] == (class_name,):  # the type of a constant: struct q_ ... {} q;
            name = self.peek()
            self.to_semicolon()
            return made('variable', name, self.at)
        self.to_semicolon()
        found = made('enum' if kind == 'enum' else 'class', name, last, members=members)
        found.special = found.special or specialized
        return found

    def enumerators(self, around):
        found = []
        while self.peek() != '}':
            first = self.at
            while self.peek() not in (',', '}'):
                if self.peek() in OPEN:
                    self.skip_balanced()
                else:
                    self.at += 1
            last = self.at
            if self.peek() == ',':
                self.at += 1
            token = self.tokens[first]
            found.append(Declaration('enumerator', token.text, around, self.line(token.start), self.slice(first, last),
                                     self.doc_of(first, self.at)))
        return found

    def function_or_variable(self, first, class_name, made):
        names, name, special, qualified, parameters, initialized = '', '', False, False, False, False
        start = self.at
        while True:
            word = self.peek()
            if self.at >= len(self.tokens):
                self.fail('a declaration has no end')
            if word == 'operator':
                special = True
                name = 'operator'
                self.at += 1
                if self.peek() == '(':
                    self.at += 2
                while self.peek() != '(':
                    self.at += 1
            elif word in ('decltype', 'noexcept', '__attribute__') and self.peek(1) == '(':
                self.at += 1
                self.skip_balanced()
            elif word == 'requires':
                self.at += 1
                if initialized:  # an expression
                    if self.peek() == '(':
                        self.skip_balanced()
                    self.skip_balanced()
                else:
                    self.skip_constraint()
            elif word == '<' and not parameters and not initialized:
                self.skip_angles()
            elif word == '(' and not initialized:
                special = special or (not parameters and self.at == start + 1)  # a constructor, a deduction guide
                parameters = True
                self.skip_balanced()
            elif word == '=':
                initialized = True
                if self.peek(1) == 'delete':
                    special = True
                self.at += 1
            elif word == ',' and not parameters and self.peek(2) in ('=', '{', ';') + (() if initialized else (',', '[')):
                names += name + ','
                initialized = False
                self.at += 1
            elif word == ';':
                last = self.at
                self.at += 1
                break
            elif word == ':' and parameters:  # initializers of members
                last = self.at
                self.at += 1
                while True:
                    while self.peek() not in ('(', '{'):
                        if self.peek() == '<':
                            self.skip_angles()
                        else:
                            self.at += 1
                    self.skip_balanced()
                    while self.peek() == '...':
                        self.at += 1
                    if self.peek() == '.':
                        self.at += 3
                    if self.peek() != ',':
                        break
                    self.at += 1
                if self.peek() != '{':
                    self.fail('initializers without a body')
                self.skip_balanced()
                break
            elif word == '{':
                last = self.at
                self.skip_balanced()
                if parameters and not initialized:
                    if self.peek() == ';' and self.tokens[last - 1].text != ')':
                        self.at += 1
                    break
                initialized = True
            elif word == '[':
                self.skip_balanced()
            else:
                if self.tokens[self.at].kind == 'word' and not parameters and not initialized:
                    name = word
                    qualified = self.peek(-1) in ('~', '::')
                self.at += 1
        kind = 'function' if parameters else 'variable'
        if kind == 'variable':
            last = self.at - 1
        found = made(kind, names + name, last)  # `int a, b;` is one declaration of two names
        found.special = found.special or special or qualified or name == class_name
        return found


def declarations(text):
    """The declarations at the top of a header, with those in namespaces and classes as members."""
    reader = Reader(text)
    found = reader.scope((), 'namespace')
    if reader.at < len(reader.tokens):
        reader.fail('a brace closes nothing')
    return found
