#!/usr/bin/env python3
"""Writes the pages of docs/ and of the API reference as Markdown for mkdocs: pages.py OUTPUT. See docs/build.sh.

Ends with an error if a public name has no doc comment, or if README or docs/*.md name something that is not public.
"""
import html
import os
import re
import shutil
import sys

sys.dont_write_bytecode = True
from declarations import Unreadable
from public_names import introduction, public_names

root = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..'))
FOLDERS = {  # folder of include/kte -> title of its page, in the order of the menu
    '': 'Whole areas', 'frames': 'Frames', 'math': 'Mathematics', 'elements': 'Elements', 'contract': 'Contract of elements',
    'static_chain': 'Static chains', 'runtime_chain': 'Runtime chains', 'dynamics': 'Algorithms', 'models': 'Systems',
    'integrators': 'Integrators', 'events': 'Events', 'control': 'Control', 'manipulators': 'Manipulators', 'io': 'Files',
    'robots': 'Robots', 'view': 'View', 'adapters': 'Adapters', 'reak': 'ReaK', 'testing': 'Testing'}
NOT_NAMES = {'core', 'io', 'sundials', 'robots', 'kte', 'compiled', 'view', 'live', 'mpi', 'detail'}  # CMake targets
KINDS = {'class': 'class', 'forward': 'class', 'enum': 'enumeration', 'enumerator': 'enumerator', 'alias': 'type', 'variable': 'constant',
         'function': 'function', 'concept': 'concept'}


def read(path):
    with open(path, encoding='utf-8') as file:
        return file.read()


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, 'w', encoding='utf-8') as file:
        file.write(text)


def page_of(header):
    folder = header.split('/')[1] if header.count('/') > 1 else ''
    return (folder if folder in FOLDERS else 'internal') or 'areas'


def anchor(name):
    return name.replace('::', '.')


def linked(text, links, around):
    """HTML of a line of a comment: `code`, with links to the entries of names."""
    parts = re.split(r'(`[^`]+`)', text)
    for at, part in enumerate(parts):
        if part.startswith('`') and len(part) > 2:
            code = part[1:-1]
            name = re.sub(r'^kte::|\(.*\)$', '', code)
            target = links.get(f'{around}::{name}') or links.get(name)
            code = f'<code>{html.escape(code)}</code>'
            parts[at] = f'<a href="{target}">{code}</a>' if target else code
        else:
            parts[at] = html.escape(part)
    return ''.join(parts)


def comment(text, links, around):
    """HTML of a doc comment: indented lines are kept as they are, others are paragraphs."""
    found, paragraph, kept = [], [], []

    def end():
        if paragraph:
            found.append('<p>' + linked(' '.join(paragraph), links, around) + '</p>')
            paragraph.clear()
        if kept:
            found.append('<pre><code>' + html.escape('\n'.join(kept).rstrip()) + '\n</code></pre>')
            kept.clear()

    for line in text.split('\n'):
        if line.startswith('  '):
            if paragraph:
                end()
            kept.append(line[2:])
        elif not line.strip():
            if kept:
                kept.append('')
            else:
                end()
        else:
            if kept:
                end()
            paragraph.append(line.strip())
    end()
    # Markdown leaves a block of HTML alone up to its first empty line.
    return '<div class="kte-comment">' + ''.join(found).replace('\n\n', '\n&#8203;\n') + '</div>\n'


def signature(declaration):
    text = re.sub(r'\b(KTE_INLINE|KTE_EXTERN) |\[\[gnu::[^]]*\]\] ', '', declaration.text)
    lines = text.split('\n')
    margin = min((len(line) - len(line.lstrip()) for line in lines[1:] if line.strip()), default=0)
    if declaration.kind == 'class' or len(declaration.scope) > 1:
        margin = min(margin, 2 * (len(declaration.scope) - 1))
    lines[1:] = [line[margin:] for line in lines[1:]]
    text = '\n'.join(lines).rstrip()
    return text if text.endswith((';', ',')) or declaration.kind == 'enumerator' else text + ';'


