// Any bytes as an IES file, and as the file that its TILT= names: no crash, no hang. An error is one short line; what
// is accepted is a finite web that can be sampled.
#include "fuzz/photometric.h"
#include "photometry/ies.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  roomlight::fuzz::check(
      roomlight::parseIes(text, [&](const std::string&) { return roomlight::Result<std::string>(text); }));
  return 0;
}
