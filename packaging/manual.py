#!/usr/bin/env python3
"""Manual pages: roomlight.1, and roomlight-COMMAND.1 for each command.

    packaging/manual.py PROGRAM VERSION DATE FOLDER
"""
import re
import sys
from pathlib import Path

from options import options_of, takes

STATUSES = [("0", "done"), ("1", "the work failed, or a check did"), ("2", "bad input; nothing was written"),
            ("3", "not enough memory, or an older processor than this build needs"),
            ("130", "interrupted by Ctrl-C; the first one ends the work in order, the second at once")]


def plain(text):
    """Text as roff has it: no line is taken for a request, and hyphens of options can be copied."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.M)


def option_lines(options):
    for o in options:
        value = f" \\fI{takes(o)}\\fR" if o["value"] and o["names"][0].startswith("-") else ""
        names = ", ".join(f"\\fB{plain(name)}\\fR{value}" for name in o["names"])
        default = f" Default: {o['default']}." if o.get("default") else ""
        about = o["about"] if o["about"].endswith((".", ")")) or not default else o["about"] + "."
        yield f".TP\n{names}\n{plain(about + default)}"


def usage(name, command):
    words = [f".B {plain(name)}", "[\\fIOPTION\\fR]..."]
    words += [o["names"][0] if o["isRequired"] else f"[{o['names'][0]}]" for o in command["arguments"]]
    words += ["\\fICOMMAND\\fR ..."] if command["commands"] else []
    return words[0] + "\n" + " ".join(words[1:])


def section(title, lines):
    lines = list(lines)
    return [f".SH {title}"] + lines if lines else []


def examples(footer):
    """The words below a command's options, as they stand."""
    return [f".nf\n{plain(footer.strip())}\n.fi"] if footer.strip() else []


def page(name, command, version, date, see):
    dashed = name.replace(" ", "-")
    out = [f'.TH {dashed.upper()} 1 "{date}" "roomlight {version}" "User Commands"']
    out += section("NAME", [plain(f"{dashed} - {command['about'].rstrip('.')}")])
    out += section("SYNOPSIS", [usage(name, command)])
    out += section("ARGUMENTS", option_lines(command["arguments"]))
    out += section("OPTIONS", option_lines(command["options"]))
    for part in command["commands"]:
        if part["commands"] or name == "roomlight":
            continue
        title = f"{name.split()[-1]} {part['name']}".upper()
        out += section(plain(title), [plain(part["about"]) + "."] + list(option_lines(part["arguments"] + part["options"])))
    if name == "roomlight":
        out += section("COMMANDS", [f".TP\n.BR {plain('roomlight-' + c['name'])} (1)\n{plain(c['about'])}"
                                    for c in command["commands"]])
        out += section('"EXIT STATUS"', [f".TP\n.B {number}\n{plain(meaning)}" for number, meaning in STATUSES])
        out += section("FILES", [".TP\n.I share/doc/roomlight/docs\nPages that help texts name, such as docs/reference/lighting.md; "
                                 "beside the program, in /usr where it is a package of Debian"])
    out += section("EXAMPLES", examples(command["footer"]))
    out += section('"SEE ALSO"', [" ,\n".join(f".BR {plain(other)} (1)" for other in see)])
    return "\n".join(out) + "\n"


def main():
    program, version, date, folder = sys.argv[1:5]
    listed = options_of(program)
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    names = [f"roomlight-{c['name']}" for c in listed["commands"]]
    (folder / "roomlight.1").write_text(page("roomlight", listed, version, date, names))
    for command in listed["commands"]:
        (folder / f"roomlight-{command['name']}.1").write_text(
            page(f"roomlight {command['name']}", command, version, date, ["roomlight"]))


if __name__ == "__main__":
    main()