def entry(name, level, links):
    """An entry of the reference: how it is declared, in which header, and the comments."""
    around = name.name.rpartition('::')[0] if level > 3 else name.name
    found = [f'{"#" * level} {name.name} {{#{anchor(name.name)}}}\n']
    if level == 3:
        found.append(f'<p class="kte-kind">{KINDS[name.kind]} · <code>#include &lt;{name.header}&gt;</code></p>\n')
    done, header = set(), name.header
    group, groups = None, []
    for where, declaration in name.entries:
        if group is None or declaration.doc:
            group = (declaration.doc, where, [])
            groups.append(group)
        if (text := signature(declaration)) not in done:
            done.add(text)
            group[2].append(text)
    for doc, where, texts in groups:
        if where != header:
            found.append(f'<p class="kte-kind">also <code>#include &lt;{where}&gt;</code></p>\n')
            header = where
        if texts:
            found.append('```cpp\n' + ('\n\n' if any('\n' in text for text in texts) else '\n').join(texts) + '\n```\n')
        if doc:
            found.append(comment(doc, links, around))
    return '\n'.join(found) + '\n'


def reference(names, output):
    """The pages of the reference: one for each folder, in it the headers, in them the names."""
    target = {name.name: f'{page_of(name.header)}.html#{anchor(name.name)}' for name in names.values()}
    by_page = {}
    for scope, name in names.items():
        by_page.setdefault(page_of(name.header), {}).setdefault(name.header, []).append((scope, name))
    for page, by_header in by_page.items():
        title = FOLDERS.get('' if page == 'areas' else page, 'Shared by several')
        text = [f'# {title}\n']
        for header in sorted(by_header):
            text.append(f'## {header.removeprefix("kte/")}\n')
            if above := introduction(read(os.path.join(root, 'include', header))):
                text.append(comment(above, target, ''))
            for scope, name in by_header[header]:
                member = scope[:-1] in names
                text.append(entry(name, 4 if member else 3, target))
        write(os.path.join(output, 'api', page + '.md'), '\n'.join(text))
    order = [folder or 'areas' for folder in FOLDERS] + ['internal']
    listed = '\n'.join(f'* [{FOLDERS.get("" if page == "areas" else page, "Shared by several")}]({page}.md)' for page in order
                       if page in by_page)
    write(os.path.join(output, 'api', 'index.md'), f'''# API reference

Every public name of kte, by the folder of its header. All are in namespace `kte`. The search box finds them by name.

{listed}
''')
    return target


def with_tabs(text):
    """A page whose blocks under **C++** and **Python** that follow each other are tabs."""
    def tabs(match):
        return ''.join(f'=== "{language}"\n\n' + ''.join(f'    {line}\n' if line else '\n' for line in part.split('\n'))
                       for language, part in (('C++', match[1]), ('Python', match[2]))) + '\n'
    blocks = r'((?:```\w*\n(?:.*?\n)```\n)+)'
    return re.sub(rf'^\*\*C\+\+\*\*\n\n{blocks}\n\*\*Python\*\*\n\n{blocks}', tabs, text, flags=re.MULTILINE | re.DOTALL)


def docs_page(path, text, target):
    """A page of the repository for mkdocs: links between pages, lists, names linked to the reference, tabs."""
    folder = os.path.dirname(path)
    here = 'index.md' if path == 'README.md' else os.path.relpath(path, 'docs') if path.startswith('docs/') else path
    up = os.path.relpath('.', os.path.dirname(here) or '.')

    def link(match):
        address, mark, part = match[2].partition('#')
        if not address or re.match(r'\w+:', address):
            return match[0]
        file = os.path.normpath(os.path.join(folder, address))
        if os.path.isdir(os.path.join(root, file)):
            return f'{match[1]}{match[3]}' if match[1] != '](' else '](' + os.path.join(up, 'index.md') + ')'
        if not os.path.exists(os.path.join(root, file)):
            sys.exit(f'kte: {path}: a link to {match[2]}, which does not exist')
        if file == 'README.md':
            goal = 'index.md'
        elif file.startswith('docs/'):
            goal = file[5:]
        else:
            goal = file if file.endswith('.md') else 'files/' + file + '.md'
            if not file.endswith('.md'):
                language = 'cpp' if file.endswith(('.hpp', '.cpp')) else 'text'
                write(os.path.join(output, goal), f'# {file}\n\n```{language}\n{read(os.path.join(root, file))}\n```\n')
        return match[1] + os.path.relpath(goal, os.path.dirname(here) or '.') + mark + part + match[3]

    lines, code, before = [], False, ''
    for line in text.split('\n'):
        if line.startswith('```'):
            code = not code
        elif not code:
            if re.match(r'([*-]|\d+\.) ', line) and before.strip() and not re.match(r'([*-]|\d+\.) |  ', before):
                lines.append('')
            line = re.sub(r'(\]\()([^)\s]+)(\))', link, line)
            line = re.sub(r'(<img src=")([^"]+)(")', link, line)
            if not line.startswith('#'):
                def name(match):
                    entry = target.get(re.sub(r'^kte::', '', match[1]))
                    if not entry:
                        return match[0]
                    page, _, part = entry.partition('.html')
                    return f'[`{match[1]}`]({os.path.join(up, "api", page)}.md{part})'
                line = re.sub(r'(?<!\[)`([\w:]{4,})`(?!\])', name, line)
        lines.append(line)
        before = line
    write(os.path.join(output, here), with_tabs('\n'.join(lines)))


