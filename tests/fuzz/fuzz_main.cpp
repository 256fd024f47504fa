// What libFuzzer calls: hands its bytes to the one target that this program is for.
#include <cstddef>
#include <cstdint>

namespace roomlight::fuzz {

void ROOMLIGHT_FUZZ_TARGET(const uint8_t* data, size_t size);

}  // namespace roomlight::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  roomlight::fuzz::ROOMLIGHT_FUZZ_TARGET(data, size);
  return 0;
}
