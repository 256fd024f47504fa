// What somebody in front of `roomlight view` gets: frames a second while walking, while a thing and a lamp are moved,
// and how far the light is 0.3 s after they have. A session without network, told what a browser would tell it and
// acknowledging every frame at once; JPEG included. JSON on standard output. scripts/measure_view runs it on the sample
// homes.
#include <fmt/format.h>
#include <turbojpeg.h>

#include <cstring>
#include <deque>
#include <fstream>
#include <iostream>
#include <memory>

#include "base/progress.h"
#include "base/tone.h"
#include "engine/render.h"
#include "import/walk_file.h"
#include "view/open_home.h"
#include "view/session.h"

namespace roomlight {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;
constexpr int kWidth = 960, kHeight = 540;
constexpr double kTellEveryS = 1.0 / 60;  // as browsers draw

struct Frame {
  Clock::time_point at;
  int width = 0, height = 0;
  uint8_t flags = 0;
  uint32_t number = 0, samples = 0, revision = 0;
  float ev100 = 0, latencyMs = 0, pictureMs = 0;
  std::string jpeg;
  bool behind() const { return flags & view::kLightIsBehind; }
};

template <class T>
T valueAt(const std::string& bytes, size_t at) {
  T out;
  std::memcpy(&out, bytes.data() + at, sizeof out);
  return out;
}

// The browser's side: frames are acknowledged from the session's own thread.
class Browser {
 public:
  explicit Browser(view::ViewHome home, const RenderSettings& settings)
      : session_(std::move(home), settings,
                 {[this](view::Connection, const std::string& text) { hear(text); },
                  [this](view::Connection, const std::string& bytes) { see(bytes); },
                  [](const std::string& line) { fmt::print(stderr, "{}\n", line); }}) {
    session_.open(1, "");
  }
  void say(const json& message) { session_.receive(1, message.dump()); }
  // Waits for the first frame since the last call that `wanted` likes; those before are forgotten.
  template <class Wanted>
  Frame wait(Wanted wanted, double seconds = 300) {
    std::unique_lock lock(mutex_);
    const auto until = Clock::now() + std::chrono::duration<double>(seconds);
    for (;;) {
      while (!frames_.empty()) {
        const Frame f = std::move(frames_.front());
        frames_.pop_front();
        if (wanted(f)) return f;
      }
      if (news_.wait_until(lock, until) == std::cv_status::timeout) throw std::runtime_error("no such frame");
    }
  }
  std::vector<Frame> takeAll() {
    const std::lock_guard lock(mutex_);
    std::vector<Frame> out(std::make_move_iterator(frames_.begin()), std::make_move_iterator(frames_.end()));
    frames_.clear();
    return out;
  }
  json welcome() {
    std::unique_lock lock(mutex_);
    news_.wait(lock, [&] { return !welcome_.is_null(); });
    return welcome_;
  }

