"""The program texts of this project: files, and those inside benches and scenarios, also typed by a host."""
import os

import yaml

ENDINGS = {".mac": "rs-m8194h", ".slim": "slim"}


def model_of_file(path):
    ending = os.path.splitext(path)[1]
    if ending == ".lst":
        return "super-40nc" if "super" in path else "simple2-r3"
    return ENDINGS.get(ending)


def models_in(node, found):
    """Adds the model of each device that a bench describes, by its name."""
    if isinstance(node, dict):
        if isinstance(node.get("name"), str) and isinstance(node.get("model"), str):
            found[node["name"]] = node["model"]
        for value in node.values():
            models_in(value, found)
    elif isinstance(node, list):
        for value in node:
            models_in(value, found)
    return found


def programs_in(node, models):
    """Yields (model, text) for each `program` that is written out."""
    if isinstance(node, list):
        for value in node:
            yield from programs_in(value, models)
    if not isinstance(node, dict):
        return
    program = node.get("program")
    if isinstance(program, str) and "model" in node:
        yield node["model"], program
    if isinstance(program, dict):
        yield from ((models.get(device), text) for device, text in program.items())
    for value in node.values():
        yield from programs_in(value, models)


def lines_sent(node):
    """Yields the texts that the steps of a scenario send, in their order."""
    if isinstance(node, list):
        for value in node:
            yield from lines_sent(value)
    elif isinstance(node, dict):
        send = node.get("send")
        if isinstance(send, dict) and isinstance(send.get("text"), str):
            yield send["text"]
        for value in node.values():
            yield from lines_sent(value)


def typed_programs(node):
    """Yields the SLIM programs that a host types, line by line."""
    lines = None
    for line in lines_sent(node):
        if line.upper() in ("PG", "DLP"):
            lines = []
        elif lines is not None and line.upper() in ("", "EXIT", "END"):
            yield "\n".join(lines) + "\n"
            lines = None
        elif lines is not None:
            lines.append(line)


def read_yaml(path):
    with open(path, encoding="utf-8") as file:
        try:
            return yaml.load(file, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
        except yaml.YAMLError:
            return None


def of_yaml(path):
    whole = read_yaml(path)
    if not isinstance(whole, dict):
        return
    models = models_in(whole, {})
    if isinstance(whole.get("bench"), str):
        bench = os.path.join(os.path.dirname(path), whole["bench"])
        if os.path.exists(bench):
            models_in(read_yaml(bench), models)
    for model, text in programs_in(whole, models):
        if isinstance(text, str) and "\n" in text and model in ("simple2-r3", "super-40nc", "rs-m8194h", "slim"):
            yield model, text
    yield from (("slim", text) for text in typed_programs(whole))


def all_of(project):
    """Yields (path, model, text)."""
    for room in ("scenarios", "docs", "examples", "recipes", "tests"):
        for folder, folders, names in os.walk(os.path.join(project, room)):
            folders.sort()
            for name in sorted(names):
                path = os.path.join(folder, name)
                if model := model_of_file(path):
                    with open(path, encoding="utf-8") as file:
                        yield path, model, file.read()
                elif name.endswith(".yaml"):
                    yield from ((path, model, text) for model, text in of_yaml(path))
