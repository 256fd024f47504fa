// Versions of the interface: semantic. A program that was built with one runs with any library of the same major
// version and the same or a later minor one.
#pragma once

#include "roomlight/basics.h"

#define ROOMLIGHT_VERSION_MAJOR 1
#define ROOMLIGHT_VERSION_MINOR 0
#define ROOMLIGHT_VERSION_PATCH 0

namespace ROOMLIGHT_NAMESPACE {

// Of the library that runs, as `roomlight --version` says it: "1.0.0-rc1".
ROOMLIGHT_API const char* version();

// Which build of it: hexadecimal digits. Builds differ in the last bits of a picture.
ROOMLIGHT_API std::string buildId();

// The instruction set it was built for: "x86-64-v3".
ROOMLIGHT_API const char* instructionSet();

}  // namespace ROOMLIGHT_NAMESPACE
