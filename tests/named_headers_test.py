#!/usr/bin/env python3
"""Whether each source includes what declares the names that it uses: named_headers_test.py [FOLDER...]

The preset dev compiles sources of folders that lie beside each other as one, where the include of one serves all; in
the preset release each stands alone. So, of each name that a header of these sources declares, a type, a function, a
constant: a source that uses it must reach one of these headers. It reads text, not C++, and takes what a source or its
headers declare anywhere, members and parameters too, for what is meant: it would rather miss an include than ask for
one too many. Folders are src and tests unless they are named.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
FOLDERS = [pathlib.Path(folder) for folder in sys.argv[1:]] or [ROOT / 'src', ROOT / 'tests']
# At the beginning of a line, as everything of a namespace is.
TYPE = re.compile(r'^(?:class|struct|enum class|enum|union) +(?:\[\[\w+\]\] +)?(\w+)\b(?! *;)|^using (\w+) =', re.M)
FUNCTION = re.compile(r'^(?:\[\[nodiscard\]\] )?[A-Za-z_][\w:<>,&* ]*?[ &*>](\w+)\(', re.M)
CONSTANT = re.compile(r'^(?:inline )?constexpr [\w:<>, ]+ (\w+_\w+)\b', re.M)
NAMESPACE = re.compile(r'^namespace (?!vorpipe)(\w+) \{', re.M)


class Source:
    def __init__(self, text):
        text = re.sub(r'//[^\n]*|^TEST\w*\(\w+, \w+\)', '', text, flags=re.M)
        self.includes = re.findall(r'^ *# *include *"([^"]+)"', text, re.M)
        self.text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
        self.words = set(re.findall(r'\w+', self.text))
        self.declares = {name for match in TYPE.findall(self.text) for name in match if name}
        for other in (FUNCTION, CONSTANT, NAMESPACE):
            self.declares |= set(other.findall(self.text))
        self.spaces = {space for named in re.findall(r'^namespace (vorpipe[\w:]*)', self.text, re.M)
                       for space in named.split('::')}

    def uses(self, name, spaces):
        """As a type, a constant, a namespace, or called: not a member, and not of a namespace of others."""
        for before, space, after in re.findall(r'(\.|->|(?:\b(\w+))?::|)\b' + name + r'\b(\(|::)?', self.text):
            if before in ('.', '->') or (before and space not in spaces):
                continue
            if name[0].isupper() or '_' in name or after:
                return True
        return False

    def declares_anywhere(self, name):
        if name[0].isupper():
            return re.search(r'\b(?:class|struct|enum class|using|typename) +' + name + r'\b', self.text)
        return (re.search(r'^using [\w:]+::' + name + ';', self.text, re.M)
                or re.search(r'\b(?!(?:return|else|case)\b)\w+[>\]]*[&*]* ' + name + r'(?:\(| =)', self.text)
                or ('_' not in name and re.search(r'[(,] *' + name + r' *[,)]', self.text)))


def read():
    return {file.relative_to(folder).as_posix(): Source(file.read_text(encoding='utf-8'))
            for folder in FOLDERS for kind in ('*.h', '*.cpp') for file in sorted(folder.rglob(kind))}


def reached(sources, path):
    """The files that one includes, itself among them, and those that these include."""
    found, left = {path}, [path]
    while left:
        includer = left.pop()
        for name in sources[includer].includes:
            beside = f'{includer.rpartition("/")[0]}/{name}'
            header = beside if beside in sources else name
            if header in sources and header not in found:
                found.add(header)
                left.append(header)
    return found


def folder(path):
    """The folder of what may be compiled as one."""
    return path.rpartition('/')[0]


def missing(sources):
    """Each a source, a name, and the headers that declare it."""
    declared_in = {}
    for path, source in sources.items():
        if path.endswith('.h'):
            for name in source.declares:
                declared_in.setdefault(name, set()).add(path)
    spaces = set().union(*(source.spaces for source in sources.values()))
    reach = {path: reached(sources, path) for path in sources if path.endswith('.cpp')}
    near_of = {}
    for path, headers in reach.items():
        near_of.setdefault(folder(path), set()).update(headers)
    for path in reach:
        source = sources[path]
        near = near_of[folder(path)]
        for name in sorted(source.words & declared_in.keys()):
            headers = declared_in[name] & near
            if headers and not headers & reach[path] and source.uses(name, spaces) and not any(
                    sources[own].declares_anywhere(name) for own in reach[path]):
                yield path, name, sorted(headers)


def main():
    sources = read()
    if not sources:
        sys.exit('named_headers_test: no sources')
    found = list(missing(sources))
    for path, name, headers in found:
        print(f'{path} uses {name}, and includes no header that declares it: {", ".join(headers)}')
    print(f'{len(sources)} files, {len(found)} names without their headers')
    sys.exit(1 if found else 0)


main()
