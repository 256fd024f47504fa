#include "mix/floor_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace roomlight {
namespace {

using Json = nlohmann::ordered_json;

std::string dump(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

// Letters of Latin-1 (U+00C0 to U+00FF, in UTF-8 the byte 0xC3 and one from 0x80) without their marks; ? where there is
// no such letter.
constexpr std::string_view kPlainLatin = "aaaaaaaceeeeiiiidnooooo?ouuuuy?saaaaaaaceeeeiiiidnooooo?ouuuuy?y";

// Double-quoted YAML takes JSON's strings as they are.
std::string quoted(const std::string& text) { return dump(Json(text)); }

// light.sofa and switch.sofa are two things.
std::string sensorOf(const PlanLamp& lamp) {
  std::string id = lamp.entity;
  std::replace(id.begin(), id.end(), '.', '_');
  return fmt::format("sensor.{}_level", id);
}

std::string percent(float share) { return fmt::format("{:.2f}%", 100 * static_cast<double>(share)); }

std::string filterRows(const PlanLamp& lamp, bool dimmed) {
  const auto row = [](const std::string& state, float opacity) {
    return fmt::format("      \"{}\": opacity({:.0f}%)\n", state, 100 * static_cast<double>(opacity));
  };
  std::string rows;
  if (dimmed) {
    for (size_t step = 0; step <= 10; ++step) rows += row(std::to_string(10 * step), lamp.opacities[step]);
  } else {
    rows += row("on", 1) + row("off", 0);
  }
  // A state without a row would show the overlay in grey.
  return rows + row("unavailable", 0) + row("unknown", 0);
}

}  // namespace

std::string slugOf(std::string_view name) {
  std::string slug;
  for (size_t i = 0; i < name.size(); ++i) {
    auto c = static_cast<unsigned char>(name[i]);
    if (c == 0xc3 && i + 1 < name.size()) {
      const auto next = static_cast<unsigned char>(name[++i]);
      c = next >= 0x80 && next <= 0xbf ? static_cast<unsigned char>(kPlainLatin[next - 0x80u]) : '?';
      if (next == 0x9f) slug += 's';  // ß
    }
    if (c < 0x80 && std::isalnum(c)) {
      slug += static_cast<char>(std::tolower(c));
    } else if (!slug.empty() && slug.back() != '_') {
      slug += '_';
    }
  }
  while (!slug.empty() && slug.back() == '_') slug.pop_back();
  return slug.empty() ? "lamp" : slug;
}

FloorPlan planOf(const std::vector<LayerInfo>& layers, const Switches& switches,
                 const std::map<size_t, std::string>& entities, const std::string& extension) {
  FloorPlan plan;
  plan.baseFile = "base" + extension;
  std::set<std::string> taken = {"base"};
  for (const size_t layer : switches.lamps) {
    const std::string wanted = slugOf(layers[layer].name);
    std::string slug = wanted;
    for (int n = 2; !taken.insert(slug).second; ++n) slug = fmt::format("{}_{}", wanted, n);
    const auto entity = entities.find(layer);
    plan.lamps.push_back({layers[layer].name,
                          slug + extension,
                          entity == entities.end() ? "light." + slug : entity->second,
                          layers[layer].pixel,
                          {}});
  }
  return plan;
}

std::string cardOf(const FloorPlan& plan, const std::string& urlPrefix, bool dimmed) {
  std::string yaml =
      "# A card of Home Assistant (type: picture-elements), made by roomlight mix. Its pictures are served from the "
      "folder config/www.\n";
  yaml += fmt::format("type: picture-elements\nimage: {}\nelements:\n", quoted(urlPrefix + plan.baseFile));
  for (const PlanLamp& lamp : plan.lamps) {
    yaml += fmt::format(
        "  - type: image\n    entity: {}\n    image: {}\n    state_filter:\n{}    tap_action:\n      action: none\n    "
        "style:\n      left: 50%\n      top: 50%\n      width: 100%\n"
        "      mix-blend-mode: {}\n      pointer-events: none\n",
        dimmed ? sensorOf(lamp) : lamp.entity, quoted(urlPrefix + lamp.file), filterRows(lamp, dimmed),
        cssName(plan.blend));
  }
  // Lamps that the picture does not show stand in a row at its foot.
  const auto unseen = static_cast<float>(
      std::count_if(plan.lamps.begin(), plan.lamps.end(), [](const PlanLamp& l) { return !l.pixel; }));
  float next = 0.5f;
  for (const PlanLamp& lamp : plan.lamps) {
    const Vec2 at = lamp.pixel ? *lamp.pixel : Vec2{next++ / unseen, 0.95f};
    yaml += fmt::format(
        "  - type: state-icon\n    entity: {}\n    title: {}\n    tap_action:\n      action: toggle\n    "
        "hold_action:\n      action: more-info\n    style:\n      left: {}\n      top: {}\n",
        lamp.entity, quoted(lamp.name), percent(at.x), percent(at.y));
  }
  return yaml;
}

std::string sensorsOf(const FloorPlan& plan) {
  std::string yaml =
      "# For configuration.yaml of Home Assistant: how bright each lamp is, in steps of 10 %. Made by roomlight "
      "mix.\ntemplate:\n  - sensor:\n";
  std::set<std::string> declared;  // lamps may share an entity
  for (const PlanLamp& lamp : plan.lamps) {
    if (!declared.insert(lamp.entity).second) continue;
    const std::string id = sensorOf(lamp).substr(std::string_view("sensor.").size());
    yaml += fmt::format("      - name: {0}\n        unique_id: {0}\n", quoted(id));
    yaml += fmt::format(
        "        state: \"{{{{ [10, (((state_attr('{0}', 'brightness') or 255) / 25.5) | round(0) * 10) | int] | max "
        "if is_state('{0}', 'on') else 0 }}}}\"\n",
        lamp.entity);
  }
  return yaml;
}

std::string overlayIndexOf(const FloorPlan& plan, const OverlayTrial& trial) {
  Json index = {{"version", 1},
                {"width", plan.width},
                {"height", plan.height},
                {"base", plan.baseFile},
                {"mixBlendMode", cssName(plan.blend)}};
  for (size_t i = 0; i < kBlendModes.size(); ++i) {
    const BlendError& e = trial.errors[i];
    index["errorInDisplaySteps"][std::string(cssName(kBlendModes[i]))] = {
        {"mean", e.mean}, {"rms", e.rms}, {"percentile99", e.percentile99}};
  }
  index["overlays"] = Json::array();
  for (const PlanLamp& lamp : plan.lamps) {
    Json overlay = {
        {"name", lamp.name}, {"file", lamp.file}, {"entity", lamp.entity}, {"opacityPerTenPercent", lamp.opacities}};
    overlay["pixel"] = lamp.pixel ? Json{lamp.pixel->x, lamp.pixel->y} : Json();
    index["overlays"].push_back(overlay);
  }
  return dump(index, 1) + "\n";
}

}  // namespace roomlight
