// Home.xml into plain data.
#pragma once

#include <span>
#include <string_view>

#include "import/sh3d_home.h"
#include "import/warnings.h"

namespace roomlight::importers::sh3d {

// Throws Failure that names line and element: not well-formed, no home, a number that is none or beyond every home, a
// missing attribute that the DTD requires. Elements and attributes that are not known are passed over, as later
// versions add some.
Home readHomeXml(std::span<const uint8_t> xml, Warnings& warnings);

}  // namespace roomlight::importers::sh3d
