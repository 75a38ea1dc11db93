#!/usr/bin/env python3
"""Finds what the texts of this repository should not have:

  phrases       odd phrases in documentation, comments and messages (phrases.txt beside this file has better ones)
  words         private words, in names too
  long lines    prose over 140 columns; in Markdown without code and the targets of links
  undocumented  public names without a doc comment
  format        files that clang-format would change; only with --format, which takes 6 s

usage: check.py [--format] [--list RULE] [--root DIRECTORY]

Each rule may find as many places as allowed.txt beside this file says, none where it says nothing; more is an error.
--list shows all places of a rule. `sh tools/style/tidy.sh` runs clang-tidy.
"""
import argparse
import bisect
import os
import re
import subprocess
import sys

here = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(here, os.pardir, 'reference'))
from declarations import Unreadable  # noqa: E402
from public_names import undocumented  # noqa: E402

COLUMNS = 140
FORMER = r'^CHANGELOG|^docs/(glossary|decisions)'  # which name the words of former versions
SHOWN = 20  # places of a rule, without --list
COMMENT = re.compile(r'(?P<string>R"(?P<mark>[^(\n]*)\(.*?\)(?P=mark)"|"(?:[^"\\\n]|\\.)*")|\'(?:[^\'\\\n]|\\.)\'|//(?P<comment>[^\n]*)', re.S)


def rules(path):
    """The lists of phrases.txt: name of the rule -> [(letters in every match, expression, better wording)]."""
    found, current = {}, None
    for number, line in enumerate(open(path, encoding='utf-8'), 1):
        line = line.rstrip('\n')
        if re.fullmatch(r'\[\w+\]', line):
            current = found.setdefault(line[1:-1], [])
        elif line and not line.startswith('#'):
            expression, separator, better = line.partition(' => ')
            if not separator or current is None:
                sys.exit(f'kte: {path}:{number}: expected: expression => better wording')
            plain = re.sub(r'\([^)]*\)', '|', expression)
            letters = max(re.split(r'[a-z]\?|\\.|\[[^]]*\]|[^a-z ]', plain), key=len)
            current.append((letters, re.compile(expression, re.M), better))
    return found


def prose_of_markdown(text):
    """(line number, prose, whether its length counts): no code and placeholders; tables may be as wide as they are."""
    code = False
    for number, line in enumerate(text.split('\n'), 1):
        if line.startswith('```'):
            code = not code
        elif not code and not line.startswith('<!--'):
            yield number, re.sub(r'`[^`]*`|@[^@]*@', '``', line), not line.startswith('|')


def prose_of_code(text):
    """The comments of C++, and the texts with a space."""
    number, counted = 1, 0
    for match in COMMENT.finditer(text):
        number, counted = number + text.count('\n', counted, match.start()), match.start()
        if match['comment'] is not None:
            yield number, re.sub(r'`[^`]*`', '``', match['comment'].lstrip('/<').strip()), True
        elif match['string'] and ' ' in match['string']:
            for ahead, line in enumerate(match['string'].strip('"').split('\n')):
                yield number + ahead, line, False


def joined(lines):
    """(text, offsets, line numbers): paragraphs as one line each."""
    text, offsets, numbers, last = [], [], [], None
    size = 0
    for number, prose, measured in lines:
        follows = last is not None and number == last[0] + 1 and measured == last[1] and prose and last[2]
        text.append((' ' if follows else '\n') + prose)
        offsets.append(size + 1)
        numbers.append(number)
        size += len(text[-1])
        last = (number, measured, prose)
    return ''.join(text), offsets, numbers


def matches(text, listed):
    for letters, expression, better in listed:
        if letters in text:
            for match in expression.finditer(text):
                yield match, better


def places(root, files, lists):
    """rule -> [(file, line, what)]"""
    found = {'phrases': [], 'words': [], 'long lines': []}
    for file in files:
        content = open(os.path.join(root, file), encoding='utf-8').read()
        lines = content.split('\n')
        markdown = file.endswith('.md')
        prose = list((prose_of_markdown if markdown else prose_of_code)(content))
        text, offsets, numbers = joined(prose)
        for match, better in matches(text, lists['phrases']):
            line = numbers[max(bisect.bisect_right(offsets, match.start() + 1) - 1, 0)]
            found['phrases'].append((file, line, f'"{match[0].strip(" .;:,")}": {better}'))
        for number, sentence, measured in prose:
            columns = len(re.sub(r'\]\([^)]*\)', ']', sentence) if markdown else lines[number - 1])
            if measured and columns > COLUMNS:
                found['long lines'].append((file, number, f'{columns} columns'))
        if not re.search(FORMER, file):
            for match, better in matches(content, lists['words']):
                line = content.count('\n', 0, match.start()) + 1
                found['words'].append((file, line, f'"{match[0]}": {better}'))
    return found


def would_change(root, files):
    """Files that clang-format would change."""
    command = ['clang-format', '--dry-run', '-ferror-limit=1'] + [file for file in files if not file.endswith('.md')]
    try:
        run = subprocess.run(command, cwd=root, stderr=subprocess.PIPE, text=True, check=True)
    except FileNotFoundError:
        sys.exit('kte: clang-format is not installed')
    changed = sorted(set(re.findall(r'^([^:\n]+):\d+:\d+: warning: code should be clang-formatted', run.stderr, re.M)))
    return [(file, 1, 'clang-format -i') for file in changed]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--format', action='store_true', help='also run clang-format')
    parser.add_argument('--list', metavar='RULE', help='print all places of a rule')
    parser.add_argument('--root', default=os.path.join(here, os.pardir, os.pardir), help='another directory to check')
    given = parser.parse_args()

    files = []
    for directory, folders, names in os.walk(given.root):
        folders[:] = sorted(f for f in folders if not f.startswith('.') and f not in ('build', 'node_modules', 'out'))
        files += [os.path.relpath(os.path.join(directory, name), given.root) for name in sorted(names)
                  if name.endswith(('.md', '.hpp', '.cpp'))]
    found = places(given.root, files, rules(os.path.join(here, 'phrases.txt')))
    try:
        found['undocumented'] = undocumented(os.path.join(given.root, 'include'))
    except Unreadable as error:
        sys.exit(f'kte: {error}')
    if given.format:
        found['format'] = would_change(given.root, files)

    allowed = {}
    path = os.path.join(given.root, 'tools', 'style', 'allowed.txt')
    if os.path.exists(path):
        for line in open(path, encoding='utf-8'):
            if not line.startswith('#'):
                rule, count = line.rsplit(maxsplit=1)
                allowed[rule] = int(count)
    if given.list and given.list not in found:
        sys.exit(f'kte: no rule "{given.list}": {", ".join(found)}')
    failed = False
    for rule, where in found.items():
        limit = allowed.get(rule, 0)
        if rule == given.list or (len(where) > limit and not given.list):
            for file, line, what in where if given.list else where[:SHOWN]:
                print(f'{file}:{line}: {what}')
            if not given.list and len(where) > SHOWN:
                print(f'... all by --list "{rule}"')
        if given.list in (None, rule):
            print(f'{rule}: {len(where)}, allowed {limit}')
        failed = failed or len(where) > limit
    sys.exit(failed and not given.list)


if __name__ == '__main__':
    main()
