// A study for programs (JSON, CSV) and for documents (Markdown).
#include <fmt/format.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "engine/settings.h"
#include "study/published.h"
#include "study/report.h"

namespace roomlight {
namespace {

using Json = nlohmann::ordered_json;

Json pointJson(const StudyPoint& p) {
  return {{"samples", p.samples},
          {"seconds", p.seconds},
          {"runs", p.runsS},
          {"processorSeconds", p.processorSeconds},
          {"memoryMiB", p.memoryMiB},
          {"mse", p.mse},
          {"mseBeyondNoise", p.mseBeyondNoise},
          {"flip", p.flip},
          {"meanErrorPercent", p.meanErrorPercent},
          {"picture", p.picture}};
}

Json curveJson(const StudyCurve& c) {
  Json j = {{"technique", c.technique}, {"kind", c.kind}, {"settled", hasSettled(c)}};
  if (!c.failed.empty()) j["failed"] = c.failed;
  j["points"] = Json::array();
  for (const StudyPoint& p : c.points) j["points"].push_back(pointJson(p));
  return j;
}

Json caseJson(const StudyCase& c) {
  Json j = {{"scene", c.scene}, {"light", c.light}, {"lighting", c.lighting}};
  j["reference"] = {{"pictures", {c.first.string(), c.second.string()}},
                    {"noiseMse", c.noiseMse},
                    {"seconds", c.referenceS},
                    {"samples", c.referenceSamples},
                    {"converged", c.referenceConverged}};
  j["curves"] = Json::array(), j["externals"] = Json::array();
  for (const StudyCurve& curve : c.curves) j["curves"].push_back(curveJson(curve));
  for (const StudyExternal& e : c.externals) {
    j["externals"].push_back({{"name", e.name},
                              {"seconds", e.seconds},
                              {"mse", e.mse},
                              {"mseBeyondNoise", e.mseBeyondNoise},
                              {"flip", e.flip},
                              {"meanErrorPercent", e.meanErrorPercent},
                              {"picture", e.picture}});
  }
  return j;
}

// RFC 4180.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

// A cell of a Markdown table.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c == '\n' ? ' ' : c);
  return out;
}

std::string secondsText(double s) { return s < 9.95 ? fmt::format("{:.2f}", s) : fmt::format("{:.1f}", s); }

std::string curvesTable(const StudyCase& c) {
  std::string s =
      "| technique | settles at mse | beyond noise | flip | mean | samples | s | processor s | MiB | s to cone's error "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n";
  const StudyCurve* cone = nullptr;
  for (const StudyCurve& curve : c.curves)
    cone = curve.technique == technique::kCone && !curve.points.empty() ? &curve : cone;
  for (const StudyCurve& curve : c.curves) {
    if (curve.points.empty()) {
      s += fmt::format("| {} | – | {} | | | | | | | |\n", cell(curve.technique), cell(curve.failed));
      continue;
    }
    const StudyPoint& p = settledPoint(curve);
    const auto same = cone ? secondsTo(curve, errorOf(settledPoint(*cone))) : std::nullopt;
    s +=
        fmt::format("| {}{} | {:.5f} | {:.5f} | {:.3f} | {:+.1f} % | {} | {} | {} | {:.0f} | {} |\n",
                    cell(curve.technique), hasSettled(curve) ? "" : " (still falling)", p.mse, p.mseBeyondNoise, p.flip,
                    p.meanErrorPercent, p.samples, secondsText(p.seconds), secondsText(p.processorSeconds), p.memoryMiB,
                    same   ? secondsText(*same)
                    : cone ? "not reached"
                           : "");
  }
  for (const StudyExternal& e : c.externals) {
    s += fmt::format("| {} (external) | {:.5f} | {:.5f} | {:.3f} | {:+.1f} % | | {} | | | |\n", cell(e.name), e.mse,
                     e.mseBeyondNoise, e.flip, e.meanErrorPercent, secondsText(e.seconds));
  }
  return s;
}

// Rows: scenes in their lights; columns: techniques; seconds until the error has settled.
std::string drawingTimes(const StudyResults& r) {
  if (r.cases.empty()) return {};
  std::string head = "| scene, light |", rule = "|---|", s;
  for (const StudyCurve& c : r.cases.front().curves) head += fmt::format(" {} |", cell(c.technique)), rule += "---|";
  for (const StudyCase& c : r.cases) {
    s += fmt::format("| {}, {} |", cell(c.scene), cell(c.light));
    for (const StudyCurve& curve : c.curves)
      s += curve.points.empty()
               ? " – |"
               : fmt::format(" {}{} |", hasSettled(curve) ? "" : "> ", secondsText(settledPoint(curve).seconds));
    s += "\n";
  }
  return head + "\n" + rule + "\n" + s;
}

std::string publishedTimes() {
  std::string s = "\n| published scene | cone | vxgi | lpv | photon |\n|---|---|---|---|---|\n";
  for (size_t i = 0; i < 6; ++i) {
    s += fmt::format("| {} |", i + 1);
    for (const auto& t : published::kTechniques) s += fmt::format(" {:.1f} |", t.drawingS[i]);
    s += "\n";
  }
  return s;
}

// Of one technique over each rival, at the least error that both reach.
std::string timeRatios(const StudyResults& r, const std::string& technique) {
  std::string head, s;
  for (const StudyCase& c : r.cases) {
    const auto own = std::find_if(c.curves.begin(), c.curves.end(), [&](const StudyCurve& curve) {
      return curve.technique == technique && !curve.points.empty();
    });
    if (own == c.curves.end()) continue;
    std::string names = fmt::format("| `{}` over |", cell(technique)), line = "|---|",
                row = fmt::format("| {}, {} |", cell(c.scene), cell(c.light));
    for (const StudyCurve& other : c.curves) {
      if (other.kind != "rival") continue;
      const auto ratio = timeRatioAtEqualError(*own, other);
      names += fmt::format(" {} |", cell(other.technique)), line += "---|",
          row += ratio ? fmt::format(" {:.2f} |", *ratio) : " – |";
    }
    if (head.empty()) head = names + "\n" + line + "\n";
    s += row + "\n";
  }
  return head + s;
}

std::string framesTable(const StudyResults& r) {
  std::string s =
      "| scene | light | technique | frames a second | update ms | picture ms | frames "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const StudyFrames& f : r.frames) {
    s += fmt::format("| {} | {} | {} |", cell(f.scene), cell(f.light), cell(f.technique));
    s += f.runs.empty() ? fmt::format(" – | {} | | |\n", cell(f.failed))
                        : fmt::format(" {:.2f} | {:.0f} | {:.0f} | {} |\n", f.cost.framesPerSecond, f.cost.updateMs,
                                      f.cost.pictureMs, f.cost.frames);
  }
  return s;
}

