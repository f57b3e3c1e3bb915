"""Finds phrases in the documentation and --help that a native speaker would not write, and suggests replacements.

plain_words.faults_of(project) yields (path, line, what is wrong and what was expected). A row is a pattern and its
replacement; a phrase may continue in the next line. Code blocks and `code` are not checked.
"""
import os
import re

WIDTH = 120  # of lines of prose
PAGES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md", "changes", "docs", ".github",
         "scenarios/README.md", "benchmarks/README.md", "python/README.md", "emulator/hunt/README.md",
         "emulator/play/README.md", "third_party/README.md", "packaging/vscode/README.md", "packaging/understudy.1.in")
HELP = "emulator/command_line"

# These pages are made from the models' rows (`describe MODEL choices --format markdown`).
GENERATED = ("docs/fidelity/",)

BEGIN = r"(?:^|(?<=[.!?:;] ))"  # of a sentence
PLAIN = [(re.compile(pattern, re.MULTILINE), instead) for pattern, instead in (
    # German word order, and relative clauses as subjects
    (BEGIN + r"What (?![^.?]*\?)(?:is|was|are|were|has|had|comes|goes|does|it|they|you|nobody|somebody|hosts?) ",
     'a subject: "Dropped frames are reported" for "What was dropped is reported"'),
    (BEGIN + r"Where (?:a|an|the|there|it|they|no|that|nothing|none|several|both) ",
     '"If" or "When": "If a port is busy, ..." for "Where a port is busy, ..."'),
    (BEGIN + r"(?:Whoever|Whatever|Whichever|Whom) ", 'a subject: "Anyone who", "A host that", "Any"'),
    (BEGIN + r"(?:Of|To|In|By|From) which ", 'two sentences: "It has three parts" for "Of which it has three"'),
    (r"\bso that (?:it|they|one|you|an? \w+|the \w+) may\b", '"so it can", "so you can"'),
    (r"(?<!all )(?<!most )(?<!some )(?<!both )(?<!each )\bof which\b", '"whose", or two sentences'),
    (r"\bof what (?:is|was|are|were|it|they|has|had|comes|goes)\b", "the thing's name"),
    (r"\bwhat is there\b", "the thing's name: \"the installed version\""),
    (r"\b(?:whoever|whomever|whosoever)\b", '"anyone who", "a host that"'),
    (r"\b(?:to|for|by|from|with|of) whom\b", '"who ... to", or the name of who it is'),
    (r"\bthat there (?:is|are|was|were)\b", '"that exists", "that are left"'),
    (r"(?i:\b(?:two|three|four|several) there (?:is|are)\b)", '"There are two"'),
    (r"(?<!here )(?<!here, )\b(?:is|are|was|were) no (?!longer|more\b|other|less|better|such|worse|later|earlier|fewer)\w+",
     '"X is not a Y" for "X is no Y"'),
    (r"\b(?:to|cannot|can|could not|could|may) be had\b", '"is available", "can be opened"'),
    (r"\b(?:is|are) to be (?:seen|had|found)\b", '"you can see", "is shown"'),
    (r"\ball that (?:is|are|can|has|have|was|were|it|they|you|each|a|the|goes|comes|moves)\b", '"everything"'),
    (r"\bnothing of (?:it|them|that|this)\b", '"none of it"'),
    # words that are not the field's terms
    (r"\bin free time\b|\bfree time\b", '"virtual time", "as fast as the machine allows"'),
    (r"\bas in life\b|\bin life\b", '"as on the real device"'),
    (r"\bclock on the wall\b", '"wall clock"'),
    (r"\bgo(?:es)? by the (?:wall )?clock\b", '"depends on the wall clock"'),
    (r"\b[Ss]t(?:and|ands|anding|ood) in for\b|\bstand-in\b", '"emulates", "the emulator"'),
    (r"\bwould not forgive\b|\bmanners\b", '"protocol violations"'),
    (r"\bby (?:itself|themselves) (?:alone|only)\b|\beverywhere by itself\b", '"alone", "automatically"'),
    (r"\b(?:is|are|was|were) let go\b", '"is disconnected", "is released"'),
    (r"\bwithout a word\b", '"silently"'),
    (r"\bto and fro\b", '"back and forth"'),
    (r"\bthis often\b|\bthat often\b", '"at that interval"'),
    (r"\bfor so long\b", '"this long"'),
    (r"\bso (?:many|much) at most\b", '"at most N"'),
    (r"\bso manieth\b", '"one in this many"'),
    (r"\bone of both\b", '"one of the two"'),
    (r"\bis there twice\b|\bare there twice\b", '"appears twice"'),
    (r"\bless than (?:nothing|never)\b", '"negative"'),
    (r"\bof one's own\b|\bone's own\b|\bone's\b", '"your own", "your"'),
    (r"\b(?:as|where|what|which|how|when|if) one (?:can|may|likes|wants|needs|has|must)\b", '"you can", "you want"'),
    (r"\bcan be yours\b", '"you control"'),
    (r"\b(?:is|are|was|were) told(?: of\b|(?: (?:once|at|as|in|by|with|here|there|apart)\b)|(?=[.,;:]))",
     '"is reported", "is logged", "learns"'),
    (r"\btells? of\b", '"reports", "describes"'),
    (r"\btakes? the place of\b", '"replaces"'),
    (r"\bstands? (?:beside|behind|in front of|there|below|above|before)\b", '"is next to", "follows", "is"'),
    (r"\b(?:wherein|whereof|whereby|thereof|therein|whence|thence|hence|thus|upon|albeit)\b", '"so", "in it", "on"'),
    (r"\bshall\b", '"must" or "will"'),
    (r"\banew\b", '"again", "from the start"'),
    (r"\b(?:clock|time) (?:stands|stood)\b(?! still| at)", '"the clock is stopped"'),
    (r"(?<![*\w])mend(?:s|ed|ing)?\b(?![*])", '"fix", "clear"'),
    (r"\bremade\b|\bmade anew\b", '"regenerated"'),
)]
NOT_PROSE = re.compile(r"\s*(?:\||<|\[[^\]]+\]: |!\[|\.[A-Z\\]|- name:|\S+$)")  # tables, HTML, links, roff, one long word


