#include "trace/ray_library.h"

#include "trace/embree.h"

namespace roomlight {

std::string rayLibraryVersion() {
  const RTCDevice device = rtcNewDevice(nullptr);
  if (!device) return {};
  const auto part = [&](RTCDeviceProperty p) { return std::to_string(rtcGetDeviceProperty(device, p)); };
  std::string version = part(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + "." + part(RTC_DEVICE_PROPERTY_VERSION_MINOR) + "." +
                        part(RTC_DEVICE_PROPERTY_VERSION_PATCH);
  rtcReleaseDevice(device);
  return version;
}

}  // namespace roomlight
