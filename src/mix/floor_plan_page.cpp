#include <fmt/format.h>

#include "mix/floor_plan.h"
#include "report/page.h"

namespace roomlight {
namespace {

constexpr const char* kStyle = R"(
body { margin: 0; background: #222; color: #eee; font: 15px system-ui, sans-serif; }
.plan { position: relative; isolation: isolate; max-width: 100%; margin: 0 auto; }
.plan img { position: absolute; left: 0; top: 0; width: 100%; height: 100%; }
.plan .light { opacity: 0; pointer-events: none; transition: opacity 0.3s; }
.plan button { position: absolute; width: 28px; height: 28px; margin: -14px; padding: 0; border: 2px solid #fff; border-radius: 50%; background: #0008; cursor: pointer; }
.plan button.on { background: #ffd97a; }
ul { list-style: none; display: grid; grid-template-columns: repeat(auto-fill, minmax(260px, 1fr)); gap: 8px; max-width: 1200px; margin: 16px auto; padding: 0 16px; }
li { display: flex; gap: 8px; align-items: center; }
li span { flex: 1; }
)";

// Opacities between steps of 10 % lie on straight lines.
constexpr const char* kScript = R"(
function show(light) {
  const steps = JSON.parse(light.dataset.steps), row = document.getElementById('row-' + light.id);
  const on = row.querySelector('[type=checkbox]').checked, level = on ? row.querySelector('[type=range]').value / 10 : 0;
  const low = Math.min(9, Math.floor(level));
  light.style.opacity = steps[low] + (steps[low + 1] - steps[low]) * (level - low);
  const spot = document.getElementById('spot-' + light.id);
  if (spot) spot.classList.toggle('on', on);
}
for (const light of document.querySelectorAll('.light')) {
  const row = document.getElementById('row-' + light.id), box = row.querySelector('[type=checkbox]'), spot = document.getElementById('spot-' + light.id);
  row.addEventListener('input', () => show(light));
  if (spot) spot.addEventListener('click', () => { box.checked = !box.checked; show(light); });
  show(light);
}
)";

}  // namespace

std::string pageOf(const FloorPlan& plan) {
  std::string pictures, spots, rows;
  for (size_t i = 0; i < plan.lamps.size(); ++i) {
    const PlanLamp& lamp = plan.lamps[i];
    std::string steps;
    for (const float o : lamp.opacities) steps += fmt::format("{}{:.3f}", steps.empty() ? "" : ",", o);
    pictures +=
        fmt::format("<img class=\"light\" id=\"l{}\" src=\"{}\" alt=\"\" data-steps=\"[{}]\">\n", i, lamp.file, steps);
    if (lamp.pixel) {
      spots += fmt::format("<button id=\"spot-l{}\" title=\"{}\" style=\"left: {:.2f}%; top: {:.2f}%\"></button>\n", i,
                           report::escaped(lamp.name), lamp.pixel->x * 100, lamp.pixel->y * 100);
    }
    rows += fmt::format(
        "<li id=\"row-l{}\"><label><input type=\"checkbox\"></label><span>{}</span><input type=\"range\" min=\"1\" "
        "max=\"100\" value=\"100\"></li>\n",
        i, report::escaped(lamp.name));
  }
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>Lamps</title>\n<style>{0}"
      ".plan {{ aspect-ratio: {1} / {2}; width: min(100%, calc(80vh * {1} / {2})); }}\n.plan .light {{ mix-blend-mode: "
      "{3}; }}\n</style></head>\n<body>\n"
      "<div class=\"plan\">\n<img src=\"{4}\" alt=\"The home with these lamps "
      "off\">\n{5}{6}</div>\n<ul>\n{7}</ul>\n<script>{8}</script>\n</body></html>\n",
      kStyle, plan.width, plan.height, cssName(plan.blend), plan.baseFile, pictures, spots, rows, kScript);
}

}  // namespace roomlight