def without_code(text):
    """Returns the text with `code` and the targets of links replaced by blanks of the same length."""
    text = re.sub(r"`[^`]*`", lambda found: "`" + " " * (len(found.group()) - 2) + "`", text)
    return re.sub(r"\]\([^)]*\)", lambda found: "]" + " " * (len(found.group()) - 1), text)


def paragraphs_of(lines):
    """Yields (number of the first line, lines) of each paragraph, item, row and heading, without code blocks."""
    found, is_code = [], False
    begins = re.compile(r"\s*(?:[-*+] |\d+\. |\||#|\.[A-Z])")
    for number, line in enumerate(lines, 1):
        if line.lstrip().startswith(("```", ".nf", ".fi")):
            is_code = not is_code
        elif not is_code and line.strip():
            goes_on = found and not begins.match(line) and found[-1][0] + len(found[-1][1]) == number
            goes_on = goes_on and not found[-1][1][0].startswith("#")
            found[-1][1].append(line) if goes_on else found.append((number, [line]))
    return found


def faults_of_paragraph(first, lines):
    if lines[0].startswith("#"):
        return  # "What is not modelled" is a heading as good as any
    text, numbers = "", []
    for number, line in enumerate(lines, first):
        part = re.sub(r"^\s*(?:[-*+] |\d+\. |\|)?\s*", "", line) + " "
        text += part
        numbers += [number] * len(part)
    text = without_code(text)
    for pattern, instead in PLAIN:
        for found in pattern.finditer(text):
            yield numbers[found.start()], f'"{found.group().strip()}" is not plain English; expected {instead}'


def faults_of_page(text):
    lines = text.split("\n")
    for first, paragraph in paragraphs_of(lines):
        yield from faults_of_paragraph(first, paragraph)
        for number, line in enumerate(paragraph, first):
            if len(line) > WIDTH and not NOT_PROSE.match(line):
                yield number, f"is {len(line)} characters wide; expected at most {WIDTH}"


def faults_of_strings(text):
    """Yields the faults of the string literals of a source: the texts of --help and messages."""
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith(("#include", "//")):
            continue
        for literal in re.findall(r'"((?:[^"\\]|\\.)*)"', line):
            for _, what in faults_of_paragraph(number, [" " + literal]):
                yield number, what


def pages_of(project):
    for page in PAGES:
        path = os.path.join(project, page)
        if os.path.isfile(path):
            yield page
        for folder, folders, names in os.walk(path):
            folders.sort()
            yield from (os.path.relpath(os.path.join(folder, name), project) for name in sorted(names)
                        if name.endswith((".md", ".yml")))


def read(project, path):
    with open(os.path.join(project, path), encoding="utf-8") as file:
        return file.read()


def faults_of(project):
    for page in pages_of(project):
        if not page.startswith(GENERATED):
            yield from ((page, line, what) for line, what in faults_of_page(read(project, page)))
    folder = os.path.join(project, HELP)
    for name in sorted(os.listdir(folder)) if os.path.isdir(folder) else []:
        path = f"{HELP}/{name}"
        if name.endswith((".h", ".cpp")):
            yield from ((path, line, what) for line, what in faults_of_strings(read(project, path)))
