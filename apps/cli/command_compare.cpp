// roomlight compare: how far a picture is from a reference.
#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/image_io.h"
#include "commands.h"
#include "compare/compare.h"
#include "console.h"
#include "output_files.h"

namespace roomlight::cli {
namespace {

struct Options {
  std::string reference, second, picture, difference;
  bool json = false;
};

int bad(const std::string& message, int code = kBadInput) {
  printError(message);
  return code;
}

bool isPng(const std::string& file) {
  char magic[4] = {};
  std::ifstream(file, std::ios::binary).read(magic, sizeof magic);
  return std::string_view(magic, sizeof magic) == "\x89PNG";
}

void print(const Report& r, const Options& o) {
  if (o.json) {
    nlohmann::ordered_json json = {{"mse", r.mse},
                                   {"relMse", r.relMse},
                                   {"ssim", r.ssim},
                                   {"flip", r.flip},
                                   {"meanLuminanceErrorPercent", r.meanLuminanceErrorPercent},
                                   {"difference", o.difference}};
    if (r.mseBeyondNoise) json["mseBeyondNoise"] = *r.mseBeyondNoise;
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    return;
  }
  fmt::print("mse                        {:.6f}\n", r.mse);
  if (r.mseBeyondNoise) fmt::print("mseBeyondNoise             {:.6f}\n", *r.mseBeyondNoise);
  fmt::print("relMse                     {:.6f}\n", r.relMse);
  fmt::print("ssim                       {:.4f}\n", r.ssim);
  fmt::print("flip                       {:.4f}\n", r.flip);
  fmt::print("meanLuminanceErrorPercent  {:+.2f}\n", r.meanLuminanceErrorPercent);
  fmt::print("difference picture         {}\n", o.difference);
}

int runCompare(Options o) {
  if (o.difference.empty()) o.difference = o.picture + ".difference.png";
  if (!o.difference.ends_with(".png")) return bad(fmt::format("{}: the difference picture is a .png", o.difference));
  if (o.difference == o.reference || o.difference == o.second || o.difference == o.picture) {
    return bad(fmt::format("{}: is named twice; name another file for the difference picture", o.difference));
  }
  Result<Image> reference = readImage(o.reference);
  if (!reference) return bad(reference.error());
  const Result<Image> second = o.second.empty() ? Result<Image>(Image{}) : readImage(o.second);
  if (!second) return bad(second.error());
  const Result<Image> picture = readImage(o.picture);
  if (!picture) return bad(picture.error());
  if (isPng(o.reference) != isPng(o.picture)) {
    printWarnings({"one picture is linear and the other tone-mapped: the figures say little; compare two .exr"});
  }
  const Result<Report> report =
      o.second.empty() ? compare(reference.value(), picture.value()) : compare(reference.value(), second.value(), picture.value());
  if (!report) return bad(fmt::format("{}, {}: {}", o.reference, o.picture, report.error()));
  if (!o.second.empty()) reference = meanOf(reference.value(), second.value());
  if (const Status s = checkWritable(o.difference); !s) return bad(s.error());
  const Status written = writePng(o.difference, differencePicture(reference.value(), picture.value()),
                                  {{"roomlight.reference", o.reference}, {"roomlight.picture", o.picture}});
  if (!written) return bad(written.error(), kFailed);
  print(report.value(), o);
  return kOk;
}

}  // namespace

Registered addCompare(CLI::App& program) {
  const auto o = std::make_shared<Options>();
  CLI::App* app = program.add_subcommand("compare", "Measure how far a picture is from a reference");
  app->add_option("REFERENCE", o->reference, "Picture taken as true: .exr, .hdr or .png")->required();
  app->add_option("PICTURE", o->picture, "Picture to judge, of the same size")->required();
  app->add_option("--second", o->second, "A second reference with another seed; figures are against the mean of both");
  app->add_flag("--json", o->json, "Print JSON");
  app->add_option("--difference", o->difference, "Where the difference picture goes (default: PICTURE.difference.png)");
  app->footer(
      "mse: mean squared difference after one exposure for both, taken from the reference, clipped to 0-1 and encoded\n"
      "as sRGB. relMse: on linear values, relative to the reference. Both are 0 for equal pictures, ssim is 1.\n"
      "mseBeyondNoise, with --second: mse without what the references' own noise adds to it.\n"
      "Example:\n"
      "  roomlight compare reference.exr cone.exr --json --difference difference.png");
  return {app, [o] { return runCompare(*o); }};
}

}  // namespace roomlight::cli
