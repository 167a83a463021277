#!/usr/bin/env python3
"""Whether what the documents name is there: names_test.py

Links lead to files and headings. Numbers of decisions are unique and ascend in each topic, with gaps, and the
table lists all; comments in the code name numbers that exist. What stands in backticks in NAMING pages, files and
names of the code, is in the tree; architecture.md has all modules, in the order of the build; hacking.md names
functions with their files. CITATION.cff has the version that is built.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = sorted(ROOT.glob('*.md')) + sorted(ROOT.glob('docs/*.md')) + [ROOT / 'third_party/README.md',
                                                                     ROOT / 'tests/data/README.md']
NAMING = ['docs/hacking.md', 'docs/architecture.md', 'docs/shaders.md', 'docs/backends.md', 'CONTRIBUTING.md']
# What stands in backticks and is of other programs, only an example, or made by the build. `NAME` stands for any name.
FOREIGN = set('''
mix VK_EXT_memory_budget /dev/dri
LikeThis likeThis like_this Manager Helper Utils
module_410 shaders.h
'''.split())


def sources():
    for folder in ('src', 'python', 'shaders', 'tests', 'docs/examples', 'third_party'):
        for file in (ROOT / folder).rglob('*'):
            if file.is_file() and file.suffix not in ('.spv', '.npy', '.png', '.md') and 'docs' not in file.parts[-2:-1]:
                yield file
    yield from (ROOT / name for name in ('run', 'test', 'CMakeLists.txt', 'CMakePresets.json'))


def without_blocks(text):
    """The lines of a page, with what stands in fenced and indented blocks blanked out."""
    fenced = False
    for line in text.splitlines():
        if line.lstrip().startswith('```'):
            fenced = not fenced
            yield ''
        else:
            yield '' if fenced or line.startswith('    ') else line


def anchors(text):
    found = set(re.findall(r'<a id="([^"]+)">', text))
    for line in without_blocks(text):
        heading = re.match(r'#+ (.*)', line)
        if heading:
            plain = re.sub(r'[^\w\- ]', '', heading[1].lower())
            found.add(plain.strip().replace(' ', '-'))
    return found


def check_links(fault):
    for page in PAGES:
        for number, line in enumerate(without_blocks(page.read_text()), 1):
            for target in re.findall(r'\]\(([^)\s]+)\)', line):
                if re.match(r'[a-z]+:', target):
                    continue
                path, _, anchor = target.partition('#')
                file = (page.parent / path).resolve() if path else page
                if not file.exists():
                    fault(page, number, f'the link to {target} leads nowhere')
                elif anchor and anchor not in anchors(file.read_text()):
                    fault(page, number, f'{path or page.name} has no heading #{anchor}')


def check_decisions(fault, files):
    page = ROOT / 'docs/decisions.md'
    text = page.read_text()
    heading = r'^### <a id="d(\d+)"></a>D(\d+)\. (.*)$'
    for topic in text.split('\n## ')[1:]:
        found = [int(number) for _, number, _ in re.findall(heading, topic, flags=re.M)]
        if found != sorted(found):
            fault(page, 1, f'the numbers of decisions do not ascend in "{topic.splitlines()[0]}"')
    decisions = re.findall(heading, text, flags=re.M)
    numbers = [number for _, number, _ in decisions]
    listed = re.findall(r'^- \[D(\d+)\]\(#d(\d+)\) (.*)$', text, flags=re.M)
    if len(set(numbers)) != len(numbers) or len(numbers) != len(re.findall('^### ', text, flags=re.M)):
        fault(page, 1, 'a number is used twice, or a heading has no number or anchor')
    if decisions != listed:
        fault(page, 1, 'the table does not list the decisions in their order, by number, anchor and title')
    for anchor, number, _ in decisions:
        if anchor != number:
            fault(page, 1, f'the anchor of D{number} is d{anchor}')
    for file in files:
        if file.suffix in ('.h', '.cpp', '.glsl', '.comp', '.geom', '.vert', '.frag'):
            for number, line in enumerate(file.read_text().splitlines(), 1):
                for named in re.findall(r'//.*\bdecision D(\d+)\b', line):
                    if named not in numbers:
                        fault(file, number, f'there is no decision D{named}')


def file_exists(name, stems):
    name = name.rstrip('/')
    if '*' in name or '...' in name:
        return any(ROOT.glob(name)) or any(ROOT.glob('src/' + name))
    for base in ('', 'src', 'src/core', 'tests', 'shaders', 'build'):
        path = ROOT / base / name
        if path.exists() or (path.parent.is_dir() and any(path.parent.glob(path.name + '.*'))):
            return True
    return '/' not in name and name in stems


def check_names(fault, files):
    words, stems = set(), set()
    for file in files:
        words.update(re.findall(r'[\w-]+', file.read_text(errors='replace')))
        words.update(re.findall(r'\w+', file.read_text(errors='replace')))
        stems.update((file.stem, file.name))
        words.update(file.relative_to(ROOT).parts[:-1])
    for name in NAMING:
        page = ROOT / name
        if not page.exists():
            continue
        for number, line in enumerate(without_blocks(page.read_text()), 1):
            for quoted in re.findall(r'(?<!`)`([^`]+)`(?!`)', line):
                missing = None
                if 'NAME' in quoted or quoted.rstrip("()") in FOREIGN:
                    continue
                if re.fullmatch(r'[\w.*-]*/[\w./*-]*', quoted) or re.fullmatch(r'[\w-]+\.(h|cpp|glsl|cmake|sh|py|md)', quoted):
                    missing = None if file_exists(quoted, stems) else quoted
                elif re.fullmatch(r'[\w:<>~]+(\(.*\))?', quoted) or re.fullmatch(r'[\w.]+\(.*\)', quoted):
                    missing = next((word for word in re.findall(r'[A-Za-z_]\w*', quoted.split('(')[0])
                                    if word not in words and word not in stems), None)
                if missing:
                    fault(page, number, f'`{missing}` is not in the tree')


def check_modules(fault):
    """architecture.md has a row for each module, and none else, in the order in which they are listed for the build;
    files to begin with are there; each folder of src that is no module is named."""
    page = ROOT / 'docs/architecture.md'
    text = page.read_text()
    built = re.findall(r'^vorpipe_module\(([\w/]+)', (ROOT / 'src/CMakeLists.txt').read_text(), flags=re.M)
    table = re.search(r'\n\| module \|.*\n\|[-|]+\n((?:\|.*\n)+)', text)
    rows = re.findall(r'^\| `([\w/]+)` \|.*\| (.*) \|$', table[1], flags=re.M) if table else []
    if [module for module, _ in rows] != built:
        fault(page, 1, f'the table of modules is not that of src/CMakeLists.txt: {" ".join(built)}')
    for module, files in rows:
        for file in re.findall(r'`(\w+)`', files):
            if not any((ROOT / 'src' / module).glob(file + '.*')):
                fault(page, 1, f'src/{module} has no {file}')
    for folder in sorted((ROOT / 'src').iterdir()):
        is_of_modules = any(module.split('/')[0] == folder.name for module in built)
        if folder.is_dir() and not is_of_modules and f'`src/{folder.name}`' not in text:
            fault(page, 1, f'src/{folder.name} is not named')


def check_places(fault):
    """In hacking.md: a file in a step of a tour is in the module of the step, a function beside a file is in that file, and
    the functions of a step of the journey are in its files."""
    page = ROOT / 'docs/hacking.md'
    lines = list(without_blocks(page.read_text()))
    module = None
    for number, line in enumerate(lines, 1):
        step = re.match(r'\d+\. +\*\*`([\w/]+)`\*\*', line)
        module = ROOT / step[1] if step else module if line.startswith('  ') else None
        if module is not None:
            text = line
            if number < len(lines) and lines[number].startswith('  '):
                text += ' ' + lines[number].strip()
            for file in re.findall(r'`([\w-]+\.(?:h|cpp|glsl|comp|geom|cmake|txt))`', line):
                # The shared files are included from elsewhere.
                if not any((folder / file).is_file() for folder in (module, ROOT / 'shaders/glsl')) and file not in FOREIGN:
                    fault(page, number, f'{file} is not in {module.relative_to(ROOT)}')
            for named, file in re.findall(r'`([\w:]+)` (?:\(|in )`([\w.]+)`', text):
                if (module / file).is_file() and named.split('::')[-1] not in (module / file).read_text():
                    fault(page, number, f'{file} does not have {named}')
        cells = [cell.strip() for cell in re.split(r'(?<!\\)\|', line)[1:-1]]
        if len(cells) == 4 and cells[0].isdigit():
            places = [ROOT / file for file in re.findall(r'`([^`]+)`', cells[3])]
            for file in places:
                if not file.is_file():
                    fault(page, number, f'{file.relative_to(ROOT)} is not in the tree')
            texts = [file.read_text() for file in places if file.is_file()]
            for named in re.findall(r'`([^`]+)`', cells[2]):
                if not any(re.search(rf'\b{named}\b', text) for text in texts):
                    fault(page, number, f'{named} is in none of {cells[3]}')


def check_citation(fault):
    """CITATION.cff has the version of CMakeLists.txt, and the fields that the format, 1.2.0, asks for."""
    file = ROOT / 'CITATION.cff'
    text = file.read_text()
    version = re.search(r'project\(vorpipe VERSION (\S+)', (ROOT / 'CMakeLists.txt').read_text())[1]
    wanted = {'cff-version': r'1\.2\.0', 'message': '.+', 'title': '.+', 'type': 'software', 'authors': '',
              'version': re.escape(version), 'license': 'MIT'}
    fields = re.findall(r'^([a-z-]+): ?(.*)$', text, re.M)
    for name, value in wanted.items():
        if [name for key, found in fields if key == name and re.fullmatch(value, found)] != [name]:
            fault(file, 1, f'"{name}" does not stand there once, as {value or "a list"}')
    if '\t' in text or any(': ' in value for _, value in fields):
        fault(file, 1, 'a tab, or a colon in a value without quotes: that is no YAML')


def main():
    faults = []

    def fault(file, line, text):
        faults.append(f'{file.relative_to(ROOT)}:{line}: {text}')

    files = list(sources())
    check_links(fault)
    check_decisions(fault, files)
    check_names(fault, files)
    check_modules(fault)
    check_places(fault)
    check_citation(fault)
    for text in faults:
        print(f'FAILED: {text}', file=sys.stderr)
    print(f'{len(PAGES)} pages, {len(faults)} failures')
    sys.exit(1 if faults else 0)


if __name__ == '__main__':
    main()
