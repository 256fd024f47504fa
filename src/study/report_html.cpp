// A study for people: one page on its own.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include "engine/settings.h"
#include "base/image_io.h"
#include "base/tone.h"
#include "compare/compare.h"
#include "report/page.h"
#include "report/table.h"
#include "study/report.h"
#include "study/published.h"

namespace roomlight {
namespace {

using report::Cell, report::escaped, report::fixed, report::Table;

constexpr size_t kPictureBytes = 22'000, kDifferenceBytes = 12'000;
constexpr int kWidestPicture = 480;

constexpr const char* kStyle = R"(
td.best{font-weight:700}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(440px,1fr));gap:14px 30px}
.plots h3{margin:12px 0 0}
.bars table{width:100%}.bars td{border:0;padding:3px 9px 3px 0;white-space:nowrap}td.bar{position:relative;width:75%;padding:0}
.bar div{height:17px;min-width:1px;print-color-adjust:exact}.bar i{position:absolute;top:1px;bottom:1px;border-left:2px solid #111}
.sheet{display:grid;grid-template-columns:repeat(auto-fill,minmax(210px,1fr));gap:12px;margin:8px 0 6px}
.sheet figure{margin:0}.sheet img{width:100%;display:block}.sheet img+img{margin-top:2px}
.sheet figcaption{font-size:12.5px;line-height:1.35;margin-top:3px}.sheet figcaption span{color:var(--soft)}
details{margin:6px 0}summary{cursor:pointer}
)";

std::string seconds(double s) { return s < 9.95 ? fixed(s, 2) : fixed(s, 0); }

// Half as wide as long as that is wide enough.
Image smaller(Image image) {
  while (image.width > kWidestPicture && image.width % 2 == 0 && image.height % 2 == 0) {
    Image half(image.width / 2, image.height / 2);
    for (int y = 0; y < half.height; ++y) {
      for (int x = 0; x < half.width; ++x)
        half.at(x, y) = (image.at(2 * x, 2 * y) + image.at(2 * x + 1, 2 * y) + image.at(2 * x, 2 * y + 1) +
                         image.at(2 * x + 1, 2 * y + 1)) *
                        0.25f;
    }
    image = std::move(half);
  }
  return image;
}

// Pictures of one case: read once, shown with the exposure of its reference.
class Sheet {
 public:
  Sheet(const StudyCase& c, std::filesystem::path folder) : case_(c), folder_(std::move(folder)) {}

  Result<std::string> html() {
    const Result<Image> first = readImage(folder_ / case_.first), second = readImage(folder_ / case_.second);
    if (!first) return Error{first.error()};
    if (!second) return Error{second.error()};
    reference_ = meanOf(first.value(), second.value());
    ev100_ = automaticEv100(reference_);
    Result<std::string> all =
        figure("reference", fmt::format("{:.0f} samples a pixel", case_.referenceSamples), reference_, false);
    for (const StudyCurve& c : case_.curves) {
      if (c.points.empty()) continue;
      const StudyPoint& p = settledPoint(c);
      add(all, c.technique, p.seconds, errorOf(p), p.meanErrorPercent, p.picture);
    }
    for (const StudyExternal& e : case_.externals)
      add(all, e.name, e.seconds, e.mseBeyondNoise, e.meanErrorPercent, e.picture);
    if (!all) return all;
    return "<div class=\"sheet\">" + all.value() + "</div>\n";
  }

 private:
  // An element with the picture, and the file it was written to.
  Result<std::string> embedded(const std::string& name, const std::string& alt, const Image& encoded,
                               size_t bytes) const {
    const std::filesystem::path file = folder_ / (fileNameOf(name) + ".jpg");
    if (const Status s = writeJpeg(file, smaller(encoded), bytes); !s) return Error{s.error()};
    std::ifstream in(file, std::ios::binary);
    const std::vector<char> content{std::istreambuf_iterator<char>(in), {}};
    return report::jpegPicture(alt, content);
  }
  // One more picture, unless something went wrong before it.
  void add(Result<std::string>& all, const std::string& title, double tookS, double mse, double meanPercent,
           const std::string& picture) const {
    if (!all) return;
    const Result<Image> image = readImage(folder_ / picture);
    const Result<std::string> one =
        !image ? Error{image.error()}
               : figure(title, fmt::format("{} s, mse {:.4f}, mean {:+.1f} %", seconds(tookS), mse, meanPercent),
                        image.value(), true);
    all = one ? all.value() + one.value() : one;
  }
  Result<std::string> figure(const std::string& title, const std::string& words, const Image& image,
                             bool difference) const {
    const std::string name = fmt::format("{} {} {} shown", case_.scene, case_.light, title);
    Result<std::string> shown = embedded(name, title, toneMap(image, ev100_, ToneCurve::Clip), kPictureBytes);
    if (!shown) return shown;
    if (difference) {
      const Result<std::string> error = embedded(name + " difference", "where " + title + " is off",
                                                 differencePicture(reference_, image), kDifferenceBytes);
      if (!error) return error;
      shown.value() += error.value();
    }
    return report::figure(shown.value(), fmt::format("<b>{}</b><br><span>{}</span>", escaped(title), words));
  }

