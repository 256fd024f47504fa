// Pictures by the library: the same as the program's, from several threads, in layers, interrupted.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <optional>
#include <thread>

#include "unit/library/arrays.h"
#include "unit/temporary_folder.h"

namespace roomlight::test {
namespace {

std::vector<float> pixelsOf(const Image& image) { return {image.rgb().begin(), image.rgb().end()}; }

Home room() { return std::move(Home::fromArrays(smallRoom().arrays(), twoLamps())).value(); }

TEST(LibraryPicture, ViewsShareTheirLight) {
  auto renderer = Renderer::of(room(), quick(), {{.camera = "corner"}, {.camera = "door"}});
  ASSERT_TRUE(renderer) << renderer.error().message;
  ASSERT_EQ(renderer->viewCount(), 2u);
  const auto first = renderer->picture(0), second = renderer->picture(1);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(second->camera(), "door");
  EXPECT_TRUE(second->complete());
  EXPECT_EQ(second->image().width(), 64);
  EXPECT_NE(pixelsOf(first->image()), pixelsOf(second->image()));
  EXPECT_NE(first->stats().find("\"gather\""), std::string::npos);
  EXPECT_EQ(renderer->picture(2).error().message, "view 2: there are 2, numbered from 0");
}

TEST(LibraryPicture, ViewsOfOneRendererHaveOneSize) {
  Settings settings;
  settings.quality = "draft";
  const auto renderer = Renderer::of(room(), settings, {{.camera = "corner"}, {.kind = "panorama"}});
  ASSERT_FALSE(renderer);
  EXPECT_EQ(renderer.error().message, "the views of a renderer have one size; give width and height");
}

TEST(LibraryPicture, IsTheSameFromSeveralThreadsAtOnce) {
  const Home home = room();
  const auto alone = render(home, {}, quick());
  ASSERT_TRUE(alone);
  std::vector<std::vector<float>> pixels(3);
  std::vector<std::thread> threads;
  for (std::vector<float>& p : pixels)
    threads.emplace_back([&] { p = pixelsOf(render(home, {}, quick()).value().image()); });
  for (std::thread& t : threads) t.join();
  for (const std::vector<float>& p : pixels) EXPECT_TRUE(p == pixelsOf(alone->image()));
}

TEST(LibraryPicture, OutlivesHomeAndPicture) {
  std::optional<Image> image;
  {
    const auto picture = render(room(), {}, quick());
    ASSERT_TRUE(picture);
    image = picture->image();
  }
  ASSERT_EQ(image->rgb().size(), 3u * 64 * 48);
  EXPECT_GT(*std::max_element(image->rgb().begin(), image->rgb().end()), 0);
}

TEST(LibraryPicture, IsCancelled) {
  const std::atomic<bool> at_once = true;
  Progress progress;
  progress.cancelled = &at_once;
  const auto none = render(room(), {}, quick(), progress);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, ErrorKind::Interrupted);

