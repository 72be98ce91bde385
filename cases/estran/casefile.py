"""Case files: the part of libconfig that they use, as dicts (groups), lists and plain values.
SPDX-License-Identifier: BSD-3-Clause"""
import os
import re

_word = re.compile(r'''\s+|\#[^\n]*|//[^\n]*|/\*.*?\*/
    |(?P<include>@include\s+"[^"]*")
    |(?P<text>"(?:[^"\\]|\\.)*")
    |(?P<name>[A-Za-z_*][-\w*.]*)
    |(?P<number>[-+]?(?:0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?))L*
    |(?P<mark>[][(){}=:;,])''', re.S | re.X)


def _words(text, folder):
    at = 0
    while at < len(text):
        m = _word.match(text, at)
        if not m:
            raise ValueError('case file: cannot read %r' % text[at:at + 30])
        at = m.end()
        if m.lastgroup == 'include':
            name = os.path.join(folder, m.group().split('"')[1])
            with open(name) as f:
                yield from _words(f.read(), os.path.dirname(name))
        elif m.lastgroup:
            yield m.lastgroup, m.group(m.lastgroup)


def _number(word):
    try:
        return int(word, 0)
    except ValueError:
        return float(word)


class _Reader:
    def __init__(self, words):
        self.words = list(words) + [('end', '')]
        self.at = 0

    def take(self):
        self.at += 1
        return self.words[self.at - 1]

    def see(self, *marks):
        kind, word = self.words[self.at]
        if kind == 'mark' and word in marks:
            self.at += 1
            return True
        return False

    def settings(self, end):
        found = {}
        while not self.see(end) and self.words[self.at][0] != 'end':
            kind, name = self.take()
            if kind != 'name':
                raise ValueError('case file: expected a key, found %r' % name)
            if not self.see('=', ':'):
                raise ValueError('case file: no = after %s' % name)
            found[name] = self.value()
            self.see(';', ',')
        return found

    def value(self):
        kind, word = self.take()
        if kind == 'mark' and word == '{':
            return self.settings('}')
        if kind == 'mark' and word in '([':
            end, found = ')' if word == '(' else ']', []
            while not self.see(end):
                found.append(self.value())
                self.see(',')
            return found
        if kind == 'text':
            text = re.sub(r'\\(.)', r'\1', word[1:-1])
            while self.words[self.at][0] == 'text':  # pieces of one text
                text += re.sub(r'\\(.)', r'\1', self.take()[1][1:-1])
            return text
        if kind == 'number':
            return _number(word)
        if kind == 'name' and word.lower() in ('true', 'false'):
            return word.lower() == 'true'
        raise ValueError('case file: %r is no value' % word)


def parse(text, folder='.'):
    """The case as a dict; @include is looked for in the folder."""
    return _Reader(_words(text, folder)).settings('\0')


def load(path):
    with open(path) as f:
        return parse(f.read(), os.path.dirname(path) or '.')
