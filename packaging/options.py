"""Commands and options of the program as it lists them itself (`roomlight --options`), for manual pages and completions."""
import json
import re
import subprocess

# How the program lists choices: "How much is done: draft (for trying out); good (for looking at)", and "TEXT:{y,z}".
CHOICES = re.compile(r"(?:^|: )((?:[\w-]+ \((?:[^()]|\([^()]*\))*\)(?:; )?)+)$")
SET = re.compile(r"\{([^}]*)\}")


def options_of(program):
    """{"name", "about", "footer", "arguments", "options", "commands"}, each option with "choices" and "brief" added."""
    listed = subprocess.run([program, "--options"], check=True, capture_output=True, text=True).stdout
    return completed(json.loads(listed))


def completed(command):
    for option in command["arguments"] + command["options"]:
        option["choices"] = choices_of(option)
        option["brief"] = brief(option["about"])
    for part in command["commands"]:
        completed(part)
    return command


def choices_of(option):
    """The words that an option takes, where it lists them."""
    if not option["value"]:
        return []
    if found := SET.search(option["value"]):
        return found.group(1).split(",")
    if found := CHOICES.search(option["about"]):
        return re.findall(r"(?:^|; )([\w-]+) \(", found.group(1))
    return []


def brief(about):
    """The first clause, for lists in which a line is all there is."""
    first = re.split(r"[:;(]", about)[0].strip().rstrip(".,")
    return first if len(first) <= 72 else first[:69].rsplit(" ", 1)[0] + " ..."


def takes(option):
    """The kind of value, without its range or choices: TEXT, INT, FLOAT, DIR; empty for a flag."""
    return re.split(r"[:{ ]", option["value"])[0] if option["value"] else ""
