// Photometric files: IES LM-63 and EULUMDAT, as text.
#pragma once

#include <functional>
#include <string_view>

#include "base/result.h"
#include "photometry/photometric_web.h"

namespace roomlight {

struct WebFile {
  PhotometricWeb web;
  std::vector<std::string> warnings;  // one line each, without the file's name
};

// The text of the file that TILT= names. Its error is one line without a place.
using TiltFile = std::function<Result<std::string>(const std::string& name)>;

// IES LM-63: editions 1986, 1991, 1995, 2002 and 2019, types C, B and A. `text`: the whole file. The error is one line,
// "line 12: what is wrong", without the file's name. A web that is not within 2 % of the flux that the file states is a
// warning with both numbers. `tiltFile` may be empty: then such a file is an error.
Result<WebFile> parseIes(std::string_view text, const TiltFile& tiltFile = {});

// EULUMDAT (.ldt; Stockmar 1990 and 1998), all symmetries. As parseIes does. Intensities in cd/klm are multiplied by
// the flux of the first set of lamps.
Result<WebFile> parseEulumdat(std::string_view text);

}  // namespace roomlight
