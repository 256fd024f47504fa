// roomlight: light in a home, from the command line.
#include <cstdio>
#include <exception>
#include <new>
#include <vector>

#include "commands.h"
#include "console.h"
#include "option_list.h"
#include "base/result.h"
#include "engine/settings.h"

namespace {

int runProgram(int argc, char** argv) {
  CLI::App program("Light in a real home: opens a scene, lights it, writes the picture, judges it.", "roomlight");
  program.set_version_flag("--version", std::string("roomlight ") + roomlight::version());
  program.add_flag_callback(
      "--options", [&] { throw CLI::CallForVersion(roomlight::cli::optionsJson(program), roomlight::cli::kOk); },
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
  const std::vector<roomlight::cli::Registered> commands = roomlight::cli::addCommands(program);
  if (const roomlight::Status s = roomlight::cli::checkWords(program, {argv + 1, argv + argc}); !s) {
    roomlight::cli::printError(s.error());
    return roomlight::cli::kBadInput;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& e) {  // --help, --version
    return program.exit(e);
  } catch (const CLI::ParseError& e) {
    roomlight::cli::printError(std::string(e.what()) + "; see roomlight --help");
    return roomlight::cli::kBadInput;
  }
  for (const roomlight::cli::Registered& command : commands) {
    if (command.app->parsed()) return command.run();
  }
  return roomlight::cli::kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int status = runProgram(argc, argv);
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
    roomlight::cli::printError("standard output cannot be written");
  } catch (const std::bad_alloc&) {
    roomlight::cli::printError(roomlight::cli::outOfMemoryWords());
    return roomlight::cli::kNoRoom;
  } catch (const roomlight::ResourceError& e) {
    roomlight::cli::printError(e.what());
    return roomlight::cli::kNoRoom;
  } catch (const std::exception& e) {
    roomlight::cli::printError(std::string("unexpected: ") + e.what());
  }
  return roomlight::cli::kFailed;
}
