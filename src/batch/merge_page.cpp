#include <fmt/format.h>

#include "batch/merge.h"
#include "report/page.h"
#include "report/table.h"

namespace roomlight::batch {
namespace {

using report::escaped;

std::string link(const std::string& file) {
  return file.empty() ? "" : fmt::format("<a href=\"{0}\">{0}</a>", escaped(file));
}

std::string meansHtml(const std::vector<SeedMean>& means) {
  if (means.empty()) return {};
  report::Table table({"", "seeds", "standard error, % of the mean luminance", "<mean", "<error by pixel"});
  for (const SeedMean& m : means)
    table.row({escaped(m.group), m.seeds, report::fixed(100 * m.standardError, 3), link(m.mean), link(m.error)});
  return "<h2>Means of seeds</h2>" + table.wideHtml();
}

std::string sheetsHtml(const std::vector<Sheet>& sheets) {
  std::string out;
  for (const Sheet& s : sheets)
    out += report::figure(
        fmt::format("<a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"></a>", escaped(s.file), escaped(s.title)),
        fmt::format("{}: {} pictures", escaped(s.title), s.pictures));
  return out.empty() ? out : "<h2>Pictures</h2>" + out;
}

std::string filmsHtml(const std::vector<Film>& films) {
  std::string out;
  for (const Film& f : films) {
    const std::string name = fmt::format("{}: {} frames", escaped(f.group), f.frames);
    out += f.file.empty() ? fmt::format("<p>{}, not made into a film, for want of ffmpeg: <code>{}</code></p>", name,
                                        escaped(f.command))
                          : report::figure(fmt::format("<video src=\"{}\" controls></video>", escaped(f.file)), name);
  }
  return out.empty() ? out : "<h2>Films</h2>" + out;
}

std::string wholesHtml(const std::vector<Whole>& wholes) {
  if (wholes.empty()) return {};
  report::Table table({"", "<result", "<how to go on"});
  for (const Whole& w : wholes) {
    const std::string note = w.missing.empty() ? "" : escaped(w.missing);
    const std::string command = w.command.empty() ? "" : "<code>" + escaped(w.command) + "</code>";
    table.row({escaped(w.group), link(w.file), command + note});
  }
  return "<h2>Studies and designs</h2>" + table.wideHtml();
}

std::string failuresHtml(const Merged& merged) {
  std::string out;
  if (!merged.failures.empty()) {
    report::Table table({"", "<why"});
    for (const auto& [task, line] : merged.failures) table.row({escaped(task), escaped(line)});
    out += "<h2>Failed</h2>" + table.wideHtml();
  }
  if (merged.remarks.empty()) return out;
  out += "<h2>Left out</h2>";
  for (const std::string& remark : merged.remarks) out += "<p>" + escaped(remark) + "</p>";
  return out;
}

}  // namespace

std::string mergedPage(const TaskList& list, const Merged& m) {
  std::string body = fmt::format("<h1>{}</h1>", escaped(list.info().name));
  std::vector<std::pair<std::string, std::string>> facts = {
      {"tasks", fmt::format("{} of {} done, {} failed", m.done, m.tasks, m.failed)},
      {"work", fmt::format("{:.1f} h", m.workSeconds / 3600)},
      {"program", "roomlight " + list.info().version},
      {"plan", list.info().file}};
  body += report::factsHtml(facts);
  body +=
      "<p>All figures: " + link("figures.csv") + (m.hasReadings ? "; readings: " + link("readings.csv") : "") + "</p>";
  body += meansHtml(m.means) + sheetsHtml(m.sheets) + filmsHtml(m.films) + wholesHtml(m.wholes) + failuresHtml(m);
  return report::page(list.info().name, "img,video{max-width:100%}", body);
}

}  // namespace roomlight::batch
