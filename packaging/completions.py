#!/usr/bin/env python3
"""Completions of the command line for bash, zsh and fish, under share/ as those shells look for them.

    packaging/completions.py PROGRAM FOLDER

Commands, options and the words that options take are completed, all other values as files.
"""
import shlex
import sys
from pathlib import Path

from options import options_of


def commands_of(listed):
    """(words of the command, command) of all that have options: ("render",), ("batch", "plan"), ..."""
    for command in listed["commands"]:
        yield (command["name"],), command
        for part in command["commands"]:
            yield (command["name"], part["name"]), part


def words_of(command):
    """What may stand next: commands of its own, and options."""
    return [c["name"] for c in command["commands"]] + [n for o in command["options"] for n in o["names"]]


BASH = """# bash completion of roomlight, made from `roomlight --options`
_roomlight() {
  local word="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD-1]}" command="" i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$command ${COMP_WORDS[i]}" in
@PREFIXES@) command="${command:+$command }${COMP_WORDS[i]}" ;;
    esac
  done
  COMPREPLY=()
  local choices=""
  case "$command $before" in
@CHOICES@  esac
  if [[ -n $choices ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
    return
  fi
  local words=""
  case "$command" in
@WORDS@  esac
  if [[ $word == -* || $command == "" || $words != -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  else
    compopt -o default
  fi
}
complete -F _roomlight roomlight
"""


def bash(listed):
    commands = list(commands_of(listed))
    prefixes = "      " + " | \\\n      ".join(f'"{" ".join(names[:-1])} {names[-1]}"' for names, _ in commands)
    choices = ""
    for names, command in commands:
        for option in command["options"]:
            if option["choices"]:
                patterns = " | ".join(f'"{" ".join(names)} {n}"' for n in option["names"])
                choices += f"    {patterns}) choices={shlex.quote(' '.join(option['choices']))} ;;\n"
    words = f'    "") words={shlex.quote(" ".join(words_of(listed)))} ;;\n'
    for names, command in commands:
        words += f'    "{" ".join(names)}") words={shlex.quote(" ".join(words_of(command)))} ;;\n'
    return BASH.replace("@PREFIXES@", prefixes).replace("@CHOICES@", choices).replace("@WORDS@", words)


def zsh_option(option):
    about = option["brief"].translate({ord(c): f"\\{c}" for c in "[]:"})
    value = ""
    if option["value"]:
        value = f":value:({' '.join(option['choices'])})" if option["choices"] else ":value:_files"
    for name in option["names"]:
        yield shlex.quote(f"*{name}[{about}]{value}")


def zsh(listed):
    out = ["#compdef roomlight", "# made from `roomlight --options`", ""]

    def function(name, command):
        arguments = [s for o in command["options"] for s in zsh_option(o)]
        out.append(f"{name}() {{")
        if command["commands"]:
            out.append("  local context state line\n  typeset -A opt_args")
            arguments += ["'1:command:->command'", "'*::argument:->rest'"]
        else:
            arguments.append("'*:file:_files'")
        out.append("  _arguments -C \\\n    " + " \\\n    ".join(arguments))
        if command["commands"]:
            shown = " ".join(shlex.quote(f"{c['name']}:{c['about']}") for c in command["commands"])
            cases = "\n".join(f"        {c['name']}) {name}_{c['name']} ;;" for c in command["commands"])
            out.append(f"  case $state in\n    command)\n      local -a commands=({shown})\n"
                       f"      _describe command commands ;;\n    rest)\n      case $line[1] in\n{cases}\n      esac ;;\n  esac")
        out.append("}\n")
        for part in command["commands"]:
            function(f"{name}_{part['name']}", part)

    function("_roomlight", listed)
    return "\n".join(out) + '\n_roomlight "$@"\n'


def fish_option(condition, option):
    line = f"complete -c roomlight -n {shlex.quote(condition)}"
    for name in option["names"]:
        line += f" -l {name[2:]}" if name.startswith("--") else f" -s {name[1:]}"
    if option["value"]:
        line += f" -x -a {shlex.quote(' '.join(option['choices']))}" if option["choices"] else " -r"
    return f"{line} -d {shlex.quote(option['brief'])}"


def fish(listed):
    out = ["# fish completion of roomlight, made from `roomlight --options`"]
    out += [fish_option("__fish_use_subcommand", o) for o in listed["options"]]
    for command in listed["commands"]:
        name = command["name"]
        out.append(f"complete -c roomlight -n __fish_use_subcommand -f -a {name} -d {shlex.quote(command['about'])}")
        parts = " ".join(p["name"] for p in command["commands"])
        among = f"__fish_seen_subcommand_from {name}"
        if parts:
            among += f"; and not __fish_seen_subcommand_from {parts}"
        out += [fish_option(among, o) for o in command["options"]]
        for part in command["commands"]:
            out.append(f"complete -c roomlight -n {shlex.quote(among)} -f -a {part['name']} -d {shlex.quote(part['about'])}")
            inside = f"__fish_seen_subcommand_from {name}; and __fish_seen_subcommand_from {part['name']}"
            out += [fish_option(inside, o) for o in part["options"]]
    return "\n".join(out) + "\n"


def main():
    program, folder = sys.argv[1], Path(sys.argv[2])
    listed = options_of(program)
    for place, text in (("bash-completion/completions/roomlight", bash(listed)),
                        ("zsh/vendor-completions/_roomlight", zsh(listed)),
                        ("fish/vendor_completions.d/roomlight.fish", fish(listed))):
        file = folder / place
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)


if __name__ == "__main__":
    main()