  const StudyCase& case_;
  std::filesystem::path folder_;
  Image reference_;
  float ev100_ = 0;
};

std::string verdictTable(const StudyResults& r) {
  Table table({"asked", "<measured", ""});
  for (const StudyVerdict& v : studyVerdicts(r))
    table.row({escaped(v.asked), escaped(v.measured), report::verdict(v.met)});
  return "<h2>Against the published study</h2><p>What roomlight asks of its own techniques beside the rivals, after "
         "the figures of the study that it builds on.</p>" +
         table.html() + "\n";
}

// A table of one number a technique and case, the least of a row in bold where `bold`.
std::string matrix(const StudyResults& r, const std::function<std::string(const StudyCurve&, const StudyCase&)>& text,
                   const std::function<double(const StudyCurve&)>& value) {
  Table table({"scene, light"});
  for (const StudyCurve& c : r.cases.front().curves) table.column(escaped(c.technique));
  for (const StudyCase& c : r.cases) {
    double least = 1e30;
    for (const StudyCurve& curve : c.curves) {
      if (curve.kind != "judge" && !curve.points.empty()) least = std::min(least, value(curve));
    }
    std::vector<Cell>& cells = table.row({escaped(c.scene + ", " + c.light)});
    for (const StudyCurve& curve : c.curves) {
      if (curve.points.empty())
        cells.emplace_back("–", "", curve.failed);
      else
        cells.emplace_back(text(curve, c), value(curve) <= least && curve.kind != "judge" ? "best" : "");
    }
  }
  return table.wideHtml();
}

std::string externals(const StudyResults& r) {
  Table table({"name", "<scene, light", "seconds", "mse", "flip", "mean"});
  for (const StudyCase& c : r.cases) {
    for (const StudyExternal& e : c.externals) {
      table.row({escaped(e.name), escaped(c.scene + ", " + c.light), seconds(e.seconds), fixed(e.mseBeyondNoise, 4),
                 fixed(e.flip, 3), fmt::format("{:+.1f} %", e.meanErrorPercent)});
    }
  }
  return table.isEmpty() ? "" : "<h2>Other renderers</h2>" + table.html() + "\n";
}

std::string timesToCone(const StudyResults& r) {
  const auto coneError = [](const StudyCase& c) {
    for (const StudyCurve& curve : c.curves) {
      if (curve.technique == technique::kCone && !curve.points.empty()) return errorOf(settledPoint(curve));
    }
    return 0.0;
  };
  if (std::all_of(r.cases.begin(), r.cases.end(), [&](const StudyCase& c) { return coneError(c) <= 0; })) return {};
  return "<h2>Time to the error of <i>cone</i></h2><p>Seconds until a technique is as good as <i>cone</i> where that "
         "settles; between points of its curve along a straight line of logarithms. –: it never is.</p>" +
         matrix(
             r,
             [&](const StudyCurve& curve, const StudyCase& c) {
               const auto t = secondsTo(curve, coneError(c));
               return t ? seconds(*t) : std::string("–");
             },
             [](const StudyCurve&) { return 1e31; });
}

std::string publishedTimes() {
  Table table({"scene"});
  for (const auto& t : published::kTechniques) table.column(t.name);
  for (size_t i = 0; i < 6; ++i) {
    std::vector<Cell>& cells = table.row({i + 1});
    for (const auto& t : published::kTechniques) cells.emplace_back(fixed(t.drawingS[i], 1));
  }
  return "<details><summary>Table 1 of the published study, seconds</summary>" + table.html() + "</details>\n";
}

std::string tables(const StudyResults& r) {
  std::string s =
      "<h2>Drawing time</h2><p>Seconds after loading until the error has settled: twice the samples a pixel take away "
      "less than a twentieth of it, two times in a row. &gt;: stopped by time while it still fell. Bold: the quickest, "
      "whatever its error.</p>";
  s += matrix(
      r,
      [](const StudyCurve& c, const StudyCase&) {
        return (hasSettled(c) ? "" : "&gt; ") + seconds(settledPoint(c).seconds);
      },
      [](const StudyCurve& c) { return settledPoint(c).seconds; });
  if (r.againstPublished) s += publishedTimes();
  s += "<h2>Error where it settles</h2><p>Mean squared difference of the exposed, clipped and sRGB-encoded pictures, "
       "without what the reference's own noise adds. ";
  s += fmt::format("{}Bold: the least of all but the judge.</p>",
                   r.againstPublished ? "Published: cone .0034, vxgi .0051, lpv .0085, photon .0105. " : "");
  s += matrix(
      r, [](const StudyCurve& c, const StudyCase&) { return fixed(errorOf(settledPoint(c)), 4); },
      [](const StudyCurve& c) { return errorOf(settledPoint(c)); });
  s += timesToCone(r);
  s += "<h2>Memory</h2><p>Peak of the process, MiB, the home included.</p>";
  s += matrix(
      r, [](const StudyCurve& c, const StudyCase&) { return fixed(settledPoint(c).memoryMiB, 0); },
      [](const StudyCurve& c) { return settledPoint(c).memoryMiB; });
  return s + externals(r);
}

