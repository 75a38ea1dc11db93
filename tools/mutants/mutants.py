#!/usr/bin/env python3
"""Shows how much the tests find: puts faults into the source, one at a time, and runs the tests on each.

  mutants.py apply TREE            writes all faults of mutants.txt into a copy of the repository
  mutants.py run --build DIR       runs the tests of this copy, built in DIR, on each fault

All faults are in one build; the environment variable KTE_MUTANT switches on the one of its number. `apply` is for a
clone that is thrown away. A build without sanitizers is enough, for example

  git clone . ../faulty && cd ../faulty && python3 tools/mutants/mutants.py apply .
  cmake -S . -B build -G Ninja -D CMAKE_CXX_COMPILER=clang++ -D CMAKE_BUILD_TYPE=Release \\
    -D "CMAKE_CXX_FLAGS_RELEASE=-O0 -DKTE_NO_FORCED_INLINE -D_GLIBCXX_ASSERTIONS" -D KTE_COMPILED_OPTIMIZE=-O0 -D KTE_READERS_OPTIMIZE=-O0 \\
    -D KTE_PROGRAM_OPTIMIZE=-O0 -D KTE_BUILD_PYTHON=ON -D KTE_PYTHON_OPTIMIZE=-O0
  cmake --build build --target kte_program kte_python_package \\
    $(ninja -C build -t targets all | grep -oE '^tests/[a-z0-9_]+_test:' | tr -d :)

`run` first runs all tests without a fault: the programs FOLDER_test of DIR/tests, and the tests of ctest that are named
program* and python. Then it runs, for each fault, those that reach its place, the programs of its folder first, until
one fails. A test that takes 60 s more than three times its normal time counts as failed. Results are in
DIR/mutants.tsv: a run that is interrupted continues there.
"""
import argparse
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent


def read_table():
    """{number: (file, what is wrong, its text with what is right as group 1, the wrong text, whether ~)}"""
    table, number = {}, 0
    for line in (HERE / 'mutants.txt').read_text().splitlines():
        if line.startswith('    '):
            before, right, wrong, after = line.strip().split('`')
            parts = [r'\s+'.join(map(re.escape, part.split())) for part in (before.rstrip('~'), right, after)]
            table[number] = (path, what, r'{}\s*({})\s*{}'.format(*parts), wrong, before.endswith('~'))
        elif line and not line.startswith('#'):
            number, path, what = re.fullmatch(r'(\d+) (\S+): (.+)', line).groups()
            number = int(number)
    return table


def switched(number, path, right, wrong, of_one_type):
    """Text that is `wrong` if the fault is switched on."""
    if path.endswith('.py'):
        return f'({wrong} if __import__("os").environ.get("KTE_MUTANT") == "{number}" else {right})'
    if right.endswith(';'):
        return f'if (::kte_mutant({number})) {{ {wrong} }} else {{ {right} }}'
    if of_one_type:
        return f'::kte_either({number}, {wrong}, {right})'
    return f'(::kte_mutant({number}) ? ({wrong}) : ({right}))'


def apply(tree):
    files = {}
    for number, (path, _, pattern, wrong, of_one_type) in read_table().items():
        found = list(re.finditer(pattern, (tree / path).read_text()))
        if len(found) != 1:
            sys.exit(f'mutant {number}: {path} has its text {len(found)} times')
        files.setdefault(path, []).append((found[0].span(1), switched(number, path, found[0][1], wrong, of_one_type)))
    for path, changes in files.items():
        text = (tree / path).read_text()
        for (begin, end), new in sorted(changes, reverse=True):
            text = text[:begin] + new + text[end:]
        if not path.endswith('.py'):
            text = text.replace('#pragma once\n', '#pragma once\n#include <kte/detail/mutant.hpp>\n', 1)
        (tree / path).write_text(text)
    shutil.copy(HERE / 'mutant.hpp', tree / 'include/kte/detail')