  std::atomic<bool> later = false;
  progress.cancelled = &later;
  progress.report = [&](std::string_view stage, float) { later = later || stage == "path"; };
  Settings settings = quick();
  settings.technique = "path", settings.samples = 1 << 24;
  const auto part = render(room(), {}, settings, progress);
  ASSERT_TRUE(part) << part.error().message;
  EXPECT_FALSE(part->complete());
}

TEST(LibraryPicture, WhatProgressThrowsIsAnError) {
  Progress progress;
  progress.report = [](std::string_view, float) { throw 5; };
  const auto picture = render(room(), {}, quick(), progress);
  ASSERT_FALSE(picture);
  EXPECT_EQ(picture.error().kind, ErrorKind::Failed);
}

TEST(LibraryPicture, BadSettingsAreNamed) {
  const auto errorOf = [](const Settings& settings, const View& view = {}) {
    const auto picture = render(room(), view, settings);
    return picture ? "no error" : picture.error().message;
  };
  Settings settings = quick();
  settings.technique = "radiosity";
  EXPECT_NE(errorOf(settings).find("radiosity"), std::string::npos);
  settings = quick();
  settings.json = R"({"sampels": 3})";
  EXPECT_NE(errorOf(settings).find("sampels"), std::string::npos);
  settings = quick();
  settings.width = -4;
  EXPECT_NE(errorOf(settings).find("width"), std::string::npos);
  settings = quick();
  settings.threads = 100'000;
  EXPECT_EQ(errorOf(settings), "threads: must be from 0 to 1024");
  settings = quick();
  settings.technique = "cone", settings.layers = true;
  EXPECT_TRUE(errorOf(settings).starts_with("layers: technique cone"));
  EXPECT_NE(errorOf(quick(), {.camera = "cellar"}).find("cellar"), std::string::npos);
  EXPECT_NE(errorOf(quick(), {.kind = "plan", .verticalFovDeg = 500}).find("fov"), std::string::npos);
}

TEST(LibraryPicture, IsShownAndWritten) {
  const roomlight::testing::TemporaryFolder folder;
  const auto picture = render(room(), {}, quick());
  ASSERT_TRUE(picture);
  const auto display = picture->display({.look = "bright"});
  ASSERT_TRUE(display);
  EXPECT_EQ(display->samples.size(), 3u * 64 * 48);
  for (const char* name : {"a.exr", "a.png", "a.jpg"}) EXPECT_TRUE(picture->write(folder / name)) << name;
  for (const char* name : {"b.webp", "b.png", "b.jpg"}) EXPECT_TRUE(write(*display, folder / name)) << name;
  EXPECT_TRUE(picture->image().write(folder / "c.exr"));
  EXPECT_FALSE(picture->image().write(folder / "c.png"));
  EXPECT_NE(picture->write(folder / "a.bmp").error().message.find("unknown kind of picture '.bmp'"), std::string::npos);
  EXPECT_FALSE(picture->display({.look = "gloomy"}));
  EXPECT_FALSE(picture->display({.contrast = 9}));
  EXPECT_FALSE(write({8, 8, 3, {}}, folder / "d.png"));
  EXPECT_EQ(picture->layers().error().message, "the picture has no layers; render it with layers");
}

TEST(LibraryLayers, AddUpToThePicture) {
  Settings settings = quick();
  settings.layers = true;
  const auto picture = render(room(), {}, settings);
  ASSERT_TRUE(picture) << picture.error().message;
  const auto layers = picture->layers();
  ASSERT_TRUE(layers) << layers.error().message;
  ASSERT_EQ(layers->list().size(), 2u);
  EXPECT_EQ(layers->list()[0].name, "Left");
  EXPECT_EQ(layers->list()[1].kind, "lamp");
  EXPECT_NEAR(layers->list()[1].fluxLm.value_or(0), 900, 1);
  const std::vector<float> whole = pixelsOf(picture->image()), left = pixelsOf(*layers->image(0)),
                           right = pixelsOf(*layers->image(1)),
                           mixed = pixelsOf(*layers->mix({.lamps = {{"Right", "50%"}}}));
  for (size_t i = 0; i < whole.size(); ++i) {
    ASSERT_NEAR(left[i] + right[i], whole[i], 1e-4f * whole[i] + 1e-6f);
    ASSERT_NEAR(left[i] + 0.5f * right[i], mixed[i], 1e-4f * whole[i] + 1e-6f);
  }
  EXPECT_FALSE(layers->image(2));
  EXPECT_FALSE(layers->mix({.lamps = {{"Middle", "50%"}}}));
  const auto dimmed = layers->display({.lamps = {{"*", "20%"}}}), bright = layers->display();
  ASSERT_TRUE(dimmed && bright);
  EXPECT_LT(dimmed->samples[3 * 64 * 24 + 96], bright->samples[3 * 64 * 24 + 96]);
}

TEST(LibraryLayers, AreReadBackFromTheirFile) {
  const roomlight::testing::TemporaryFolder folder;
  Settings settings = quick();
  settings.layers = true;
  const auto picture = render(room(), {}, settings);
  ASSERT_TRUE(picture && picture->write(folder / "layers.exr"));
  const auto opened = Layers::open(folder / "layers.exr");
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_TRUE(pixelsOf(*opened->mix()) == pixelsOf(*picture->layers()->mix()));
  EXPECT_FALSE(Layers::open(folder / "none.exr"));
}

TEST(LibraryMeasure, RoomsAreReported) {
  MeterOptions options;
  options.quality = "draft", options.daylightFactor = true;
  const auto report = measure(room(), options);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_NE(report->table().find("mean lx"), std::string::npos);
  EXPECT_EQ(report->json().front(), '{');
  EXPECT_TRUE(report->csv().starts_with("kind,name,room"));
  EXPECT_NE(report->html().find("<html"), std::string::npos);
  options.tolerance = 3;
  EXPECT_FALSE(measure(room(), options));
}

TEST(LibraryMeasure, BadMetersAreNamed) {
  MeterOptions options;
  options.quality = "draft";
  const auto meters = Meters::of(room(), options);
  ASSERT_TRUE(meters);
  const float numbers[] = {1, 1, 1, 0, 0, 0};
  EXPECT_FALSE(meters->illuminance(numbers, std::span(numbers).first(3)));
  EXPECT_TRUE(meters->illuminance(numbers, numbers).error().message.starts_with("meter 1: "));
  EXPECT_TRUE(meters->illuminance({}, {}).value().empty());
  const float far[] = {1e30f, 1, 1}, up[] = {0, 1, 0};
  EXPECT_EQ(meters->illuminance(far, up).error().message,
            "meter 0: its position must be within 1000 km and its normal not zero");
}

}  // namespace
}  // namespace roomlight::test