std::string errorOverTime(const StudyResults& r) {
  return "<h2>Error over time</h2><p>Every point is a picture of its own with twice the samples of the one before. "
         "Large "
         "dots: where the error settles; diamonds: other renderers. Both axes are logarithmic; down and left is "
         "better. Names above the plots show and hide curves; a box that is dragged zooms, a double click shows all "
         "again.</p>" +
         curvesPlot(r.cases);
}

// Those whose colours plots have: of pictures, or where there are none, of walks.
std::vector<StudyCurve> colouredCurves(const StudyResults& r) {
  if (!r.cases.empty() && !r.cases.front().curves.empty()) return r.cases.front().curves;
  std::vector<StudyCurve> curves;
  for (const StudyFrames& f : r.frames) {
    if (f.scene == r.frames.front().scene) curves.push_back({f.technique, f.kind, {}, {}});
  }
  return curves;
}

std::string frames(const StudyResults& r) {
  if (r.frames.empty()) return {};
  std::string s = "<h2>Frames a second</h2><p>Along a recorded walk with moving objects, one sample a pixel a frame.";
  s += fmt::format("{}</p><div class=plots>\n", r.againstPublished
                                                    ? " Black ticks, where there is <i>cone</i>: the published frames "
                                                      "(cone 36, vxgi 28, lpv 23, photon 7) in ratio to it."
                                                    : "");
  std::map<std::string, double> published;
  for (const auto& t : published::kTechniques) {
    if (r.againstPublished) published[t.name] = t.framesPerSecond;
  }
  std::vector<std::pair<std::string, std::string>> walks;  // scene and light
  for (const StudyFrames& f : r.frames) {
    if (walks.empty() || walks.back().first != f.scene) walks.emplace_back(f.scene, f.light);
  }
  const std::vector<StudyCurve> all = colouredCurves(r);
  for (const auto& [scene, light] : walks) {
    std::vector<Bar> bars;
    for (const StudyFrames& f : r.frames) {
      if (f.scene != scene || f.runs.empty()) continue;
      std::string colour = "#777777";
      for (size_t i = 0; i < all.size(); ++i) colour = all[i].technique == f.technique ? colourOf(all, i) : colour;
      bars.push_back(
          {f.technique, colour, f.cost.framesPerSecond, published.count(f.technique) ? published[f.technique] : 0});
    }
    if (!bars.empty())
      s += fmt::format("<div><h3>{}</h3>{}</div>\n", escaped(scene + ", " + light), barsHtml(bars, "/s"));
  }
  return s + "</div>\n";
}

Result<std::string> sheets(const StudyResults& r, const std::filesystem::path& folder) {
  std::string s =
      "<h2>Pictures</h2><p>Each where it settles, all exposed like the reference and without a tone curve; below it "
      "where it is too bright (red) or too dark (blue): full colour is a difference of .25.</p>";
  for (size_t i = 0; i < r.cases.size(); ++i) {
    const StudyCase& c = r.cases[i];
    const Result<std::string> sheet = Sheet(c, folder).html();
    if (!sheet) return sheet;
    s += fmt::format(
        "<details{}><summary><b>{}</b> <span class=soft>reference: {:.0f} s, noise "
        "{:.5f}{}</span></summary>{}</details>\n",
        i < 3 ? " open" : "", escaped(c.scene + ", " + c.light), c.referenceS, c.noiseMse,
        c.referenceConverged ? "" : ", more than was asked", sheet.value());
  }
  return s;
}

}  // namespace

Result<std::string> studyHtml(const StudyHeader& header, const StudyResults& r, const std::filesystem::path& folder,
                              const std::string& plots) {
  std::string s = "<h1>Study of techniques</h1>\n";
  if (!r.complete) s += "<p><b>Stopped early: this is a part.</b> Started again, the study goes on.</p>\n";
  if (nothingMeasured(r)) s += "<p>Nothing has been measured.</p>\n";
  if (!r.cases.empty()) s += tables(r) + errorOverTime(r);
  s += frames(r);
  if (!r.cases.empty()) {
    const Result<std::string> pictures = sheets(r, folder);
    if (!pictures) return pictures;
    s += pictures.value();
  }
  if (r.againstPublished && !nothingMeasured(r)) s += verdictTable(r);
  std::vector<std::pair<std::string, std::string>> facts = header.about;
  facts.insert(facts.end(), header.techniques.begin(), header.techniques.end());
  s += "<h2>Machine and settings</h2>" + report::factsHtml(facts);
  for (const std::string& remark : r.remarks) s += "<p class=soft>" + escaped(remark) + "</p>\n";
  return report::page("Study of techniques", kStyle,
                      s + "<footer>Times and frames a second are medians of the runs; the runs of all techniques take "
                          "turns.</footer>\n",
                      plots);
}

}  // namespace roomlight
