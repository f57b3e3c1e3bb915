"""TextMate grammars of the program languages, made from the instruction tables.

An instruction colours its line from itself to the comment, so the operands of an unknown instruction stay plain.
"""
import re

BEGIN = r"(?<![^\s,])"  # of a word between blanks and commas
END = r"(?![^\s,;])"
TO_COMMENT = r"(?=;)|$"


def any_of(words):
    """Returns a pattern for any of the words, the longest first, so that LD>= is not read as LD>."""
    return "(?:" + "|".join(re.escape(word).replace(r"\-", "-") for word in
                            sorted(set(words), key=lambda word: (-len(word), word))) + ")"


def word(pattern):
    return f"(?i){BEGIN}{pattern}{END}"


def match(pattern, scope):
    return {"match": pattern, "name": scope}


def captured(pattern, *scopes):
    return {"match": pattern, "captures": captures(*scopes)}


def captures(*scopes):
    return {str(number): {"name": scope} for number, scope in enumerate(scopes, 1) if scope}


def line_of(pattern, scope, *patterns):
    """Returns a rule that colours `pattern` by `scope` and, up to a comment, what follows by `patterns`."""
    return {"begin": pattern, "beginCaptures": {"0": {"name": scope}}, "end": TO_COMMENT, "patterns": list(patterns)}


def grammar(name, model, patterns, **repository):
    return {
        "information_for_contributors": "packaging/vscode/generate.py writes this file from the program's tables.",
        "name": name,
        "scopeName": f"source.understudy.{model}",
        "patterns": patterns,
        "repository": {key: {"patterns": some} for key, some in repository.items()},
    }


def use(name):
    return {"include": "#" + name}


COMMENT = match(r";.*$", "comment.line.semicolon")
NUMBER = match(r"(?i)(?<![^\s,])[-+]?(?:0x[0-9a-f]+|0b[01]+|[0-9]+)(?![^\s,;])", "constant.numeric")
CONTROL, ACTION = "keyword.control", "support.function"
WRONG_PLACE = "invalid.illegal.wrong-place"


def simple2(tables):
    rows = tables.describe("simple2-r3", "instructions")
    jumps = [row["mnemonic"] for row in rows if row["data1"].startswith("flag ")]
    ends = [row["mnemonic"] for row in rows if row["mnemonic"] == "END"]
    others = [row["mnemonic"] for row in rows if row["mnemonic"] not in jumps + ends]
    # Parameters whose register has no number are written by name in a listing; the others are MEM0, VAR32, DAT64.
    registers = [row["name"] for row in tables.describe("simple2-r3", "parameters")
                 if not re.match(r"(?:PROG|Parms)_", row["name"])]
    registers += [re.sub(r"^Axis_", "Aaxis_", name) for name in registers]
    registers += [re.sub(r"^Aaxis_", "Axis_", name) for name in registers]
    begin = r"(?i)(?<![^\s,:])"
    return grammar(
        "Simple2-R3 listing", "simple2-r3",
        [COMMENT,
         captured(r"(?i)(?<![^\s,:])([a-z_]\w*)(:)", "entity.name.label", "punctuation.separator"),
         match(r"(?<![^\s,:])@[0-9]+", "entity.name.label.flag"),
         line_of(rf"{begin}\.(?:at|line){END}", "keyword.other.directive", NUMBER),
         line_of(f"{begin}{any_of(jumps)}{END}", CONTROL, use("operands"),
                 match(r"(?i)(?<![^\s,])(?:@[0-9]+|[a-z_]\w*)(?![^\s,;])", "entity.name.label")),
         line_of(f"{begin}{any_of(ends)}{END}", CONTROL),
         line_of(f"{begin}{any_of(others)}{END}", ACTION, use("operands"))],
        operands=[
            NUMBER,
            match(word("(?:ON|OFF)"), "constant.language"),
            match(word("(?:DIN|DOUT)_[0-9]+"), "variable.other.terminal"),
            match(word("(?:MEM|VAR|DAT)[0-9]+"), "variable.other.parameter"),
            match(word(any_of(registers)), "variable.other.register")])


SUPER_STEP = captured(r"^\s*([0-9]+)(?=\s|$)", "constant.numeric.step")
SUPER_AREAS = {"ladder": ("P", r"(AREA)[\s,]+(PLC)"),
               "main": ("C", r"(?:(AREA)[\s,]+(C)|(FILE)[\s,]+([0-9]+))"),
               "axes": ("X", r"(AREA)[\s,]+([XYZU])")}


