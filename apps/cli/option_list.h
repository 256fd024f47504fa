// All commands and options as data: manual pages and completions of shells are made from it (scripts/package).
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace roomlight::cli {

// {"name", "about", "footer", "arguments": [], "options": [], "commands": []}, commands alike. An argument or option
// has "names" (such as ["-o", "--output"], of an argument one without dashes), "about", "value" (what it takes: "TEXT",
// "INT", "FLOAT"; null for a flag), "isRequired" and "default" where it has one.
std::string optionsJson(const CLI::App& program);

}  // namespace roomlight::cli
