// A validation as files.
#pragma once

#include <string>

#include "validate/validation.h"

namespace roomlight {

std::string validationJson(const Validation& validation);
// One page that needs nothing else: a summary, a dot for every value by technique, and the table of all.
std::string validationHtml(const Validation& validation, const std::string& version);

}  // namespace roomlight
