"""Reads the outline of C++ sources for scripts that count: classes with the functions that they declare, functions with
their lines, and the text without comments, strings and directives.

Outline(text) reads one file. It relies on the checks of clang-format and the compiler (brackets match), and knows
nothing about types.
"""
import bisect
import re

BLANKED = re.compile(r"""
    (?P<comment> //[^\n]* | /\*.*?\*/ )
  | (?P<raw> (?:u8|u|U|L)?R"(?P<mark>[^\s()\\]*)\( .*? \)(?P=mark)" )
  | (?P<string> "(?:[^"\\\n]|\\.)*" )
  | (?P<letter> (?<![0-9a-fA-F])'(?:[^'\\\n]|\\.)+' )
  | (?P<directive> ^[ \t]*\#(?:[^\n\\]|\\\n|\\.)* )
""", re.VERBOSE | re.DOTALL | re.MULTILINE)
TOKEN = re.compile(r"[A-Za-z_]\w*|::|->|[^\s\w]|\d[\w.']*")
NO_NAMES = {"alignas", "decltype", "noexcept", "requires", "explicit", "static_assert", "__attribute__"}
ACCESS = ("public", "protected", "private")
NO_FUNCTIONS = {"using", "typedef", "friend", "static_assert"}
BRACKETS = {")": "(", "}": "{", "]": "["}


def without_text(source):
    """Returns the text with brackets at the same places; each string becomes one quotation mark."""
    def blank(found):
        kept = '"' if found["string"] or found["raw"] or found["letter"] else " "
        return kept + "\n" * found[0].count("\n")
    return BLANKED.sub(blank, source)


class Function:
    """A function with a body. `owner` is its class, or "" for a free function."""

    def __init__(self, owner, name, line, last_line, body, is_table):
        self.owner, self.name, self.line, self.last_line = owner, name, line, last_line
        self.body, self.is_table = body, is_table

    @property
    def lines(self):
        return self.last_line - self.line + 1

    @property
    def full_name(self):
        return f"{self.owner}::{self.name}" if self.owner else self.name