// Techniques apart: their names are the plan's, and may be those of other rows.
Json aboutJson(const StudyHeader& header) {
  Json j = Json::object(), techniques = Json::object();
  for (const auto& [name, value] : header.about) j[name] = value;
  for (const auto& [name, value] : header.techniques) techniques[name] = value;
  j["techniques"] = techniques;
  return j;
}

}  // namespace

std::string studyJson(const StudyHeader& header, const StudyResults& r) {
  Json j;
  j["about"] = aboutJson(header);
  j["complete"] = r.complete;
  if (r.againstPublished) j["verdicts"] = Json::array();
  j["cases"] = Json::array(), j["frames"] = Json::array();
  for (const StudyVerdict& v : studyVerdicts(r))
    j["verdicts"].push_back({{"asked", v.asked}, {"measured", v.measured}, {"met", v.met}});
  for (const StudyCase& c : r.cases) j["cases"].push_back(caseJson(c));
  for (const StudyFrames& f : r.frames) {
    j["frames"].push_back({{"scene", f.scene},
                           {"light", f.light},
                           {"technique", f.technique},
                           {"framesPerSecond", f.cost.framesPerSecond},
                           {"frames", f.cost.frames},
                           {"updateMs", f.cost.updateMs},
                           {"pictureMs", f.cost.pictureMs},
                           {"runs", f.runs.size()},
                           {"failed", f.failed}});
  }
  for (const auto& t : published::kTechniques) {
    if (!r.againstPublished) break;
    j["published"].push_back({{"technique", t.name},
                              {"drawingSeconds", t.drawingS},
                              {"settledMse", t.settledMse},
                              {"framesPerSecond", t.framesPerSecond}});
  }
  j["remarks"] = r.remarks;
  return j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string studyCsv(const StudyResults& r) {
  std::string s =
      "kind,scene,light,technique,samples,seconds,processorSeconds,memoryMiB,mse,mseBeyondNoise,flip,meanErrorPercent,"
      "framesPerSecond\r\n";
  for (const StudyCase& c : r.cases) {
    const std::string place = quoted(c.scene) + "," + quoted(c.light);
    for (const StudyCurve& curve : c.curves) {
      for (const StudyPoint& p : curve.points) {
        s += fmt::format("point,{},{},{},{:.4f},{:.4f},{:.1f},{:.7f},{:.7f},{:.5f},{:.3f},\r\n", place,
                         quoted(curve.technique), p.samples, p.seconds, p.processorSeconds, p.memoryMiB, p.mse,
                         p.mseBeyondNoise, p.flip, p.meanErrorPercent);
      }
    }
    for (const StudyExternal& e : c.externals)
      s += fmt::format("external,{},{},,{:.4f},,,{:.7f},{:.7f},{:.5f},{:.3f},\r\n", place, quoted(e.name), e.seconds,
                       e.mse, e.mseBeyondNoise, e.flip, e.meanErrorPercent);
  }
  for (const StudyFrames& f : r.frames) {
    if (!f.runs.empty())
      s += fmt::format("walk,{},{},{},,,,,,,,,{:.4f}\r\n", quoted(f.scene), quoted(f.light), quoted(f.technique),
                       f.cost.framesPerSecond);
  }
  return s;
}

std::string studyMarkdown(const StudyHeader& header, const StudyResults& r) {
  std::string s = "# Study of techniques\n\nMade by `roomlight study`";
  for (const auto* rows : {&header.about, &header.techniques}) {
    for (const auto& [name, value] : *rows) s += fmt::format("; {}: {}", name, value);
  }
  s += fmt::format(".{}\n", r.complete ? "" : " Stopped early: what follows is a part.");
  if (r.againstPublished) s += "\n## Asked\n\n| asked | measured | |\n|---|---|---|\n";
  for (const StudyVerdict& v : studyVerdicts(r))
    s += fmt::format("| {} | {} | {} |\n", cell(v.asked), cell(v.measured), v.met ? "met" : "missed");
  s += fmt::format("\n## Seconds until the error settles{}\n\n",
                   r.againstPublished ? " (Table 1 of the published study)" : "") +
       drawingTimes(r);
  s += "\n`>`: stopped by time or samples while the error still fell.\n";
  if (r.againstPublished) s += publishedTimes();
  for (const char* own : {technique::kCone, technique::kHybrid}) {
    if (const std::string ratios = timeRatios(r, own); !ratios.empty())
      s += fmt::format(
               "\n## Time at equal error, {}\n\nSeconds over those of the other, at the least error that both "
               "reach.\n\n",
               own) +
           ratios;
  }
  if (!r.frames.empty())
    s += fmt::format("\n## Frames a second along a walk{}\n\n", r.againstPublished ? " (Fig. 3)" : "") + framesTable(r);
  if (!r.frames.empty() && r.againstPublished) s += "\nPublished: cone 36, vxgi 28, lpv 23, photon 7.\n";
  s += r.againstPublished ? "\n## Where each settles (Fig. 2 and memory)\n\nPublished: cone .0034, vxgi .0051, lpv "
                            ".0085, photon .0105.\n"
                          : "\n## Where each settles, and memory\n";
  for (const StudyCase& c : r.cases) {
    s += fmt::format("\n### {}, {}\n\nReference: {:.0f} samples a pixel, {:.0f} s, noise {:.6f}{}.\n\n", c.scene,
                     c.light, c.referenceSamples, c.referenceS, c.noiseMse,
                     c.referenceConverged ? "" : " (not down to what was asked)") +
         curvesTable(c);
  }
  for (const std::string& remark : r.remarks) s += "\n- " + remark;
  return s + "\n";
}

}  // namespace roomlight
