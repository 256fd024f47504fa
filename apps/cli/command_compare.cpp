// roomlight compare: how far a picture is from a reference.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/image_io.h"
#include "commands.h"
#include "compare/compare.h"
#include "console.h"
#include "output_files.h"

namespace roomlight::cli {
namespace {

struct CompareOptions {
  std::string reference, second, picture, difference, band;
  bool json = false;
};

struct Pictures {
  Image reference, second, picture;
  bool forDisplay = false;  // all of them: tone-mapped
};

// By their headers, so that none is decoded in vain. True: all of them are tone-mapped.
Result<bool> checkHeaders(const CompareOptions& o) {
  bool allForDisplay = false;
  ImageSize size;
  for (const std::string* file : {&o.reference, &o.second, &o.picture}) {
    if (file == &o.second && file->empty()) continue;
    const Result<bool> forDisplay = isForDisplay(*file);
    if (!forDisplay) return Error{forDisplay.error()};
    const Result<ImageSize> one = readImageSize(*file);
    if (!one) return Error{one.error()};
    if (file == &o.reference) allForDisplay = forDisplay.value(), size = one.value();
    if (forDisplay.value() != allForDisplay) {
      const std::string& linear = allForDisplay ? *file : o.reference;
      const std::string& shown = allForDisplay ? o.reference : *file;
      return Error{
          fmt::format("{} holds linear light and {} a tone-mapped picture: no figure compares them; give two .exr, or "
                      "two of .png and .jpg",
                      linear, shown)};
    }
    if (const Status s = checkSizes(size, one.value()); !s)
      return Error{fmt::format("{}, {}: {}", o.reference, *file, s.error())};
  }
  if (allForDisplay && !o.second.empty())
    return Error{
        fmt::format("--second {}: the noise of a reference is told from two linear ones; give .exr", o.second)};
  return allForDisplay;
}

Result<Pictures> readPictures(const CompareOptions& o) {
  const Result<bool> forDisplay = checkHeaders(o);
  if (!forDisplay) return Error{forDisplay.error()};
  Pictures read;
  read.forDisplay = forDisplay.value();
  const std::pair<const std::string*, Image*> files[] = {
      {&o.reference, &read.reference}, {&o.second, &read.second}, {&o.picture, &read.picture}};
  for (const auto& [file, image] : files) {
    if (file->empty()) continue;
    Result<Image> one = readImage(*file);
    if (!one) return Error{one.error()};
    *image = std::move(one).value();
  }
  return read;
}

void print(const ShownReport& r, const CompareOptions& o) {
  if (o.json) {
    const nlohmann::ordered_json json = {
        {"space", "display"}, {"mse", r.mse}, {"ssim", r.ssim}, {"flip", r.flip}, {"difference", o.difference}};
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    return;
  }
  fmt::print("mse                        {:.6f}\n", r.mse);
  fmt::print("ssim                       {:.4f}\n", r.ssim);
  fmt::print("flip                       {:.4f}\n", r.flip);
  fmt::print("difference picture         {}\n", o.difference);
  fmt::print(
      "of the pictures as shown: what is tone-mapped no longer tells how much light there was; give two .exr for "
      "that\n");
}

void print(const Report& r, const CompareOptions& o) {
  if (o.json) {
    nlohmann::ordered_json json = {{"space", "linear"},
                                   {"mse", r.mse},
                                   {"relMse", r.relMse},
                                   {"ssim", r.ssim},
                                   {"flip", r.flip},
                                   {"meanLuminanceErrorPercent", r.meanLuminanceErrorPercent},
                                   {"difference", o.difference}};
    if (r.mseBeyondNoise) json["mseBeyondNoise"] = *r.mseBeyondNoise;
    if (r.noise) {
      const bool judged = r.noise->judgedShare > 0;
      json["blotchesPercent"] = judged ? nlohmann::ordered_json(r.noise->blotchesPercent) : nullptr;
      json["grainPercent"] = judged ? nlohmann::ordered_json(r.noise->grainPercent) : nullptr;
      json["judgedPercent"] = 100 * r.noise->judgedShare;
    }
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    return;
  }
  fmt::print("mse                        {:.6f}\n", r.mse);
  if (r.mseBeyondNoise) fmt::print("mseBeyondNoise             {:.6f}\n", *r.mseBeyondNoise);
  if (r.noise && r.noise->judgedShare > 0) {
    fmt::print("blotchesPercent            {:.2f}\ngrainPercent               {:.2f}\n", r.noise->blotchesPercent,
               r.noise->grainPercent);
  } else if (r.noise) {
    fmt::print("blotchesPercent            none: no pixel lies on a smooth surface\n");
  }
  fmt::print("relMse                     {:.6f}\n", r.relMse);
  fmt::print("ssim                       {:.4f}\n", r.ssim);
  fmt::print("flip                       {:.4f}\n", r.flip);
  fmt::print("meanLuminanceErrorPercent  {:+.2f}\n", r.meanLuminanceErrorPercent);
  fmt::print("difference picture         {}\n", o.difference);
}

template <class AnyReport, class MakePicture>
int tell(const CompareOptions& o, const Result<AnyReport>& report, const MakePicture& differenceOf) {
  if (!report) return failed(fmt::format("{}, {}: {}", o.reference, o.picture, report.error()));
  if (const Status s = checkWritable(o.difference); !s) return failed(s.error());
  const Status written =
      writePng(o.difference, differenceOf(), {{"roomlight.reference", o.reference}, {"roomlight.picture", o.picture}});
  if (!written) return failed(written.error(), kFailed);
  print(report.value(), o);
  return kOk;
}

Status checkBand(const CompareOptions& o) {
  if (o.band.empty()) return Ok{};
  if (o.second.empty()) return Error{"--band needs --second: the noise of a reference is told from two"};
  if (!o.band.ends_with(".png")) return Error{fmt::format("{}: the picture of the band is a .png", o.band)};
  if (o.band == o.difference) return Error{fmt::format("{}: is named twice; name another file for the band", o.band)};
  return checkWritable(o.band);
}

int runCompare(CompareOptions o) {
  if (o.difference.empty()) o.difference = o.picture + ".difference.png";
  if (!o.difference.ends_with(".png")) return failed(fmt::format("{}: the difference picture is a .png", o.difference));
  if (o.difference == o.reference || o.difference == o.second || o.difference == o.picture) {
    return failed(fmt::format("{}: is named twice; name another file for the difference picture", o.difference));
  }
  if (const Status s = checkBand(o); !s) return failed(s.error());
  Result<Pictures> pictures = readPictures(o);
  if (!pictures) return failed(pictures.error());
  const auto& [reference, second, picture, forDisplay] = pictures.value();
  if (forDisplay)
    return tell(o, compareShown(reference, picture), [&] { return differencePictureOfShown(reference, picture); });
  if (o.second.empty()) {
    return tell(o, compare(reference, picture), [&] { return differencePicture(reference, picture); });
  }
  const Result<Report> report = compare(reference, second, picture);
  if (report && !o.band.empty()) {
    if (const Status s = checkWritable(o.difference); !s) return failed(s.error());
    if (const Status s = writePng(o.band, bandPicture(*report.value().noise), {}); !s)
      return failed(s.error(), kFailed);
  }
  return tell(o, report, [&] { return differencePicture(meanOf(reference, second), picture); });
}

}  // namespace

Registered addCompare(CLI::App& program) {
  const auto o = std::make_shared<CompareOptions>();
  CLI::App* app = program.add_subcommand("compare", "Measure how far a picture is from a reference");
  app->add_option("REFERENCE", o->reference,
                  "Picture taken as true: .exr or .hdr; or, to compare what is shown, .png or .jpg")
      ->required();
  app->add_option("PICTURE", o->picture, "Picture to judge, of the same size and kind")->required();
  app->add_option("--second", o->second, "A second reference with another seed; figures are against the mean of both");
  app->add_flag("--json", o->json, "Print JSON");
  app->add_option("--band", o->band,
                  "With --second: where blotches are, red 5 % too bright, blue 5 % too dark, as .png");
  app->add_option("--difference", o->difference, "Where the difference picture goes (default: PICTURE.difference.png)");
  app->footer(
      "mse: mean squared difference after one exposure for both, taken from the reference, clipped to 0-1 and encoded\n"
      "as sRGB. relMse: on linear values, relative to the reference. Both are 0 for equal pictures, ssim is 1.\n"
      "blotchesPercent and grainPercent, with --second: relative error on smooth surfaces between 4 and 32 pixels and "
      "between 1.5 and 4.\n"
      "mseBeyondNoise, with --second: mse without what the references' own noise adds to it.\n"
      "Example:\n"
      "  roomlight compare reference.exr cone.exr --json --difference difference.png");
  return {app, [o] { return runCompare(*o); }};
}

}  // namespace roomlight::cli