class Outline:
    def __init__(self, source):
        self.text = without_text(source)
        found = list(TOKEN.finditer(self.text))
        self.tokens = [one[0] for one in found]
        self.starts = [one.start() for one in found]
        self.newlines = [place for place, letter in enumerate(self.text) if letter == "\n"]
        self.functions = []
        self.declared = {}  # class -> names of the functions that it declares, one entry per overload
        self.bases = {}     # class -> classes whose members it inherits
        self.lines_of_class = {}
        self.partner = self.matched()
        self.read_scope(0, len(self.tokens), "")

    def matched(self):
        partner, open_ones = {}, []
        for place, token in enumerate(self.tokens):
            if token in "([{":
                open_ones.append(place)
            elif token in BRACKETS and open_ones and self.tokens[open_ones[-1]] == BRACKETS[token]:
                partner[open_ones.pop()] = place
        return partner

    def line_of(self, place):
        return bisect.bisect_left(self.newlines, self.starts[place]) + 1

    def behind(self, place):
        """Returns the place behind a bracket and its contents."""
        return self.partner.get(place, len(self.tokens)) + 1

    def behind_angle(self, place, end):
        depth = 0
        while place < end:
            token = self.tokens[place]
            if token in ("(", "[", "{"):
                place = self.partner.get(place, place)
            elif token == ";":
                return place
            depth += (token == "<") - (token == ">")
            place += 1
            if depth == 0:
                return place
        return end

    def read_scope(self, place, end, owner):
        while place < end:
            place = self.read_statement(place, end, owner)

    def read_statement(self, place, end, owner):
        """Reads a declaration in a namespace or class, and returns the place behind it."""
        begin, name_at, is_value, has_initializers = place, None, False, False
        while place < end:
            token = self.tokens[place]
            if token == ";":
                self.declare(begin, name_at, place, owner)
                return place + 1
            if token == "operator" and name_at is None:
                name_at, place = place, place + 1
                if self.tokens[place:place + 2] == ["(", ")"]:
                    place += 2
                while place < end and self.tokens[place] not in ("(", ";"):
                    place += 1
            elif token == "(":
                before = self.tokens[place - 1] if place > begin else ""
                if name_at is None and not is_value and before.isidentifier() and before not in NO_NAMES:
                    name_at = place - 1
                place = self.behind(place)
            elif token == "<" and not is_value:
                place = self.behind_angle(place, end)
            elif token == "[":
                place = self.behind(place)
            elif token == "=":
                is_value, place = True, place + 1
            elif token == ":" and place == begin + 1 and self.tokens[begin] in ACCESS:
                return place + 1
            elif token == ":":
                has_initializers, place = name_at is not None, place + 1
            elif token == "{":
                before = self.tokens[place - 1] if place > begin else ""
                is_initializer = is_value or has_initializers and (before.isidentifier() or before == ">")
                if name_at is not None and not is_initializer:
                    self.define(begin, name_at, place, owner)
                    return self.behind(place)
                if name_at is None and not is_value and self.opens_scope(begin, place, owner):
                    if self.tokens[begin] in ("namespace", "inline", "extern"):
                        return self.behind(place)
                place = self.behind(place)
            else:
                place += 1
        return end

    def opens_scope(self, begin, brace, owner):
        """Reads the namespace or class that this brace opens."""
        head = self.tokens[begin:brace]
        inside = brace + 1, self.behind(brace) - 1
        if "namespace" in head or head[:1] == ["extern"]:
            self.read_scope(*inside, owner)
            return True
        kinds = [place for place in range(begin, brace) if self.tokens[place] in ("class", "struct", "union")]
        if not kinds or "enum" in head:
            return False
        place = begin
        while self.tokens[place] == "template":
            place = self.behind_angle(place + 1, brace)
        place = next(kind for kind in kinds if kind >= place) + 1
        colon = next((at for at in range(place, brace) if self.tokens[at] == ":"), brace)
        if self.tokens[place] == "alignas":
            place = self.behind(place + 1)
        names = [token for token in self.tokens[place:colon] if token.isidentifier() and token != "final"]
        name = names[0] if names else owner
        if "::" in self.tokens[place:colon]:
            name = names[-1]
        bases = [token for token in self.tokens[colon:brace] if token.isidentifier() and token not in ACCESS]
        self.bases.setdefault(name, []).extend(bases)
        self.declared.setdefault(name, [])
        self.lines_of_class.setdefault(name, self.line_of(begin))
        self.read_scope(*inside, name)
        return True

    def name_of(self, name_at):
        if self.tokens[name_at] != "operator":
            return ("~" if name_at and self.tokens[name_at - 1] == "~" else "") + self.tokens[name_at]
        end = name_at + 1
        if self.tokens[end:end + 2] == ["(", ")"]:
            return "operator()"
        while self.tokens[end] not in ("(", ";"):
            end += 1
        return "operator" + "".join(self.tokens[name_at + 1:end])

    def declare(self, begin, name_at, end, owner):
        """Records a function without a body, unless the compiler makes it."""
        if owner and name_at is not None and not NO_FUNCTIONS & set(self.tokens[begin:name_at]):
            if self.tokens[end - 2:end] not in (["=", "default"], ["=", "delete"]):
                self.declared[owner].append(self.name_of(name_at))

    def define(self, begin, name_at, brace, owner):
        name = self.name_of(name_at)
        before = name_at - 1 - (name[0] == "~")
        is_friend = "friend" in self.tokens[begin:name_at]
        if owner and not is_friend:
            self.declared[owner].append(name)
        if before > begin and self.tokens[before] == "::" and not owner:
            owner = self.owner_before(begin, before)
        end = self.behind(brace) - 1
        first, last = self.line_of(brace), self.line_of(end) if end < len(self.tokens) else self.line_of(-1)
        body = self.text[self.starts[brace]:self.starts[end] if end < len(self.starts) else len(self.text)]
        rows = self.rows_of_data(brace, end)
        self.functions.append(Function("" if is_friend else owner, name, self.line_of(begin), last, body,
                                       2 * rows > max(0, last - first - 1)))

    def owner_before(self, begin, colons):
        place = colons - 1
        if self.tokens[place] == ">":
            depth = 0
            while place > begin:
                depth += (self.tokens[place] == ">") - (self.tokens[place] == "<")
                place -= 1
                if depth == 0:
                    break
        return self.tokens[place] if self.tokens[place].isidentifier() else ""

    def rows_of_data(self, brace, end):
        """Returns how many lines of a body begin inside an initializer or a string."""
        kinds, lines = [], set()
        for place in range(brace, min(end, len(self.tokens))):
            token = self.tokens[place]
            if kinds and kinds[-1] and (place == 0 or self.line_of(place) != self.line_of(place - 1)):
                lines.add(self.line_of(place))
            if token == '"':  # the processed lines remain behind it as empty ones
                follows = self.line_of(place + 1) if place + 1 < len(self.tokens) else 0
                first = self.line_of(place)
                blank = self.text[self.starts[place] + 1:self.starts[place] + 1 + max(0, follows - first)]
                lines.update(range(first + 1, first + 1 + len(blank) - len(blank.lstrip("\n"))))
            elif token == "{":
                kinds.append(place != brace and self.is_initializer(place, kinds[-1]))
            elif token == "}" and kinds:
                kinds.pop()
        return len(lines)

    def is_initializer(self, brace, is_outer_one):
        before = self.tokens[brace - 1]
        if before == "{":
            return is_outer_one
        if before == ",":
            return True
        if before in (")", "]", ";", "}", ":", "else", "do", "try", "mutable", "noexcept"):
            return False
        if before.isidentifier() or before == ">":
            head = self.tokens[max(0, brace - 12):brace]
            for place in range(len(head) - 1, -1, -1):
                if head[place] in (";", "{", "}", "(", "=", "return"):
                    break
                if head[place] in ("->", "struct", "class", "enum", "union"):
                    return False
        return True
