// The command line, from its words to an exit status.
#include <cstdio>
#include <exception>
#include <new>
#include <vector>

#include "commands.h"
#include "console.h"
#include "option_list.h"
#include "program.h"
#include "base/result.h"
#include "engine/settings.h"

namespace roomlight::cli {
namespace {

int runCommand(int argc, const char* const* argv) {
  CLI::App program("Light in a real home: opens a scene, lights it, writes the picture, judges it.", "roomlight");
  program.set_version_flag("--version", std::string("roomlight ") + version());
  program.add_flag_callback(
      "--options", [&] { throw CLI::CallForVersion(optionsJson(program), kOk); },
      "Print all commands and options as JSON and exit");
  program.require_subcommand(1);
  program.footer(
      "Examples:\n"
      "  roomlight render flat.glb -o flat.png\n"
      "  roomlight render flat.glb --lighting evening.json --camera Kitchen -o kitchen.exr -o kitchen.png\n"
      "  roomlight measure flat.glb --lighting evening.json --html report.html\n"
      "  roomlight compare reference.exr flat.exr\n"
      "  roomlight info flat.glb\n"
      "'roomlight COMMAND --help' explains a command.");
  const std::vector<Registered> commands = addCommands(program);
  if (const Status s = checkWords(program, {argv + 1, argv + argc}); !s) {
    printError(s.error());
    return kBadInput;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& e) {  // --help, --version
    return program.exit(e);
  } catch (const CLI::ParseError& e) {
    printError(std::string(e.what()) + "; see roomlight --help");
    return kBadInput;
  }
  for (const Registered& command : commands) {
    if (command.app->parsed()) return command.run();
  }
  return kBadInput;
}

}  // namespace

int runProgram(int argc, const char* const* argv) {
  try {
    const int status = runCommand(argc, argv);
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
    printError("standard output cannot be written");
  } catch (const std::bad_alloc&) {
    printError(outOfMemoryWords());
    return kNoRoom;
  } catch (const ResourceError& e) {
    printError(e.what());
    return kNoRoom;
  } catch (const std::exception& e) {
    printError(std::string("unexpected: ") + e.what());
  }
  return kFailed;
}

}  // namespace roomlight::cli