 private:
  void hear(const std::string& text) {
    const json message = json::parse(text);
    const std::lock_guard lock(mutex_);
    if (message["type"] == "welcome") welcome_ = message;
    if (message["type"] == "error") fmt::print(stderr, "{}\n", text);
    news_.notify_all();
  }
  void see(const std::string& bytes) {
    Frame f;
    f.at = Clock::now();
    f.number = valueAt<uint32_t>(bytes, 4), f.width = valueAt<uint16_t>(bytes, 8),
    f.height = valueAt<uint16_t>(bytes, 10), f.flags = valueAt<uint8_t>(bytes, 13);
    f.revision = valueAt<uint32_t>(bytes, 20), f.samples = valueAt<uint32_t>(bytes, 24);
    f.ev100 = valueAt<float>(bytes, 32), f.latencyMs = valueAt<float>(bytes, 44),
    f.pictureMs = valueAt<float>(bytes, 48);
    f.jpeg = bytes.substr(view::kFrameHeaderBytes);
    session_.receive(1, json{{"type", "ack"}, {"frame", f.number}}.dump());
    const std::lock_guard lock(mutex_);
    frames_.push_back(std::move(f));
    news_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable news_;
  std::deque<Frame> frames_;
  json welcome_;
  view::Session session_;
};

// Linear, in units of the exposure that all frames share.
Image linear(const std::string& jpeg) {
  const std::unique_ptr<void, int (*)(tjhandle)> reader(tjInitDecompress(), tjDestroy);
  int width = 0, height = 0, sub = 0, space = 0;
  const auto* bytes = reinterpret_cast<const unsigned char*>(jpeg.data());
  tjDecompressHeader3(reader.get(), bytes, jpeg.size(), &width, &height, &sub, &space);
  std::vector<unsigned char> pixels(static_cast<size_t>(width) * static_cast<size_t>(height) * 3);
  tjDecompress2(reader.get(), bytes, jpeg.size(), pixels.data(), width, 0, height, TJPF_RGB, 0);
  Image out(width, height);
  for (size_t i = 0; i < out.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      out.pixels[i][c] = srgbDecode(static_cast<float>(pixels[3 * i + static_cast<size_t>(c)]) / 255);
  }
  return out;
}

// Mean absolute difference of blocks of about 1/60 of the width, over the mean; in %.
double difference(const Image& a, const Image& b) {
  constexpr int kAcross = 60, kDown = 34;
  const auto block = [&](const Image& image, int x, int y) {
    double sum = 0;
    int count = 0;
    for (int j = y * image.height / kDown; j < (y + 1) * image.height / kDown; ++j) {
      for (int i = x * image.width / kAcross; i < (x + 1) * image.width / kAcross; ++i)
        sum += static_cast<double>(luminance(image.at(i, j))), ++count;
    }
    return sum / std::max(1, count);
  };
  double apart = 0, all = 0;
  for (int y = 0; y < kDown; ++y) {
    for (int x = 0; x < kAcross; ++x) {
      const double p = block(a, x, y), q = block(b, x, y);
      apart += std::abs(p - q), all += q;
    }
  }
  return 100 * apart / all;
}

json ratesOf(const std::vector<Frame>& frames) {
  std::vector<double> apart, latency;
  size_t whole = 0;
  double picture = 0;
  for (size_t i = 0; i < frames.size(); ++i) {
    if (i > 0) apart.push_back(std::chrono::duration<double, std::milli>(frames[i].at - frames[i - 1].at).count());
    if (frames[i].latencyMs > 0) latency.push_back(static_cast<double>(frames[i].latencyMs));
    whole += frames[i].width == kWidth;
    picture += static_cast<double>(frames[i].pictureMs) / static_cast<double>(frames.size());
  }
  if (apart.size() < 5) return {{"frames", frames.size()}};
  std::vector<std::pair<int, int>> sizes;
  for (const Frame& f : frames) sizes.emplace_back(f.width, f.height);
  std::sort(sizes.begin(), sizes.end());
  std::sort(apart.begin(), apart.end()), std::sort(latency.begin(), latency.end());
  const auto at = [](const std::vector<double>& v, double share) {
    return v.empty() ? 0 : v[std::min(v.size() - 1, static_cast<size_t>(share * static_cast<double>(v.size())))];
  };
  return {{"frames", frames.size()},
          {"medianFps", 1e3 / at(apart, 0.5)},
          {"worstFps", 1e3 / at(apart, 0.99)},
          {"size", fmt::format("{}x{}", sizes[sizes.size() / 2].first, sizes[sizes.size() / 2].second)},
          {"whole", static_cast<double>(whole) / static_cast<double>(frames.size())},
          {"pictureMs", picture},
          {"latencyMs", at(latency, 0.5)}};
}

// One line a frame: when it came, its size, what it took.
void keepFrames(const std::string& file, const std::vector<Frame>& frames) {
  std::ofstream out(file);
  out << "ms,width,height,flags,pictureMs,latencyMs,bytes\n";
  for (const Frame& f : frames) {
    const double ms = std::chrono::duration<double, std::milli>(f.at - frames.front().at).count();
    out << fmt::format("{:.1f},{},{},{},{:.1f},{:.1f},{}\n", ms, f.width, f.height, f.flags, f.pictureMs, f.latencyMs,
                       f.jpeg.size());
  }
}

void sleepUntil(Clock::time_point at) { std::this_thread::sleep_until(at); }

// Tells something sixty times a second and returns the frames that came meanwhile, without those of the first half
// second.
template <class Tell>
std::vector<Frame> during(Browser& browser, double seconds, Tell tell) {
  const auto start = Clock::now();
  bool begun = false;
  for (int i = 0; kTellEveryS * i < seconds; ++i) {
    sleepUntil(start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(kTellEveryS * i)));
    if (!begun && kTellEveryS * i > 0.5) browser.takeAll(), begun = true;
    tell(kTellEveryS * i);
  }
  return browser.takeAll();
}

json vec(Vec3 v) { return {v.x, v.y, v.z}; }

json cameraMessage(const Camera& camera) {
  const Affine& m = camera.worldFromCamera;
  return {{"type", "camera"},
          {"position", vec(m.w)},
          {"direction", vec(-m.z)},
          {"verticalFov", camera.yFovRad * 180 / kPi}};
}

bool isSettledLight(const Frame& f) { return !f.behind(); }

// One edit, and the picture 0.3 s later beside those that the light comes to: quick, and as good as it gets in a while.
json afterJump(Browser& browser, json edit, uint32_t& id, const std::string& keep) {
  browser.takeAll();
  edit["id"] = ++id;
  const auto start = Clock::now();
  browser.say(edit);
  sleepUntil(start + std::chrono::milliseconds(300));
  std::vector<Frame> soon = browser.takeAll();
  if (soon.empty()) return {{"frames", 0}};
  const Frame shown = soon.back();
  const Frame light = shown.behind() ? browser.wait(isSettledLight) : shown;
  const double lightS = std::chrono::duration<double>(light.at - start).count();
  const Frame good = browser.wait([](const Frame& f) { return f.samples >= 4 && !f.behind(); });
  const Image at300 = linear(shown.jpeg), settled = linear(good.jpeg);
  if (!keep.empty()) {
    std::ofstream(keep + "_300ms.jpg", std::ios::binary) << shown.jpeg;
    std::ofstream(keep + "_settled.jpg", std::ios::binary) << good.jpeg;
  }
  return {{"frames", soon.size()},
          {"firstMs", soon.front().latencyMs},
          {"lightS", lightS},
          {"offLightPercent", difference(at300, linear(light.jpeg))},
          {"offSettledPercent", difference(at300, settled)},
          {"quickOffSettledPercent", difference(linear(light.jpeg), settled)}};
}

int run(const std::string& homeFile, const std::string& lighting, const std::string& walkFile, double seconds,
        const std::string& keep) {
  home::OpenWish wish;
  wish.scene = homeFile, wish.lighting = lighting;
  Result<view::OpenedView> home = view::openHome(wish);
  if (!home) return fmt::print(stderr, "{}\n", home.error()), 1;
  std::optional<Walk> walk;
  if (!walkFile.empty()) {
    Result<Walk> read = readWalkFile(walkFile, home.value().home.scene);
    if (!read) return fmt::print(stderr, "{}\n", read.error()), 1;
    walk = std::move(read).value();
  }
  const RenderSettings settings =
      settingsFromJson(R"({"quality": "draft"})", "settings").value();  // for shorter waits: quick frames are the same
  const Stopwatch opening;
  Browser browser(std::move(home.value().home), settings);
  const json welcome = browser.welcome();
  const Camera first = cameraAt(*walk, 0);
  browser.say({{"type", "viewport"}, {"width", kWidth}, {"height", kHeight}});
  browser.say(cameraMessage(first));
  browser.wait([](const Frame&) { return true; }, 600);
  json out;
  out["openS"] = opening.seconds();
  browser.wait(isSettledLight);
  uint32_t id = 0;
  const auto walkAt = [&](double s) {
    const double period = 2 * walk->seconds, t = std::fmod(s, period);
    return cameraMessage(cameraAt(*walk, t < walk->seconds ? t : period - t));
  };
  const std::vector<Frame> walked = during(browser, seconds, [&](double s) { browser.say(walkAt(s)); });
  out["walk"] = ratesOf(walked);
  if (!keep.empty()) keepFrames(keep + "_walk.csv", walked);
  browser.say(cameraMessage(first));
  const Frame rested = browser.wait(isSettledLight);

  // The movable thing, and the lamp, nearest to what the camera looks at.
  const Vec3 eye = first.worldFromCamera.w, ahead = eye - first.worldFromCamera.z * 2.5f;
  const auto distanceTo = [&](const json& p) {
    return length(Vec3(p[0].get<float>(), p[1].get<float>(), p[2].get<float>()) - ahead);
  };
  json thing, lamp;
  for (const json& o : welcome["objects"]) {
    if (!o["movable"].get<bool>()) continue;
    const json middle = {(o["low"][0].get<float>() + o["high"][0].get<float>()) / 2,
                         (o["low"][1].get<float>() + o["high"][1].get<float>()) / 2,
                         (o["low"][2].get<float>() + o["high"][2].get<float>()) / 2};
    const float size = o["high"][0].get<float>() - o["low"][0].get<float>();
    if (size < 0.3f || size > 1.2f) continue;
    if (thing.is_null() || distanceTo(middle) < distanceTo(thing["middle"])) thing = o, thing["middle"] = middle;
  }
  for (const json& l : welcome["lamps"]) {
    if (!l["object"].is_null() || !l["movable"].get<bool>()) continue;
    if (lamp.is_null() || distanceTo(l["position"]) < distanceTo(lamp["position"])) lamp = l;
  }
  if (lamp.is_null()) {  // one that is moved with its body
    for (const json& l : welcome["lamps"]) {
      if (l["object"].is_null()) continue;
      if (lamp.is_null() || distanceTo(l["position"]) < distanceTo(lamp["position"])) lamp = l;
    }
  }
  // One exposure for all, half a stop darker than the automatic one, and no tone curve, so that pictures of different
  // light can be compared.
  browser.say({{"type", "display"}, {"exposure", rested.ev100 + 0.5f}, {"curve", "clip"}, {"whiteBalance", "none"}});
  browser.wait(isSettledLight);
  const auto moving = [&](const char* name, const json& what, bool isLamp) {
    if (what.is_null()) return;
    const auto edit = [&](Vec3 by) {
      json m = {{"type", "edit"}, {"id", ++id}, {"gesture", "drag"}};
      if (isLamp && what["object"].is_null()) {
        m["target"] = what["id"];
        m["position"] = {what["position"][0].get<float>() + by.x, what["position"][1].get<float>() + by.y,
                         what["position"][2].get<float>() + by.z};
      } else {
        m["target"] = isLamp ? what["object"] : what["id"];
        m["move"] = vec(by);
      }
      return m;
    };
    const auto circle = [&](double s) {
      return Vec3(0.3f * static_cast<float>(std::sin(2 * s)), 0, 0.3f * static_cast<float>(1 - std::cos(2 * s)));
    };
    json& of = out[name];
    const std::vector<Frame> moved = during(browser, seconds, [&](double s) { browser.say(edit(circle(s))); });
    of = ratesOf(moved);
    if (!keep.empty()) keepFrames(fmt::format("{}_{}.csv", keep, name), moved);
    of["name"] = what["name"];
    browser.say(edit({}));
    browser.wait(isSettledLight);
    of["jump"] = afterJump(browser, edit({0.3f, 0, 0.2f}), id, keep.empty() ? "" : keep + "_" + name);
    browser.say(edit({}));
    browser.wait(isSettledLight);
  };
  moving("thing", thing, false);
  moving("lamp", lamp, true);
  std::cout << out.dump() << "\n";
  return 0;
}

}  // namespace
}  // namespace roomlight

int main(int argc, char** argv) {
  if (argc < 4) return fmt::print(stderr, "view_rates HOME LIGHTING WALK [SECONDS [PICTURES]]\n"), 2;
  try {
    return roomlight::run(argv[1], argv[2], argv[3], argc > 4 ? std::stod(argv[4]) : 8, argc > 5 ? argv[5] : "");
  } catch (const std::exception& e) {
    fmt::print(stderr, "view_rates: {}\n", e.what());
    return 1;
  }
}
