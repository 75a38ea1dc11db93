#!/usr/bin/env python3
"""Fails if a page of a directory of HTML has a link to a file or an anchor that is not there: check_links.py DIRECTORY"""
import os
import sys
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.ids, self.links = set(), []
        with open(path, encoding='utf-8') as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == 'id' or (name == 'name' and tag == 'a'):
                self.ids.add(value)
            elif name in ('href', 'src') and value:
                self.links.append(value)


top = sys.argv[1]
pages, dead = {}, 0
for directory, _, files in os.walk(top):
    for file in files:
        if file.endswith('.html') and file != '404.html':
            path = os.path.normpath(os.path.join(directory, file))
            pages[path] = Page(path)
for path, page in pages.items():
    for link in dict.fromkeys(page.links):
        address = urlsplit(link)
        if address.scheme or address.netloc:
            continue
        goal = os.path.normpath(os.path.join(os.path.dirname(path), unquote(address.path))) if address.path else path
        if os.path.isdir(goal):
            goal = os.path.join(goal, 'index.html')
        if not os.path.exists(goal) or (goal in pages and address.fragment and unquote(address.fragment) not in pages[goal].ids):
            print(f'kte: {path}: dead link to {link}', file=sys.stderr)
            dead += 1
if dead:
    sys.exit(f'kte: {dead} dead links')
