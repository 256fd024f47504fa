#include "report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace roomlight::report {
namespace {

constexpr const char* kPlot = "<div class=\"plot\"";  // its element's beginning

constexpr const char* kStyle = R"(
:root{--ink:#1d2530;--soft:#5d6876;--line:#dfe3e8;--paper:#fff;--good:#1a7f4b;--bad:#b3362b}
*{box-sizing:border-box}
body{margin:0;background:#f3f4f6;color:var(--ink);font:15px/1.5 "Helvetica Neue",Helvetica,Arial,"Liberation Sans",sans-serif}
main{max-width:1180px;margin:0 auto;background:var(--paper);padding:44px 56px 36px}
h1{font-size:30px;font-weight:600;margin:0 0 4px}
h2{font-size:21px;font-weight:600;margin:44px 0 8px;padding-top:18px;border-top:1px solid var(--line)}
table{border-collapse:collapse;margin:8px 0 4px;font-variant-numeric:tabular-nums;font-size:14px}
th{font-weight:600;font-size:12px;color:var(--soft);text-align:right;border-bottom:1px solid var(--ink);padding:4px 9px;vertical-align:bottom}
td{text-align:right;border-bottom:1px solid var(--line);padding:5px 9px}
th:first-child,td:first-child,td.l,th.l{text-align:left}th:first-child,td:first-child{padding-left:0}
h3{font-size:16px;font-weight:600;margin:24px 0 4px}
p{margin:4px 0 10px;max-width:78ch}p.soft,.soft{color:var(--soft);font-size:13.5px}
.wide{overflow-x:auto}
.met{color:var(--good);font-weight:600;white-space:nowrap}.missed{color:var(--bad);font-weight:600;white-space:nowrap}
svg text{font:12px "Helvetica Neue",Helvetica,Arial,"Liberation Sans",sans-serif;fill:var(--ink)}
footer{margin-top:36px;padding-top:14px;border-top:1px solid var(--line);color:var(--soft);font-size:12.5px}
@media print{body{background:#fff}main{padding:0;max-width:none}}
)";

// RFC 4648, with padding: what a data: URI takes.
std::string base64(std::span<const char> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t n = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) group = group << 8 | (k < n ? static_cast<uint8_t>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) out += k <= n ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      default: out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

std::string attribute(const char* name, const std::string& text) {
  return text.empty() ? "" : fmt::format(" {}=\"{}\"", name, escaped(text));
}

std::string page(const std::string& title, const std::string& style, const std::string& body,
                 const std::string& plots) {
  return plainPage(title, kStyle + style, "<main>\n" + body + "</main>", plots);
}

std::string plainPage(const std::string& title, const std::string& style, const std::string& body,
                      const std::string& plots) {
  const bool hasPlots = body.find(kPlot) != std::string::npos;
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width\"><title>" +
         escaped(title) + "</title>\n<style>" + style + "</style></head>\n<body>" + body + (hasPlots ? plots : "") +
         "</body></html>\n";
}

std::string plot(const std::string& kind, const std::string& label, const std::string& json) {
  std::string data;  // "<" stands in its texts alone, and could end the script
  for (const char c : json) data += c == '<' ? "\\u003c" : std::string(1, c);
  return fmt::format(
      "{} data-plot=\"{}\" role=\"group\"{}><p class=\"soft\">This plot needs scripts, which do not run here. Its "
      "numbers are in tables of this page.</p><script type=\"application/json\">{}</script></div>\n",
      kPlot, kind, attribute("aria-label", label), data);
}

std::string jpegPicture(const std::string& alt, std::span<const char> jpeg) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/jpeg;base64,{}\">", escaped(alt), base64(jpeg));
}

std::string figure(const std::string& content, const std::string& caption, const std::string& kind) {
  return "<figure" + attribute("class", kind) + ">" + content +
         (caption.empty() ? "" : "<figcaption>" + caption + "</figcaption>") + "</figure>";
}

}  // namespace roomlight::report