def super_40nc(tables):
    """The ladder and the step programs have different instructions: those of another area are marked."""
    rows = tables.describe("super-40nc", "instructions")
    named = {re.sub("[a-z].*$", "", row["mnemonic"]): "" for row in rows}  # OUTtc is written OUT
    for row in rows:
        named[re.sub("[a-z].*$", "", row["mnemonic"])] += row["areas"]
    labels = {row["mnemonic"] for row in rows if row["operands"].startswith("K0 to K")}
    flow = labels | {"IF", "ELSE", "ENDI", "RET", "END"} & set(named)
    areas, repository = [], {}
    for name, (letter, head) in SUPER_AREAS.items():
        here = {mnemonic for mnemonic, some in named.items() if letter in some}
        begin = r"(?i)(?<![^\s,])"
        repository[name] = [
            COMMENT, SUPER_STEP,
            line_of(f"{begin}{any_of(here & flow)}{END}", CONTROL, use("operands")),
            line_of(f"{begin}{any_of(here - flow)}{END}", ACTION, use("operands")),
            match(f"{begin}{any_of(set(named) - here)}{END}", WRONG_PLACE)]
        groups = len(re.findall(r"\((?!\?)", head)) // 2
        areas.append({
            "name": f"meta.area.{name}",
            "begin": rf"(?i)^\s*{head}{END}(?:[\s,]+(BASE)[\s,]+([0-9]+))?",
            "beginCaptures": captures(*["keyword.other.area", "entity.name.section"] * groups, "keyword.other.area",
                                      "constant.numeric"),
            "end": r"(?i)^(?=\s*(?:AREA|FILE)(?![^\s,;]))",
            "patterns": [use(name)]})
    return grammar(
        "SUPER-40NC listing", "super-40nc", [COMMENT, *areas], **repository,
        operands=[match(word(r"K[-+]?[0-9]+"), "constant.numeric"),
                  match(word(r"[XYMTCD][0-9]+"), "variable.other.device"),
                  match(rf"{BEGIN}\*+{END}", "constant.language.unset")])


RS_FLOW = ("FOR", "NEXT", "EXIT_FOR", "IF", "ELSE", "END_IF", "GOTO", "LABEL", "EXIT_MACRO", "MP_CALL", "TIMER",
           "STOP_WAIT")


def rs_m8194h(tables):
    """A macro (MP) and an interrupt macro (ISR) accept different commands, and neither accepts those of the host."""
    rows = tables.describe("rs-m8194h", "instructions")
    names = {row["mnemonic"] for row in rows}
    flow = {"RSM_MACRO_" + name for name in RS_FLOW} & names
    begin = r"(?i)(?<![^\s,])"
    regions, repository = [], {}
    for kind in ("MP", "ISR"):
        # A macro ends with END, not with the command that closes the download.
        here = {row["mnemonic"] for row in rows if kind in row["areas"].split() and "_CLOSE" not in row["mnemonic"]}
        repository[kind.lower()] = [
            COMMENT,
            line_of(f"{begin}{any_of(here & flow)}{END}", CONTROL, use("operands")),
            line_of(f"{begin}{any_of(here - flow)}{END}", ACTION, use("operands")),
            match(f"{begin}{any_of(names - here)}{END}", WRONG_PLACE)]
        regions.append({
            "name": f"meta.macro.{kind.lower()}",
            "begin": rf"(?i)^[\s,]*({kind})[\s,]+(0x[0-9a-f]+|[0-9]+){END}",
            "beginCaptures": captures("keyword.other.macro", "entity.name.function"),
            "end": rf"(?i)^[\s,]*(END){END}|^(?=[\s,]*(?:MP|ISR|TRIGGER){END})",
            "endCaptures": captures("keyword.other.macro"),
            "patterns": [use(kind.lower())]})
    trigger = line_of(r"(?i)^[\s,]*TRIGGER(?![^\s,;])", "keyword.other.trigger",
                      match(rf"{BEGIN}[0-9]+\.[0-9]+{END}", "variable.other.terminal"),
                      match(word("MP[0-9]+"), "entity.name.function"),
                      match(word("(?:none|on|off|off_to_on|on_to_off|change)"), "constant.language"),
                      match(word("(?:hold|abort_command|abort_macro|pause|clear_stop)"), CONTROL),
                      match(word("[XYZU]"), "variable.other.axis"))
    return grammar(
        "RS-M8194H macros", "rs-m8194h", [COMMENT, *regions, trigger], **repository,
        operands=[match(word("b?VAR[0-9]+|MD[0-9]+"), "variable.other.register"),
                  match(word("(?:INITIAL_|AXIS_)?[XYZU]{1,4}"), "variable.other.axis"),
                  match(word(r"[-+]?(?:0x[0-9a-f]+|[0-9]+(?:\.[0-9]*)?(?:e[-+]?[0-9]+)?|\.[0-9]+(?:e[-+]?[0-9]+)?)"),
                        "constant.numeric"),
                  match(rf"{BEGIN}(?:[-+*/&|]|[<>]=?|[=!]=){END}", "keyword.operator")])


