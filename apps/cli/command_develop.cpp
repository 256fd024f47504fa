// roomlight develop: linear pictures exposed and tone-mapped alike, side by side.
#include <fmt/format.h>

#include <memory>

#include "base/image_io.h"
#include "base/tone.h"
#include "commands.h"
#include "console.h"
#include "output_files.h"

namespace roomlight::cli {
namespace {

struct Options {
  std::vector<std::string> pictures;
  std::string output, tone = "neutral";
  std::optional<float> ev100;
  int mostKilobytes = 1000;
};

int bad(const std::string& message, int code = kBadInput) {
  printError(message);
  return code;
}

int runDevelop(const Options& o) {
  const Result<ToneCurve> tone = toneCurveFromName(o.tone);
  if (!tone) return bad("--tone: " + tone.error());
  const bool jpeg = o.output.ends_with(".jpg");
  if (!jpeg && !o.output.ends_with(".png")) return bad(fmt::format("{}: unknown kind of picture; use .png or .jpg", o.output));
  if (const Status s = checkWritable(o.output); !s) return bad(s.error());
  std::vector<Image> pictures;
  for (const std::string& file : o.pictures) {
    const Result<bool> finished = isForDisplay(file);
    if (!finished) return bad(finished.error());
    if (finished.value()) return bad(fmt::format("{}: is exposed and tone-mapped already; develop takes linear pictures, such as render writes with -o picture.exr", file));
    Result<Image> read = readImage(file);
    if (!read) return bad(read.error());
    pictures.push_back(std::move(read).value());
    const Image &first = pictures.front(), &last = pictures.back();
    if (last.height != first.height) return bad(fmt::format("{}: has {} rows, {} has {}; name pictures of one height", file, last.height, o.pictures.front(), first.height));
  }
  const float ev100 = o.ev100 ? *o.ev100 : automaticEv100(pictures.back());
  int width = 0;
  for (const Image& p : pictures) width += p.width;
  Image out(width, pictures.front().height);
  int left = 0;
  for (const Image& p : pictures) {
    const Image shown = toneMap(p, ev100, tone.value());
    for (int y = 0; y < p.height; ++y) {
      for (int x = 0; x < p.width; ++x) out.at(left + x, y) = shown.at(x, y);
    }
    left += p.width;
  }
  const Status written = jpeg ? writeJpeg(o.output, out, static_cast<size_t>(o.mostKilobytes) * 1000) : writePng(o.output, out, {{"roomlight.exposureEv100", fmt::format("{}", ev100)}});
  return written ? kOk : bad(written.error(), kFailed);
}

}  // namespace

Registered addDevelop(CLI::App& program) {
  const auto o = std::make_shared<Options>();
  CLI::App* app = program.add_subcommand("develop", "Expose and tone-map .exr pictures alike, side by side");
  app->add_option("PICTURE", o->pictures, "Linear pictures of one height: .exr or .hdr")->required()->check(CLI::ExistingFile);
  app->add_option("-o,--output", o->output, "Picture: .png or .jpg")->required();
  app->add_option("--exposure", o->ev100, "EV100 as on a light meter; without it, that of the last picture")->check(CLI::Range(-64.0, 64.0));
  app->add_option("--tone", o->tone, "Tone curve: neutral, agx, filmic or clip")->capture_default_str();
  app->add_option("--most-kilobytes", o->mostKilobytes, "Size that a .jpg shall not exceed")->check(CLI::Range(1, 1000000))->capture_default_str();
  app->footer(
      "Example:\n"
      "  roomlight develop hybrid.exr path.exr reference.exr -o strip.jpg");
  return {app, [o] { return runDevelop(*o); }};
}

}  // namespace roomlight::cli
