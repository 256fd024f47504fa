// The file that this code was loaded from: the library libroomlight, or a program that holds all of it.
#pragma once

#include <filesystem>
#include <string>

namespace roomlight {

// Which build of the code runs: hexadecimal digits that differ for any two builds whose code differs, also for builds
// for other instruction sets.
const std::string& buildId();

// Of the library's file, or of the program where the code is a part of that. Empty where that cannot be told.
std::filesystem::path moduleFolder();

// The program that runs, whatever it is: to start it once more, even where another has been built meanwhile.
std::filesystem::path runningProgram();

// Where that lies.
std::filesystem::path programFolder();

// `below` in the prefix of the library, which may lie as deep as in
// PREFIX/lib/x86_64-linux-gnu/glibc-hwcaps/x86-64-v3, or else of the program, as in PREFIX/bin. Where neither has it,
// in the program's.
std::filesystem::path installed(const std::filesystem::path& below);

}  // namespace roomlight