def slim(tables):
    rows = tables.describe("slim", "commands")
    refused = tables.refused_slim_commands()
    plain = [row for row in rows if "=" not in row["syntax"] and not row["syntax"].startswith("?")]
    jumps = {row["command"] for row in plain if row["command"].startswith("J")}
    conditions = {word for jump in jumps for word in (jump[1:], "N" + jump[1:])  # JI and JNI: "I" and "NI"
                  if len(jump) == 2 and "JN" + jump[1:] in jumps}
    flow = {row["command"] for row in plain if re.search(r"\baddr\b", row["syntax"])} | {"RET"}
    flow |= {row["command"] for row in plain if re.match(r"W", row["command"]) and "Wait" in row["meaning"]}
    parameters = {name for row in tables.describe("slim", "parameters") for name in (row["name"], row["number"]) if name}
    parameters |= {row["command"] for row in rows if re.fullmatch(r"[A-Z]+=.*", row["syntax"])}
    queries = [row for row in rows if row["syntax"].startswith("?")]
    clock = {row["command"][1:] for row in queries if "can be set" in row["meaning"]}
    measured = {row["command"][1:].upper() for row in queries if row["command"][1:].isalpha()} - {"Tp"}

    def names(some, has_module):
        """Returns a pattern of the commands, with the second word of those that have one."""
        found = {row["command"].removeprefix("Tp") for row in some if row["command"].startswith("Tp") == has_module}
        found = [name.removesuffix(" EV") + r"(?=[ \t]*EV[0-9])" if name.endswith(" EV") else
                 name.replace(" ", r"[ \t]+") + "(?![A-Za-z0-9])" for name in found if "<" not in name]
        return "(?:" + "|".join(sorted(found, key=lambda name: (-len(name), name))) + ")"

    def commands(some, scope):
        """Returns a rule for the commands of this module, and one for those of a module with a number (T1MA)."""
        for has_module in (False, True):
            if not any(row["command"].startswith("Tp") == has_module for row in some):
                continue
            module = "(T[0-9]{1,2})" if has_module else ""
            yield {"begin": rf"(?i)(?<!\S){module}({names(some, has_module)})",
                   "beginCaptures": captures(*["entity.name.module"] * has_module, scope),
                   "end": "$", "patterns": [use("operands")]}

    allowed = [row for row in plain if row not in refused]
    is_flow = [row for row in allowed if row["command"] in flow]
    is_action = [row for row in allowed if row["command"] not in flow]
    is_refused = [row for row in plain if row in refused]
    operand = r"(?<![A-Za-z0-9$])"
    assigned = rf"(?:{any_of(parameters | clock)}|[NR][0-9]+|[NR]S(?=[ \t]*\())"
    return grammar(
        "SLIM program", "slim",
        [match(r"^\s*[;#].*$", "comment.line"),
         captured(r"(?i)^\s*(\$[a-z0-9_]+)(?=\s|$)", "entity.name.label"),
         {"begin": rf"(?i)(?<!\S)(T[0-9]{{1,2}})?({assigned})(?=[ \t]*[=(])",
          "beginCaptures": captures("entity.name.module", "variable.other.assigned"),
          "end": "$", "patterns": [use("operands")]},
         *commands(is_refused, WRONG_PLACE), *commands(is_flow, CONTROL), *commands(is_action, ACTION)],
        operands=[match(r"\"[^\"]*\"|[“”＂][^“”＂]*[“”＂]", "string.quoted.double"),
                  match(r"(?i)\$[a-z0-9_]+", "entity.name.label"),
                  match(rf"(?i){operand}[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:e[-+]?[0-9]+)?(?![A-Za-z0-9])",
                        "constant.numeric"),
                  match(rf"(?i){operand}(?:[NR]S(?=[ \t]*\()|[NR][0-9]+)(?![A-Za-z0-9])", "variable.other.register"),
                  match(rf"(?i){operand}P[1-9](?![A-Za-z0-9])", "variable.other.terminal"),
                  match(rf"(?i){operand}EV[0-9]+(?![A-Za-z0-9])", "variable.other.event"),
                  match(rf"(?i){operand}GET[IR](?![A-Za-z0-9])", "support.function"),
                  match(rf"(?i){operand}{any_of(conditions)}(?=[ \t]*,)", "keyword.control.condition"),
                  match(rf"(?i){operand}(?:T[0-9]{{1,2}})?{any_of(parameters | measured)}(?![A-Za-z0-9])",
                        "variable.other.parameter"),
                  match(r"[=,()]", "punctuation.separator")])


def all_of(tables):
    return {"simple2-r3": simple2(tables), "super-40nc": super_40nc(tables), "rs-m8194h": rs_m8194h(tables),
            "slim": slim(tables)}
