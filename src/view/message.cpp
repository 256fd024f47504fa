#include "view/message.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/utf8.h"
#include "json/json_file.h"
#include "json/json_reader.h"
#include "photometry/colour_temperature.h"
#include "view/message_edit.h"

namespace roomlight::view {
namespace {

constexpr size_t kLongestName = 60, kLongestGesture = 40;

uint32_t whole(const JsonPlace& j) {
  const double v = j.number(0, 4294967295.0);
  if (v != std::floor(v)) j.fail("must be a whole number");
  return static_cast<uint32_t>(v);
}

std::string shortText(const JsonPlace& j, size_t most) {
  std::string text = j.text();
  if (text.empty() || text.size() > most) j.fail(fmt::format("must have 1 to {} characters", most));
  return text;
}

Vec3 unit(const JsonPlace& j) {
  const Vec3 d = j.vector(-kFarthestM, kFarthestM);
  if (length(d) > 1e-6f) return normalize(d);
  j.fail("must have a length");
  return {0, 0, -1};
}

Message readViewport(const JsonPlace& j) {
  if (!j.isObject({"type", "width", "height", "pixelRatio"})) return {};
  const auto size = [&](const char* key) { return static_cast<int>(std::lround(j[key].number(16, 16384))); };
  return Viewport{size("width"), size("height"), static_cast<float>(j.number("pixelRatio", 0.25, 8, 1))};
}

Message readCamera(const JsonPlace& j) {
  if (!j.isObject({"type", "number", "position", "target", "direction", "up", "verticalFov", "cutHeight"})) return {};
  ViewCamera camera;
  if (j.has("number")) camera.number = whole(j["number"]);
  camera.position = j["position"].vector(-kFarthestM, kFarthestM);
  if (j.has("target") == j.has("direction")) {
    j.fail("needs either 'target' or 'direction'");
  } else if (j.has("direction")) {
    camera.direction = unit(j["direction"]);
  } else {
    const Vec3 d = j["target"].vector(-kFarthestM, kFarthestM) - camera.position;
    if (length(d) > 1e-4f) {
      camera.direction = normalize(d);
    } else {
      j["target"].fail("is where the camera is");
    }
  }
  if (j.has("up")) camera.up = unit(j["up"]);
  camera.yFovDeg = static_cast<float>(j.number("verticalFov", 5, 150, 55));
  if (j.has("cutHeight") && !j["cutHeight"].isNull())
    camera.cutHeightM = static_cast<float>(j["cutHeight"].number(-kFarthestM, kFarthestM));
  return camera;
}

std::optional<double> endOfScale(const JsonPlace& j) {
  return j.isNull() ? std::optional<double>() : j.number(1e-6, 1e9);
}

Message readDisplay(const JsonPlace& j) {
  if (!j.isObject({"type", "exposure", "compensation", "curve", "whiteBalance", "falseColor", "low", "high"}))
    return {};
  DisplayChange out;
  if (j.has("exposure"))
    out.ev100.emplace(j["exposure"].isText("auto") ? std::optional<float>()
                                                   : static_cast<float>(j["exposure"].number(-10, 25)));
  if (j.has("compensation")) out.compensationEv = static_cast<float>(j["compensation"].number(-10, 10));
  if (j.has("curve")) out.curve = toneCurveFromName(j["curve"].oneOf(toneCurveNames())).value();
  if (j.has("whiteBalance")) {
    const JsonPlace white = j["whiteBalance"];
    out.automaticWhite = white.isText("auto");
    out.whiteK.emplace(*out.automaticWhite || white.isText("none") ? std::optional<double>()
                                                                   : white.number(kLowestWhiteK, kHighestWhiteK));
  }
  if (j.has("falseColor")) {
    const std::string word = j["falseColor"].oneOf({"off", "illuminance", "luminance"});
    out.falseColour = word == "off"         ? FalseColour::Off
                      : word == "luminance" ? FalseColour::Luminance
                                            : FalseColour::Illuminance;
  }
  if (j.has("low")) out.low.emplace(endOfScale(j["low"]));
  if (j.has("high")) out.high.emplace(endOfScale(j["high"]));
  return out;
}

SplitSide readSide(const JsonPlace& j) {
  SplitSide side;
  if (!j.isObject({"technique", "plan"})) return side;
  if (j.has("technique")) side.technique = shortText(j["technique"], kLongestName);
  if (j.has("plan")) side.plan = shortText(j["plan"], kLongestName);
  return side;
}

Message readSplit(const JsonPlace& j) {
  if (!j.isObject({"type", "id", "split"})) return {};
  ChooseSplit out{whole(j["id"]), {}};
  const JsonPlace split = j["split"];
  if (!split.isNull() && split.isObject({"left", "right"}))
    out.split = Split{readSide(split["left"]), readSide(split["right"])};
  return out;
}

Message readEdit(const JsonPlace& j) {
  if (!j.isObject({"type", "id", "target", "gesture", "position", "direction", "dim", "on", "temperatureK", "color",
                   "fluxLm", "move", "turn", "alone", "hidden", "material", "open", "date", "hour"}))
    return {};
  Edit edit{whole(j["id"]), shortText(j["target"], kLongestName), {}, readEditFields(j)};
  if (j.has("gesture")) edit.gesture = shortText(j["gesture"], kLongestGesture);
  return edit;
}

Message readPlan(const JsonPlace& j) {
  if (!j.isObject({"type", "id", "do", "name"})) return {};
  const std::string what = j["do"].oneOf({"keep", "apply", "drop"});
  return EditPlan{whole(j["id"]),
                  what == "keep"    ? EditPlan::Do::Keep
                  : what == "apply" ? EditPlan::Do::Apply
                                    : EditPlan::Do::Drop,
                  shortText(j["name"], kLongestName)};
}

Message readPoint(const JsonPlace& j, bool meter) {
  if (!j.isObject({"type", "id", "x", "y"})) return {};
  return Point{whole(j["id"]), static_cast<float>(j["x"].number(0, 1)), static_cast<float>(j["y"].number(0, 1)), meter};
}

Message readRender(const JsonPlace& j) {
  if (!j.isObject({"type", "id", "kind", "width", "height", "technique", "quality", "seconds", "format"})) return {};
  RenderWish wish;
  wish.id = whole(j["id"]);
  wish.panorama = j["kind"].oneOf({"picture", "panorama"}) == "panorama";
  if (j.has("width") != j.has("height")) j.fail("needs 'width' and 'height', or neither");
  wish.width = static_cast<int>(j.number("width", 16, 7680, 0)),
  wish.height = static_cast<int>(j.number("height", 16, 4320, 0));
  if (j.has("technique")) wish.technique = shortText(j["technique"], kLongestName);
  if (j.has("quality")) wish.quality = shortText(j["quality"], kLongestName);
  if (j.has("format")) wish.format = j["format"].oneOf({"png", "jpg", "exr"});
  wish.seconds = j.number("seconds", 1, 86400, 0);
  return wish;
}

Message readStep(const JsonPlace& j, bool back) {
  if (!j.isObject({"type", "id"})) return {};
  return StepHistory{whole(j["id"]), back};
}

struct Reader {
  const char* type;
  Message (*read)(const JsonPlace&);
};
constexpr std::array kReaders = {
    Reader{"viewport", readViewport},
    Reader{"camera", readCamera},
    Reader{"display", readDisplay},
    Reader{"technique",
           [](const JsonPlace& j) -> Message {
             return j.isObject({"type", "id", "technique"})
                        ? Message(ChooseTechnique{whole(j["id"]), shortText(j["technique"], kLongestName)})
                        : Message();
           }},
    Reader{"split", readSplit},
    Reader{"edit", readEdit},
    Reader{"undo", [](const JsonPlace& j) { return readStep(j, true); }},
    Reader{"redo", [](const JsonPlace& j) { return readStep(j, false); }},
    Reader{"plan", readPlan},
    Reader{"pick", [](const JsonPlace& j) { return readPoint(j, false); }},
    Reader{"meter", [](const JsonPlace& j) { return readPoint(j, true); }},
    Reader{"render", readRender},
    Reader{"cancel",
           [](const JsonPlace& j) -> Message {
             return j.isObject({"type", "id", "job"})
                        ? Message(CancelJob{whole(j["id"]), shortText(j["job"], kLongestName)})
                        : Message();
           }},
    Reader{"save",
           [](const JsonPlace& j) -> Message {
             return j.isObject({"type", "id"}) ? Message(SaveLighting{whole(j["id"])}) : Message();
           }},
    Reader{"ack",
           [](const JsonPlace& j) -> Message {
             return j.isObject({"type", "frame"}) ? Message(Ack{whole(j["frame"])}) : Message();
           }},
    Reader{"ping",
           [](const JsonPlace& j) -> Message {
             return j.isObject({"type", "id"}) ? Message(Ping{whole(j["id"])}) : Message();
           }},
};

// The id of a request, if it can be read, so that who asked hears of its error.
std::optional<uint32_t> idOf(const nlohmann::json& document) {
  if (!document.is_object() || !document.contains("id") || !document["id"].is_number_unsigned()) return {};
  const auto id = document["id"].get<uint64_t>();
  return id <= 0xffffffffu ? std::optional(static_cast<uint32_t>(id)) : std::nullopt;
}

// "verticalFov: 4 is out of range" or "'position' is missing": the key, if it begins with one, and the rest.
ViewError badField(std::optional<uint32_t> id, const std::string& error) {
  const size_t colon = error.find(": ");
  const std::string head = error.substr(0, colon);
  const bool isPath = colon != std::string::npos && head.find(' ') == std::string::npos;
  if (isPath) return {id, "badField", head, error.substr(colon + 2)};
  const size_t open = error.find('\''), close = open == std::string::npos ? open : error.find('\'', open + 1);
  return {id, "badField", close == std::string::npos ? "" : error.substr(open + 1, close - open - 1), error};
}

}  // namespace

Message readMessage(std::string_view text) {
  if (text.size() > kMostMessageBytes)
    return ViewError{{}, "badMessage", "", fmt::format("longer than {} bytes", kMostMessageBytes)};
  const Result<nlohmann::json> document = parseJson(text);
  if (!document) return ViewError{{}, "badMessage", "", document.error()};
  std::string error;
  const JsonPlace j(document.value(), "", error);
  const std::optional<uint32_t> id = idOf(document.value());
  if (!document.value().is_object() || !j.has("type") || !document.value()["type"].is_string())
    return ViewError{id, "badMessage", "type", "must be an object with a type"};
  const std::string type = j["type"].text();
  for (const Reader& reader : kReaders) {
    if (type != reader.type) continue;
    Message message = reader.read(j);
    if (!error.empty()) return badField(id, error);
    return message;
  }
  return ViewError{id, "badMessage", "type", fmt::format("unknown type '{}'", printable(type, 60))};
}

}  // namespace roomlight::view
