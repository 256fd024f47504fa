// A frame as it goes to the browser: a header of 64 bytes and a JPEG (docs/reference/view-protocol.md).
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "base/image.h"
#include "base/result.h"

namespace roomlight::view {

constexpr uint8_t kQuick = 1, kSettled = 2, kLightIsBehind = 4, kFalseColour = 8, kRefined = 16;
constexpr size_t kFrameHeaderBytes = 64;

struct FrameInfo {
  static constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  uint32_t number = 0;
  uint8_t side = 0, flags = 0;
  uint16_t jpegQuality = 80;
  uint32_t camera = 0, revision = 0, samples = 0;
  uint32_t samplesInAll = 0;  // with which the average is complete; 0: nobody knows
  float relativeError = kNone, ev100 = kNone, scaleLow = kNone, scaleHigh = kNone;
  float latencyMs = 0, pictureMs = 0, whiteK = kNone;
};

// Error: the picture cannot be encoded.
Result<std::string> packFrame(const FrameInfo& info, const ByteImage& picture);

}  // namespace roomlight::view