class Tests:
    """The tests of a build: their commands, normal CPU times, s, and the numbers of faults that they reach."""

    def __init__(self, build, with_long):
        self.build, self.commands, self.normal, self.reached = build, {}, {}, {}
        for program in sorted((build / 'tests').glob('*_test')):
            self.commands[program.name] = [str(program), '--abort'] + ([] if with_long else ['~[long]'])
        listed = subprocess.run(['ctest', '--test-dir', build, '-N'], capture_output=True, text=True, check=True).stdout
        for name in re.findall(r'Test +#\d+: (program\w*|python)$', listed, re.M):
            self.commands[name] = ['ctest', '--test-dir', str(build), '-R', f'^{name}$', '--output-on-failure', '--timeout', '100000']

    def run(self, name, **environment):
        """(what has failed or None, CPU time, s) of a test."""
        limit = 60 + 3 * self.normal[name] if name in self.normal else 36000

        def limited():
            resource.setrlimit(resource.RLIMIT_CPU, (int(limit), int(limit)))
            resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))

        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        environment = dict(os.environ, PYTEST_ADDOPTS='-x', **environment)
        with subprocess.Popen(self.commands[name], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=environment,
                              cwd=self.build / 'tests', preexec_fn=limited, start_new_session=True) as process:
            try:
                output = process.communicate(timeout=10 * limit)[0].decode(errors='replace')  # other programs may run too
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                output = ''
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return (None if process.returncode == 0 else failure(output, process.returncode, seconds > limit)), seconds

    def measure(self, name):
        """Runs a test without a fault; returns (what has failed or None, CPU time, s, "numbers of the faults reached")."""
        log = self.build / 'mutants_reached'
        log.unlink(missing_ok=True)
        failed, seconds = self.run(name, KTE_MUTANTS_REACHED=str(log))
        return failed, f'{seconds:.1f}', ' '.join(sorted(set(log.read_text().split()), key=int) if log.exists() else [])

    def reaching(self, number, path):
        """Those that reach a fault: those of its folder first, then the fastest."""
        parts = path.split('/')
        if path.endswith('.py'):
            return ['python']
        folders = parts[2:-1] + {'contacts': ['contact'], 'python': ['python']}.get(parts[-2], [])
        first = {name + suffix for name in folders for suffix in ('', '_test', '_laws_test')}
        return sorted((name for name in self.commands if number in self.reached[name]),
                      key=lambda name: (name not in first, self.normal[name]))


def failure(output, code, is_late):
    """The name of the first test case that has failed, as the output has it."""
    for pattern, flags in ((r'^-{79}\n(.+?)\n-{79}', re.M | re.S), (r'^FAILED:? (?:\S*/)?(.{1,100})', re.M)):  # Catch2; the others
        if found := re.search(pattern, output, flags):
            return ' / '.join(line.strip() for line in found[1].split('\n'))
    lines = [line for line in output.splitlines() if line.strip()]
    return 'too late' if is_late else f'exit {code}: {lines[-1].strip()[:100] if lines else ""}'


def run(build, only, with_long):
    tests, table, results = Tests(build, with_long), read_table(), build / 'mutants.tsv'
    known = [line.split('\t') for line in results.read_text().splitlines()] if results.exists() else []

    def keep(*columns):
        known.append([str(x) for x in columns])
        with open(results, 'a') as file:
            print(*columns, sep='\t', file=file, flush=True)

    for name in tests.commands:
        if not any(k[0] == '0' and k[1] == name for k in known):
            failed, *measured = tests.measure(name)
            if failed:
                sys.exit(f'{name} fails without a fault: {failed}')
            keep(0, name, *measured)
    for zero, name, seconds, reached in (k for k in known if k[0] == '0'):
        tests.normal[name], tests.reached[name] = float(seconds), {int(x) for x in reached.split()}
    for number, (path, *_) in table.items():
        if (only and number not in only) or any(k[0] == str(number) for k in known):
            continue
        failed, name, names = None, '', tests.reaching(number, path)
        for name in names:
            failed, _ = tests.run(name, KTE_MUTANT=str(number))
            if failed:
                break
        keep(number, *('killed', name, failed) if failed else ('survived', '', ' '.join(names) or 'no test reaches it'))
        print(*known[-1], file=sys.stderr, flush=True)
    for number, (path, what, *_) in table.items():
        for _, result, name, text in (k for k in known if k[0] == str(number)):
            print(f'{number:3} {result:8} {path.removeprefix("include/kte/")}: {what}  [{name}: {text}]'.replace('[: ', '['))
    killed = sum(k[1] == 'killed' for k in known)
    print(f'{killed} killed, {sum(k[1] == "survived" for k in known)} survived')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest='command', required=True)
    commands.add_parser('apply').add_argument('tree', type=Path)
    runs = commands.add_parser('run')
    runs.add_argument('--build', type=Path, required=True)
    runs.add_argument('--only', default='', help='numbers of faults, as 3,7')
    runs.add_argument('--long', action='store_true', help='also test cases with [long]')
    options = parser.parse_args()
    if options.command == 'apply':
        apply(options.tree)
    else:
        run(options.build.resolve(), {int(x) for x in options.only.split(',') if x}, options.long)


if __name__ == '__main__':
    main()
