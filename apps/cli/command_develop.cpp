// roomlight develop: linear pictures exposed and tone-mapped alike, side by side.
#include <fmt/format.h>

#include <memory>

#include "base/image_io.h"
#include "commands.h"
#include "console.h"
#include "output_files.h"
#include "picture_options.h"
#include "still/developed.h"

namespace roomlight::cli {
namespace {

struct DevelopOptions {
  std::vector<std::string> pictures;
  std::string output;
  DisplayOptions display;
  int mostKilobytes = 1000;
};

// The last picture that tells it decides for all.
Vec3 lightColourOf(const std::vector<std::string>& files) {
  for (size_t i = files.size(); i-- > 0;) {
    const Result<Metadata> metadata = readMetadata(files[i]);
    const std::optional<Vec3> colour = metadata ? lightColourIn(metadata.value()) : std::nullopt;
    if (colour) return *colour;
  }
  return {};
}

int runDevelop(const DevelopOptions& o) {
  const Result<Display> display = readDisplay(o.display);
  if (!display) return failed(display.error());
  const bool jpeg = o.output.ends_with(".jpg");
  if (!jpeg && !o.output.ends_with(".png"))
    return failed(fmt::format("{}: unknown kind of picture; use .png or .jpg", o.output));
  if (const Status s = checkWritable(o.output); !s) return failed(s.error());
  std::vector<Image> pictures;
  for (const std::string& file : o.pictures) {
    const Result<bool> finished = isForDisplay(file);
    if (!finished) return failed(finished.error());
    if (finished.value())
      return failed(
          fmt::format("{}: is exposed and tone-mapped already; develop takes linear pictures, such as render writes "
                      "with -o picture.exr",
                      file));
    Result<Image> read = readImage(file);
    if (!read) return failed(read.error());
    pictures.push_back(std::move(read).value());
    const Image &first = pictures.front(), &last = pictures.back();
    if (last.height != first.height)
      return failed(fmt::format("{}: has {} rows, {} has {}; name pictures of one height", file, last.height,
                                o.pictures.front(), first.height));
  }
  const float ev100 = ev100Of(display.value(), pictures.back());
  const White white = whiteOf(display.value(), lightColourOf(o.pictures));
  int width = 0;
  for (const Image& p : pictures) width += p.width;
  Image out(width, pictures.front().height);
  int left = 0;
  for (const Image& p : pictures) {
    const Image shown = displayed(p, display.value(), white, ev100);
    for (int y = 0; y < p.height; ++y) {
      for (int x = 0; x < p.width; ++x) out.at(left + x, y) = shown.at(x, y);
    }
    left += p.width;
  }
  const Status written = jpeg ? writeJpeg(o.output, out, static_cast<size_t>(o.mostKilobytes) * 1000)
                              : writePng(o.output, out, {{"roomlight.exposureEv100", fmt::format("{}", ev100)}});
  return written ? kOk : failed(written.error(), kFailed);
}

}  // namespace

Registered addDevelop(CLI::App& program) {
  const auto o = std::make_shared<DevelopOptions>();
  CLI::App* app = program.add_subcommand(
      "develop", "Expose, balance and tone-map .exr pictures alike, by the last one, side by side");
  app->add_option("PICTURE", o->pictures, "Linear pictures of one height: .exr or .hdr")
      ->required()
      ->check(CLI::ExistingFile);
  app->add_option("-o,--output", o->output, "Picture: .png or .jpg")->required();
  o->display.look = "technical";
  addDisplayOptions(*app, o->display, "they");
  app->add_option("--most-kilobytes", o->mostKilobytes, "Size that a .jpg shall not exceed")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app->footer(
      "Example:\n"
      "  roomlight develop hybrid.exr path.exr reference.exr -o strip.jpg");
  return {app, [o] { return runDevelop(*o); }};
}

}  // namespace roomlight::cli
