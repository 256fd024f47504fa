#include "validate/validation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "report/page.h"
#include "report/table.h"

namespace roomlight {
namespace {

using report::Cell, report::escaped, report::Table;

constexpr const char* kStyle =
    R"(body{font:15px/1.5 system-ui,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222}
h1{font-weight:600}h2{margin-top:2.2rem;font-size:1.15rem}
table{border-collapse:collapse;width:100%;font-size:.88rem}th,td{padding:.25rem .6rem;text-align:right;border-bottom:1px solid #ddd}
td{white-space:nowrap}th:first-child,td:first-child{text-align:left;white-space:normal}th{color:#555;font-weight:600}
.pass{color:#0a6b3d}.fail{color:#b00020;font-weight:700}.basis{color:#666;font-size:.85rem;margin:.2rem 0 .6rem})";

std::string verdict(bool pass) { return pass ? "<span class='pass'>met</span>" : "<span class='fail'>missed</span>"; }

// Error of every value, a row a technique.
std::string dots(const Validation& v) {
  nlohmann::json rows = nlohmann::json::array();
  for (const ValidationSummary& s : v.techniques) {
    nlohmann::json values = nlohmann::json::array();
    for (const ValidationRow& r : v.rows) {
      if (r.technique != s.technique || r.errorUnit != "%") continue;
      values.push_back(
          {{"text", fmt::format("{}, {}: {:+.2f} %", r.name, r.place, r.error)}, {"error", r.error}, {"met", r.pass}});
    }
    rows.push_back({{"name", s.technique}, {"allowed", s.allowedPercent}, {"values", values}});
  }
  return report::plot("errors", "Error of every value by technique", nlohmann::json{{"rows", rows}}.dump());
}

// Rows of one case: a line a place, beside each other what the techniques found.
std::string caseTable(std::span<const ValidationRow> rows) {
  Table table({"place", "expected"});
  size_t places = 0;
  while (places < rows.size() && rows[places].technique == rows[0].technique) ++places;
  for (size_t i = 0; i < rows.size(); i += places) {
    for (const std::string& head : {rows[i].technique, std::string("error"), std::string()}) table.column(head);
  }
  for (size_t p = 0; p < places; ++p) {
    std::vector<Cell>& cells = table.row({escaped(rows[p].place), fmt::format("{:.5g}", rows[p].expected)});
    for (size_t i = p; i < rows.size(); i += places)
      cells.insert(cells.end(), {fmt::format("{:.5g}", rows[i].got),
                                 fmt::format("{:+.2f} {}", rows[i].error, rows[i].errorUnit), verdict(rows[i].pass)});
  }
  return table.html();
}

std::string tables(const Validation& v) {
  std::string out;
  for (size_t i = 0, end = 0; i < v.rows.size(); i = end) {
    const ValidationRow& first = v.rows[i];
    while (end < v.rows.size() && v.rows[end].name == first.name) ++end;
    out += fmt::format("<h2>{}: {}</h2><p class=\"basis\">Expected: {}. In {}.</p>", escaped(first.name),
                       escaped(first.title), escaped(first.basis), escaped(first.unit)) +
           caseTable(std::span(v.rows).subspan(i, end - i));
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

std::string validationHtml(const Validation& v, const std::string& version, const std::string& plots) {
  Table summary({"technique", "allowed", "places met", "largest error", "where", ""});
  for (const ValidationSummary& s : v.techniques)
    summary.row({s.technique, fmt::format("{:g} %", s.allowedPercent), fmt::format("{} of {}", s.passed, s.places),
                 fmt::format("{:+.2f} %", s.worstPercent), escaped(s.worstPlace), verdict(s.passed == s.places)});
  return report::plainPage(
      "roomlight: validation", kStyle,
      "<h1>Validation of roomlight " + escaped(version) +
          "</h1><p>Light meters in scenes whose light is known. Expected values are integrated numerically, apart from "
          "the program's own light. Allowed is 1 % at each place for <i>path</i>, 3 % for <i>hybrid</i>, and for "
          "<i>cone</i> 10 % of the sum over a case; of glare ratings half a unit.</p>" +
          summary.html() + dots(v) + tables(v),
      plots);
}

}  // namespace roomlight