def check_names(path, text, names):
    """Fails for kte::NAME in a page if the reference has no such name."""
    for number, line in enumerate(text.split('\n'), 1):
        for match in re.finditer(r'\bkte::([a-z_]\w*)', line):
            if match[1] not in names and match[1] not in NOT_NAMES:
                sys.exit(f'kte: {path}:{number}: kte::{match[1]} is not in the API reference')


def menu(pages):
    """The pages in the order in which the README names them, then the others."""
    order = re.findall(r'\]\((docs/\w+\.md)', read(os.path.join(root, 'README.md')).rpartition('## Documentation')[2])
    steps = re.findall(r'\]\((tutorial_\w+\.md)', read(os.path.join(root, 'docs/tutorial.md')))
    tutorial = ['docs/tutorial.md'] + ['docs/' + step for step in steps]
    release = 'docs/release.md'
    guides = [path for path in pages if re.fullmatch(r'docs/\w+\.md', path) and path not in [*tutorial, release]]
    guides.sort(key=lambda path: order.index(path) if path in order else len(order))
    decisions = [path for path in pages if path.startswith('docs/decisions/')]
    listed = lambda paths: ''.join(f'      - {path.removeprefix("docs/")}\n' for path in paths)
    api = ''.join(f'      - api/{page}.md\n' for page in ['index'] + [folder or 'areas' for folder in FOLDERS] + ['internal']
                  if os.path.exists(os.path.join(output, 'api', page + '.md')))
    return ('nav:\n  - index.md\n  - Tutorial:\n' + listed(tutorial) + '  - Guide:\n' + listed(guides) + '  - API reference:\n' + api +
            '  - Decisions:\n' + listed(decisions) +
            '  - Project:\n      - CONTRIBUTING.md\n      - SECURITY.md\n      - CHANGELOG.md\n' + listed([release]))


def main():
    names = public_names(os.path.join(root, 'include'))
    missing = [name for name in names.values() if not name.documented]
    for name in missing:
        print(f'kte: include/{name.header}:{name.line}: {name.kind} kte::{name.name} has no doc comment', file=sys.stderr)
    shutil.rmtree(output, ignore_errors=True)
    target = reference(names, output)
    pages = sorted(file for file in os.listdir(root) if file.endswith('.md'))
    for directory, _, files in sorted(os.walk(os.path.join(root, 'docs'))):
        for file in sorted(files):
            path = os.path.relpath(os.path.join(directory, file), root)
            if file.endswith('.md'):
                pages.append(path)
            elif not file.endswith('.sh'):
                os.makedirs(os.path.join(output, os.path.relpath(directory, os.path.join(root, 'docs'))), exist_ok=True)
                shutil.copy(os.path.join(root, path), os.path.join(output, os.path.relpath(path, 'docs')))
    known = {scope[0] for scope in names} | {'::'.join(scope) for scope in names}
    for path in pages:
        text = read(os.path.join(root, path))
        if re.fullmatch(r'README.md|docs/\w+.md', path):
            check_names(path, text, known)
        docs_page(path, text, target)
    write(os.path.join(output, os.pardir, 'mkdocs.yml'), read(os.path.join(root, 'tools/reference/mkdocs.yml')) + menu(pages))
    for file, goal in (('file_worker.js', output), ('style.css', output), ('main.html', os.path.join(output, os.pardir, 'theme'))):
        os.makedirs(goal, exist_ok=True)
        shutil.copy(os.path.join(root, 'tools', 'reference', file), goal)
    if missing and '--incomplete' not in sys.argv:
        sys.exit(f'kte: {len(missing)} public names have no doc comment')


output = os.path.abspath(sys.argv[1])
try:
    main()
except Unreadable as error:
    sys.exit(f'kte: include/{error}')
