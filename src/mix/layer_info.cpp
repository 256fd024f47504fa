#include "mix/layer_info.h"

#include <fmt/core.h>

#include <array>
#include <nlohmann/json.hpp>

namespace roomlight {
namespace {

using Json = nlohmann::json;
constexpr int kVersion = 1;
constexpr std::array<std::string_view, 5> kKinds = {"lamp", "group", "mesh", "sun", "sky"};

std::optional<double> optionalNumber(const Json& layer, const char* key) {
  const auto found = layer.find(key);
  if (found == layer.end() || found->is_null()) return std::nullopt;
  return found->get<double>();
}

std::optional<Vec3> optionalRgb(const Json& layer, const char* key) {
  const auto c = layer.find(key);
  if (c == layer.end() || c->is_null()) return std::nullopt;
  const Vec3 rgb{c->at(0).get<float>(), c->at(1).get<float>(), c->at(2).get<float>()};
  if (!isFinite(rgb) || minComponent(rgb) < 0)
    throw std::runtime_error(fmt::format("'{}' must be three numbers from 0 on", key));
  return rgb;
}

LayerInfo read(const Json& layer) {
  LayerInfo info;
  info.channel = layer.at("channel").get<std::string>();
  info.name = layer.at("name").get<std::string>();
  info.kind = layer.at("kind").get<std::string>();
  if (std::find(kKinds.begin(), kKinds.end(), info.kind) == kKinds.end())
    throw std::runtime_error("unknown kind '" + info.kind + "'");
  info.colour = optionalRgb(layer, "colour").value_or(info.colour);
  // A layer without light of its own has no hue; white says nothing wrong.
  info.colour = isBlack(info.colour) ? Vec3(1) : info.colour / luminance(info.colour);
  info.lightColour = optionalRgb(layer, "lightColour");
  info.kelvin = optionalNumber(layer, "kelvin");
  info.fluxLm = optionalNumber(layer, "fluxLm");
  if (const auto room = layer.find("room"); room != layer.end() && room->is_string())
    info.room = room->get<std::string>();
  if (const auto p = layer.find("pixel"); p != layer.end() && !p->is_null())
    info.pixel = Vec2{p->at(0).get<float>(), p->at(1).get<float>()};
  return info;
}

}  // namespace

bool isLamp(const LayerInfo& layer) { return layer.kind != "sun" && layer.kind != "sky"; }

Result<std::vector<LayerInfo>> layersFromJson(std::string_view text, const std::string& where) {
  std::vector<LayerInfo> layers;
  std::string place = where;
  try {
    const Json json = Json::parse(text);
    if (json.at("version").get<int>() != kVersion)
      return Error{
          fmt::format("{}: is of version {}, this program reads {}", where, json.at("version").get<int>(), kVersion)};
    for (const Json& layer : json.at("layers")) {
      place = fmt::format("{}: layers[{}]", where, layers.size());
      layers.push_back(read(layer));
    }
  } catch (const std::exception& e) {
    std::string reason = e.what();  // the library's begin with "[json.exception...] "
    if (const size_t end = reason.find("] "); reason.starts_with("[json") && end != std::string::npos)
      reason.erase(0, end + 2);
    return Error{fmt::format("{}: {}", place, reason)};
  }
  return layers;
}

}  // namespace roomlight
