// A home's file in, a picture and the light on its floors out: home_to_picture HOME PICTURE.png
#include <roomlight/roomlight.h>

#include <algorithm>
#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: home_to_picture HOME PICTURE.png\n"), 2;

  const auto home = roomlight::Home::open(argv[1]);
  if (!home) return std::fprintf(stderr, "%s\n", home.error().message.c_str()), 1;
  for (const std::string& note : home->notes()) std::printf("note: %s\n", note.c_str());
  std::printf("%zu triangles, %zu lamps, %zu rooms\n", home->triangleCount(), home->lamps().size(),
              home->rooms().size());

  roomlight::Settings settings;
  settings.quality = "draft";
  settings.width = 480, settings.height = 270;
  roomlight::Progress progress;
  progress.report = [](std::string_view stage, float fraction) {
    std::fprintf(stderr, "\r%-12.*s %3.0f %%", static_cast<int>(stage.size()), stage.data(), 100.0 * fraction);
    if (fraction == 1) std::fprintf(stderr, "\n");
  };
  const auto picture = roomlight::render(*home, {}, settings, progress);
  if (!picture) return std::fprintf(stderr, "%s\n", picture.error().message.c_str()), 1;
  if (const auto written = picture->write(argv[2]); !written)
    return std::fprintf(stderr, "%s\n", written.error().message.c_str()), 1;

  // Linear light: luminance in cd/m² from red, green and blue.
  const auto rgb = picture->image().rgb();
  float brightest = 0;
  for (size_t i = 0; i < rgb.size(); i += 3)
    brightest = std::max(brightest, 0.2126f * rgb[i] + 0.7152f * rgb[i + 1] + 0.0722f * rgb[i + 2]);
  std::printf("brightest pixel: %.4g cd/m2\n", static_cast<double>(brightest));

  roomlight::MeterOptions meters;
  meters.quality = "draft";
  const auto report = roomlight::measure(*home, meters);
  if (!report) return std::fprintf(stderr, "%s\n", report.error().message.c_str()), 1;
  std::printf("%s", report->table().c_str());
  return 0;
}
