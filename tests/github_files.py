"""Checks the files in .github/ as far as possible without GitHub: they parse, and have the necessary keys.

github_files.faults_of(project) yields (path, line, what is wrong and what was expected). Without python3-yaml it
checks nothing.
"""
import os

try:
    import yaml
except ImportError:
    yaml = None

INPUTS = ("checkboxes", "dropdown", "input", "textarea", "upload")  # of an issue form; `markdown` is text


def faults_of_workflow(workflow):
    if not isinstance(workflow, dict) or not isinstance(workflow.get("jobs"), dict) or not workflow["jobs"]:
        yield "is not a workflow; expected `on` and `jobs`"
        return
    if not workflow.get("on", workflow.get(True)):  # YAML 1.1 reads `on` as true
        yield "says not when it runs; expected `on`"
    for name, job in workflow["jobs"].items():
        steps = job.get("steps") if isinstance(job, dict) else None
        if not steps or not job.get("runs-on"):
            yield f"job {name} lacks `runs-on` or `steps`; expected both"
        for step in steps or []:
            if ("run" in step) == ("uses" in step):
                yield f"a step of job {name} has neither or both of `run` and `uses`; expected one"


def faults_of_form(form):
    if not isinstance(form, dict) or not all(form.get(key) for key in ("name", "description", "body")):
        yield "is not an issue form; expected `name`, `description` and `body`"
        return
    known = set()
    for field in form["body"]:
        attributes = field.get("attributes", {})
        if field.get("type") == "markdown" and attributes.get("value"):
            continue
        if field.get("type") not in INPUTS or not attributes.get("label"):
            yield f"has a field without a known type or a label: {field}; expected both"
        if field.get("type") == "dropdown" and not attributes.get("options"):
            yield f"the dropdown {field.get('id')} has no options; expected some"
        if field.get("id") in known:
            yield f"has two fields called {field['id']}; expected different ids"
        known.add(field.get("id"))


def judged(text, path):
    try:
        content = yaml.safe_load(text)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        yield (mark.line + 1 if mark else 1), f"is not YAML ({getattr(error, 'problem', error)}); expected it to be"
        return
    if "/workflows/" in path:
        yield from ((1, what) for what in faults_of_workflow(content))
    elif "/ISSUE_TEMPLATE/" in path and not path.endswith("config.yml"):
        yield from ((1, what) for what in faults_of_form(content))


def faults_of(project):
    for folder, folders, names in os.walk(os.path.join(project, ".github")) if yaml else []:
        folders.sort()
        for name in sorted(names):
            if name.endswith((".yml", ".yaml")):
                path = os.path.relpath(os.path.join(folder, name), project)
                with open(os.path.join(project, path), encoding="utf-8") as file:
                    yield from ((path, line, what) for line, what in judged(file.read(), path))
