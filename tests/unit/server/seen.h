// What tests of a served home say and look for again and again.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "served_home.h"

namespace roomlight::testing {

inline const nlohmann::json kViewport = {{"type", "viewport"}, {"width", 96}, {"height", 54}};

inline bool isWhole(const ReceivedFrame& f) { return f.width == 96 && f.height == 54; }

inline nlohmann::json named(const nlohmann::json& list, const std::string& name) {
  for (const nlohmann::json& j : list) {
    if (j["name"] == name) return j;
  }
  ADD_FAILURE() << name << " is missing";
  return {};
}

// What falls on what is seen near the lower edge: the floor. Throws where the meter has met nothing.
inline double lux(Client& client, uint32_t id) {
  client.say({{"type", "meter"}, {"id", id}, {"x", 0.5}, {"y", 0.9}});
  const nlohmann::json hit = client.hear("metered", id)["hit"];
  if (hit.is_null()) throw std::runtime_error("the meter has met nothing");
  return hit["illuminanceLux"].get<double>();
}

// That what is waited for does not come, on a line that the server keeps open all that time. Nothing more comes on it.
template <class Wait>
void expectNothingInTime(const Wait& wait) {
  try {
    wait();
    ADD_FAILURE() << "it came";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("in time"), std::string::npos) << e.what();
  }
}

}  // namespace roomlight::testing
