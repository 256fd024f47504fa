// Any bytes as an EULUMDAT file: no crash, no hang. An error is one short line; what is accepted is a finite web that
 // can be sampled.
#include "fuzz/photometric.h"
#include "photometry/eulumdat.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  roomlight::fuzz::check(roomlight::parseEulumdat({reinterpret_cast<const char*>(data), size}));
  return 0;
}
