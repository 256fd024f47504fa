// Which instructions the program was built for, and which this processor has. On an older processor the program ends
// with one line before anything else of it runs.
#pragma once

namespace roomlight::cli {

// As it was built: "x86-64-v3", or another value of -march.
const char* builtForProcessor();

// The highest level that this processor has, "x86-64" to "x86-64-v4"; empty where levels are unknown.
const char* processorLevel();

}  // namespace roomlight::cli
