// Names of techniques, for what is about one of them alone. What a technique can do is asked of its row: technique.h.
#pragma once

namespace roomlight::technique {

inline constexpr char kHybrid[] = "hybrid";
inline constexpr char kCone[] = "cone";
inline constexpr char kVxgi[] = "vxgi";
inline constexpr char kLpv[] = "lpv";
inline constexpr char kPhoton[] = "photon";
inline constexpr char kPath[] = "path";

}  // namespace roomlight::technique
