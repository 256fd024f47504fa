// Compiled for any processor, unlike all else (CMakeLists.txt here), and without what others may have compiled for a
// newer one: no std::string, no inline functions of headers.
#include "processor.h"

#include <string.h>
#include <unistd.h>

namespace roomlight::cli {
namespace {

#ifdef __x86_64__
constexpr const char* kLevels[] = {"x86-64", "x86-64-v2", "x86-64-v3", "x86-64-v4"};

// An index of kLevels.
int levelHere() {
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("ssse3") || !__builtin_cpu_supports("sse4.2") || !__builtin_cpu_supports("popcnt"))
    return 0;
  // Clang 16 does not know F16C and LZCNT; there is no processor with AVX2 that lacks them.
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") || !__builtin_cpu_supports("bmi") ||
      !__builtin_cpu_supports("bmi2"))
    return 1;
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512bw") ||
      !__builtin_cpu_supports("avx512cd") || !__builtin_cpu_supports("avx512dq") || !__builtin_cpu_supports("avx512vl"))
    return 2;
  return 3;
}

// Other values of -march are not checked.
int levelOf(const char* name) {
  for (int level = 3; level > 0; --level) {
    if (strcmp(name, kLevels[level]) == 0) return level;
  }
  return 0;
}

constexpr char kTooOld[] =
    "roomlight: this processor is too old for this build, which needs one of level " ROOMLIGHT_ARCH
    "; take a build for x86-64-v2, or build it on this machine (scripts/build)\n";
constexpr int kStatus = 3;  // kNoRoom of exit_status.h

// Before the constructors of other files, which may use any instruction.
__attribute__((constructor(101))) void refuseOlderProcessor() {
  if (levelHere() >= levelOf(ROOMLIGHT_ARCH)) return;
  (void)!write(STDERR_FILENO, kTooOld, sizeof(kTooOld) - 1);
  _exit(kStatus);
}
#endif

}  // namespace

const char* builtForProcessor() { return ROOMLIGHT_ARCH; }

const char* processorLevel() {
#ifdef __x86_64__
  return kLevels[levelHere()];
#else
  return "";
#endif
}

}  // namespace roomlight::cli
