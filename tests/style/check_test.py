#!/usr/bin/env python3
"""tools/style/check.py finds one place of each kind, where it is, and counts what allowed.txt allows."""
import os
import subprocess
import sys
import tempfile

checker = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'tools', 'style', 'check.py')
HEADER = '''#pragma once
namespace kte {
/// Mass, kg. The body,
/// of which nothing is known.
double mass();
double unexplained();
/// The state of a joint: `position`, rad.
template <class S>
requires(sizeof(S) > 4) struct state {
  S position;
  S velocity;
  double energy() const { return 0; }

 private:
  int hidden;
};
namespace detail {
int internal();
}
}  // namespace kte
'''
PAGE = '''# A page

{long}

The same of plates. `the same as` in code, as this:

```
who wishes has code
```

| a table | {long} |
|---|---|

The forest is searched.
'''.format(long='word ' * 30)
EXPECTED = {
    'docs/page.md:3: 150 columns',
    'docs/page.md:5: "The same": say what it computes; name the difference to the other call',
    'docs/page.md:14: "forest": tree',
    'include/kte/mass.hpp:4: "of which": whose; or a new sentence',
    'include/kte/mass.hpp:6: function kte::unexplained has no doc comment',
    'include/kte/mass.hpp:11: variable kte::state::velocity has no doc comment',
    'include/kte/mass.hpp:12: function kte::state::energy has no doc comment',
}


def run(root, *options):
    done = subprocess.run([sys.executable, checker, '--root', root, *options], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout.splitlines()


def write(root, file, text):
    path = os.path.join(root, file)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, 'w', encoding='utf-8') as out:
        out.write(text)


def expect(what, found, wanted):
    if found != wanted:
        sys.exit(f'{what}:\nfound    {found}\nexpected {wanted}')


with tempfile.TemporaryDirectory() as root:
    write(root, 'include/kte/mass.hpp', HEADER)
    write(root, 'docs/page.md', PAGE)
    code, lines = run(root)
    expect('exit code', code, 1)
    expect('places', {line for line in lines if 'allowed' not in line}, EXPECTED)
    code, lines = run(root, '--list', 'words')
    expect('places of one rule', lines, ['docs/page.md:14: "forest": tree', 'words: 1, allowed 0'])

    write(root, 'tools/style/allowed.txt', '# rule and count\nphrases 2\nwords 1\nlong lines 1\nundocumented 3\n')
    code, lines = run(root)
    expect('with all allowed', (code, lines),
           (0, ['phrases: 2, allowed 2', 'words: 1, allowed 1', 'long lines: 1, allowed 1', 'undocumented: 3, allowed 3']))

    write(root, 'include/kte/mass.hpp', HEADER.replace('{ return 0; }', '{ return 0; '))
    code, lines = run(root)
    expect('a header that cannot be read', (code, lines), (1, ['kte: kte/mass.hpp:20: a declaration has no end']))
