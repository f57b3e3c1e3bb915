"""Snippets: an instruction of a program with a place for each operand, and first benches and scenarios."""
import re

from tables import MODELS


def escaped(text):
    return re.sub(r"([\\$}])", r"\\\1", text)


def places(names):
    """Returns "${1:first} ${2:second}" for operands with these names."""
    return " ".join(f"${{{number}:{escaped(name)}}}" for number, name in enumerate(names, 1))


def snippet(prefix, body, description):
    return {"prefix": prefix, "body": body, "description": description}


def by_prefix(snippets):
    """Returns the snippets in the form of their file: each with its own name."""
    named = {}
    for some in snippets:
        name, number = some["prefix"], 1
        while name in named:
            number += 1
            name = f"{some['prefix']} ({number})"
        named[name] = some
    return named


def simple2(tables):
    for row in tables.describe("simple2-r3", "instructions"):
        operands = [re.sub(r" \(.*", "", row[cell]) for cell in ("data1", "data2") if row[cell] != "N/A"]
        if operands[:1] == ["amount_L"]:  # a listing has one number in both cells
            operands = ["amount"]
        yield snippet(row["mnemonic"], f"{row['mnemonic']} {places(operands)}".rstrip(), row["meaning"])


def super_40nc(tables):
    for row in tables.describe("super-40nc", "instructions"):
        if not row["areas"]:
            continue
        mnemonic = re.sub("[a-z].*$", "", row["mnemonic"])
        operands = ["*" if operand.startswith("[") else operand for operand in row["operands"].split("; ") if operand]
        yield snippet(mnemonic, f"{mnemonic} {places(operands)}".rstrip(), row["meaning"])
    for area in ("C", "X", "Y", "Z", "U", "PLC"):
        yield snippet(f"AREA {area}", [f"AREA {area}", "      $0", "      END"], "Begins a program")
    yield snippet("FILE", ["FILE ${1:0}", "      $0", "      END"], "Begins the C program of a path file")


def rs_m8194h(tables):
    for row in tables.describe("rs-m8194h", "instructions"):
        if "MP" not in row["areas"].split() and "ISR" not in row["areas"].split() or "_CLOSE" in row["mnemonic"]:
            continue
        # Returns only the names of "axis (axes, X to XYZU); data (0 to 10)".
        operands = re.findall(r"(?:^|; )(\w+) \(", row["operands"])
        yield snippet(row["mnemonic"], f"{row['mnemonic']} {places(operands)}".rstrip(), row["meaning"])
    for kind, meaning in (("MP", "A macro"), ("ISR", "A macro for interrupts")):
        yield snippet(kind, [f"{kind} ${{1:1}}", "  $0", "END"], meaning)
    yield snippet("TRIGGER", "TRIGGER ${1:8.0} ${2|off_to_on,on_to_off,change,on,off|} ${3:MP1}",
                  "Calls a macro when an input changes")


def slim(tables):
    refused = tables.refused_slim_commands()
    for row in tables.describe("slim", "commands"):
        if row in refused or re.search("[<#]", row["command"]):
            continue
        head, syntax = row["command"], row["syntax"].replace("[", "").replace("]", "")
        if not syntax.startswith(head):  # T0SYN=n of TpSYN
            syntax = head + syntax[len(head):]
        number = iter(range(1, 20))
        module = f"T${{{next(number)}:1}}" if head.startswith("Tp") else ""
        body = module + head.removeprefix("Tp" if module else "")
        rest = syntax[len(head):]
        if alternatives := re.fullmatch(r"=(\w+)\|(\w+)", rest):
            body += f"=${{1|{alternatives[1]},{alternatives[2]}|}}"
        else:
            body += re.sub(r"[\w#]+", lambda name: f"${{{next(number)}:{name[0]}}}", rest)
        yield snippet(head, body, row["meaning"])


def files(tables):
    """First benches and scenarios of the models, without the line that names a schema beside them."""
    for model in MODELS:
        for name, text in tables.first_files(model).items():
            kind = "bench" if name == "bench.yaml" else "scenario"
            lines = [escaped(line) for line in text.splitlines() if not line.startswith("# yaml-language-server")]
            yield snippet(f"understudy {kind} {model}", lines, f"A first {kind} of Understudy with a {model}")


def all_of(tables):
    made = {"simple2-r3": simple2, "super-40nc": super_40nc, "rs-m8194h": rs_m8194h, "slim": slim, "yaml": files}
    return {name: by_prefix(make(tables)) for name, make in made.items()}
