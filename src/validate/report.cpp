#include "validate/validation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/html.h"

namespace roomlight {
namespace {

constexpr const char* kStyle =
    R"(body{font:15px/1.5 system-ui,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222}
h1{font-weight:600}h2{margin-top:2.2rem;font-size:1.15rem}
table{border-collapse:collapse;width:100%;font-size:.88rem}th,td{padding:.25rem .6rem;text-align:right;border-bottom:1px solid #ddd}
td{white-space:nowrap}th:first-child,td:first-child{text-align:left;white-space:normal}th{color:#555;font-weight:600}
.pass{color:#0a6b3d}.fail{color:#b00020;font-weight:700}.basis{color:#666;font-size:.85rem;margin:.2rem 0 .6rem}svg{max-width:100%;height:auto})";

std::string verdict(bool pass) { return pass ? "<span class=pass>met</span>" : "<span class=fail>missed</span>"; }

// Error of every value, a row a technique: what lies within the band is allowed.
std::string dots(const Validation& v) {
  constexpr double kWidth = 900, kLeft = 80, kRow = 46, kMost = 12;  // per cent
  const double height = kRow * static_cast<double>(v.techniques.size()) + 30;
  const auto x = [&](double percent) {
    return kLeft + (kWidth - kLeft - 20) * (std::clamp(percent, -kMost, kMost) + kMost) / (2 * kMost);
  };
  std::string out =
      fmt::format("<svg viewBox='0 0 {} {}' role=img aria-label='Error of every value by technique'>", kWidth, height);
  for (size_t t = 0; t < v.techniques.size(); ++t) {
    const ValidationSummary& s = v.techniques[t];
    const double y = kRow * static_cast<double>(t) + kRow / 2, low = x(-s.allowedPercent), high = x(s.allowedPercent);
    out += fmt::format(
        "<text x='0' y='{:.0f}' font-size='14'>{}</text><rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{}' "
        "fill='#e4f2ea'/>",
        y + 5, s.technique, low, y - 16, high - low, 32);
    size_t k = 0;
    for (const ValidationRow& r : v.rows) {
      if (r.technique != s.technique || r.errorUnit != "%") continue;
      out += fmt::format(
          "<circle cx='{:.1f}' cy='{:.1f}' r='3' fill='{}' fill-opacity='.6'><title>{}, {}: {:+.2f} "
          "{}</title></circle>",
          x(r.error), y + static_cast<double>(k++ % 7) * 4 - 12, r.pass ? "#0a6b3d" : "#b00020", htmlEscaped(r.name),
          htmlEscaped(r.place), r.error, r.errorUnit);
    }
  }
  for (int p = -10; p <= 10; p += 5)
    out += fmt::format("<text x='{:.1f}' y='{:.0f}' font-size='12' text-anchor='middle' fill='#555'>{}{} %</text>",
                       x(p), height - 6, p > 0 ? "+" : "", p);
  return out + "</svg>";
}

std::string tables(const Validation& v) {
  std::string out;
  const auto sameCase = [](const ValidationRow& a, const ValidationRow& b) { return a.name == b.name; };
  for (size_t i = 0; i < v.rows.size();) {
    const ValidationRow& first = v.rows[i];
    std::vector<const ValidationRow*> rows;
    for (; i < v.rows.size() && sameCase(v.rows[i], first); ++i) rows.push_back(&v.rows[i]);
    out += fmt::format("<h2>{}: {}</h2><p class=basis>Expected: {}. In {}.</p><table><tr><th>place<th>expected",
                       htmlEscaped(first.name), htmlEscaped(first.title), htmlEscaped(first.basis),
                       htmlEscaped(first.unit));
    std::vector<std::string> techniques;
    for (const ValidationRow* r : rows) {
      if (std::find(techniques.begin(), techniques.end(), r->technique) == techniques.end())
        techniques.push_back(r->technique);
    }
    for (const std::string& t : techniques) out += fmt::format("<th>{}<th>error<th>", t);
    out += "</tr>";
    const size_t places = rows.size() / techniques.size();
    for (size_t p = 0; p < places; ++p) {
      out += fmt::format("<tr><td>{}<td>{:.5g}", htmlEscaped(rows[p]->place), rows[p]->expected);
      for (size_t t = 0; t < techniques.size(); ++t) {
        const ValidationRow& r = *rows[t * places + p];
        out += fmt::format("<td>{:.5g}<td>{:+.2f} {}<td>{}", r.got, r.error, r.errorUnit, verdict(r.pass));
      }
      out += "</tr>";
    }
    out += "</table>";
  }
  return out;
}

}  // namespace

std::string validationJson(const Validation& v) {
  nlohmann::ordered_json json;
  json["pass"] = v.pass();
  json["complete"] = v.complete;
  for (const ValidationSummary& s : v.techniques) {
    json["techniques"].push_back({{"technique", s.technique},
                                  {"allowedPercent", s.allowedPercent},
                                  {"worstPercent", s.worstPercent},
                                  {"worstPlace", s.worstPlace},
                                  {"passed", s.passed},
                                  {"places", s.places}});
  }
  for (const ValidationRow& r : v.rows) {
    json["rows"].push_back({{"case", r.name},
                            {"title", r.title},
                            {"unit", r.unit},
                            {"basis", r.basis},
                            {"place", r.place},
                            {"technique", r.technique},
                            {"expected", r.expected},
                            {"got", r.got},
                            {"error", r.error},
                            {"errorUnit", r.errorUnit},
                            {"pass", r.pass}});
  }
  return json.dump(1) + "\n";
}

std::string validationHtml(const Validation& v, const std::string& version) {
  std::string out = fmt::format(
      "<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport "
      "content='width=device-width'><title>roomlight: validation</title><style>{}</style><h1>Validation of roomlight "
      "{}</h1>",
      kStyle, htmlEscaped(version));
  out +=
      "<p>Light meters in scenes whose light is known. Expected values are integrated numerically, apart from the "
      "program's own light. Allowed is 1 % at each place for <i>path</i>, 3 % for <i>hybrid</i>, and for <i>cone</i> "
      "10 % of the sum over a case; of glare ratings half a unit.</p>";
  out += "<table><tr><th>technique<th>allowed<th>places met<th>largest error<th>where<th></tr>";
  for (const ValidationSummary& s : v.techniques) {
    out += fmt::format("<tr><td>{}<td>{:g} %<td>{} of {}<td>{:+.2f} %<td>{}<td>{}</tr>", s.technique, s.allowedPercent,
                       s.passed, s.places, s.worstPercent, htmlEscaped(s.worstPlace), verdict(s.passed == s.places));
  }
  return out + "</table>" + dots(v) + tables(v) + "</html>\n";
}

}  // namespace roomlight
