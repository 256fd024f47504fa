#include "roomlight/program.h"

#include "base/platform/module.h"
#include "cli/processor.h"
#include "cli/program.h"
#include "engine/settings.h"
#include "roomlight/version.h"

namespace roomlight::v1 {

int runProgram(int argc, const char* const* argv) { return cli::runProgram(argc, argv); }

const char* version() { return roomlight::version(); }
std::string buildId() { return roomlight::buildId(); }
const char* instructionSet() { return cli::builtForProcessor(); }

}  // namespace roomlight::v1
