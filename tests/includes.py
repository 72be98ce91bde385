"""Files that use a name of the system's without an include of its header, their own or that of a header of ours: as the
build reads these headers once for all files, no compiler finds it. usage: tests/includes.py
SPDX-License-Identifier: BSD-3-Clause"""
import glob
import os
import re

called = r'(?<![\w.>])(?:%s)\s*\('
named = r'(?<![\w.])(?:%s)\b'
# what tells, by header; those that are in `$(B)/system.h` of the Makefile
NAMES = {
    'errno': [named % 'errno'],
    'float': [named % '(?:DBL|FLT)_[A-Z]+'],
    'limits': [named % '(?:CHAR|U?INT|U?LONG|U?LLONG)_(?:MAX|MIN)|PATH_MAX'],
    'math': [called % 'a?(?:sin|cos|tan)h?|atan2|sqrt|cbrt|hypot|pow|exp|log|log10|log2|fabs|fmin|fmax|fmod|floor|ceil|l?round|isnan|isfinite|copysign|erf',
             named % 'M_PI|INFINITY|NAN|HUGE_VAL'],
    'mpi': [named % r'MPI_[A-Z]\w+'],
    'stdarg': [named % 'va_list|va_start'],
    'stdbool': [named % 'bool|true|false'],
    'stdint': [named % r'u?int(?:8|16|32|64)_t|U?INT\d+_MAX|u?intptr_t|SIZE_MAX'],
    'stdio': [called % r'v?[fs]?n?printf|fopen|fclose|fgets|fputs|fputc|putchar|puts|fread|fwrite|fflush|remove|rename|f?scanf|sscanf|getline',
              named % 'FILE|stderr|stdout|EOF'],
    'stdlib': [called % '[mc]alloc|realloc|free|qsort|bsearch|exit|abort|getenv|setenv|strto[a-z]+|ato[if]|abs|mkdtemp'],
    'string': [called % 'mem(?:cpy|set|cmp|move|chr)|str(?:len|n?cmp|r?chr|str|n?dup|spn|cspn|n?cpy|n?cat|tok|tok_r|error)'],
}
USES = {header + '.h': re.compile('|'.join(p)) for header, p in NAMES.items()}
ASIDE = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"', re.S)
INCLUDE = re.compile(r'^#include (?:"(.*)"|<(.*)>).*$', re.M)
text, includes, known = {}, {}, {}
for path in sum((glob.glob(f'{top}/**/*.[ch]', recursive=True) for top in ('sph', 'fv', 'coupler', 'common', 'tests')), []):
    with open(path) as f:
        whole = f.read()
    includes[path] = [os.path.normpath(f'{os.path.dirname(path)}/{own}') if own else other.replace('cpl.h', 'coupler/cpl.h')
                      for own, other in INCLUDE.findall(whole)]
    text[path] = ASIDE.sub(' ', INCLUDE.sub('', whole))


def reads(path, header):
    """does PATH, or what it includes, include HEADER"""
    if (path, header) not in known:
        known[path, header] = False  # a circle ends here
        known[path, header] = any(i == header or reads(i, header) for i in includes.get(path, ()))
    return known[path, header]


for path in sorted(text):
    for header, names in USES.items():
        found = not reads(path, header) and names.search(text[path])
        if found:
            print(f'{path} has "{found[0]}" and no <{header}>')
