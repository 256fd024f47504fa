// roomlight mix: a picture in layers to pictures of any state of its lamps.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "arguments.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "commands.h"
#include "console.h"
#include "engine/settings.h"
#include "exit_status.h"
#include "mix/layer_info.h"
#include "mix_pictures.h"
#include "output_files.h"
#include "picture_options.h"

namespace roomlight::cli {
namespace {

constexpr float kWebpQuality = 90;
constexpr const char* kOfThisMix = "mix";  // automatic, but not of the unmixed picture

struct MixOptions {
  DialOptions dials;
  DisplayOptions display;
  std::string file, statesFolder, overlaysFolder, format, blend = "auto", cardFile, urlPrefix = "/local/floorplan/";
  std::vector<std::string> outputs, only, entities;
  int threads = 0;
  bool list = false, dimmed = false, quiet = false;
};

Status checkFormat(const MixOptions& o) {
  const bool jpeg = o.format == "jpg" && o.overlaysFolder.empty();
  if (!o.format.empty() && o.format != "png" && o.format != "webp" && !jpeg) {
    return Error{fmt::format("--format {}: write png or webp{}", o.format,
                             o.overlaysFolder.empty() ? " or jpg" : "; overlays are transparent")};
  }
  if (o.format.empty() || !o.statesFolder.empty() || !o.overlaysFolder.empty()) return Ok{};
  return Error{"--format goes with --states or --overlays"};
}

// Served from there by pages and cards, which quote it.
Status checkUrlPrefix(const std::string& prefix) {
  const bool plain = std::none_of(prefix.begin(), prefix.end(), [](unsigned char c) {
    return c <= 0x20 || c == 0x7f || std::string_view("\"'<>`\\").find(static_cast<char>(c)) != std::string_view::npos;
  });
  return plain ? Status(Ok{})
               : Error{
                     "--url-prefix: holds a space, a quote, a bracket, a backslash or a control character; write such "
                     "letters as %20"};
}

Status checkFolder(const std::string& option, const std::string& folder) {
  std::error_code ignored;
  if (folder.empty() || !std::filesystem::exists(folder, ignored) || std::filesystem::is_directory(folder, ignored))
    return Ok{};
  return Error{fmt::format("{} {}: is a file; name a folder", option, folder)};
}

Status checkMixOutputs(const MixOptions& o) {
  if (!o.list && o.outputs.empty() && o.statesFolder.empty() && o.overlaysFolder.empty())
    return Error{"nothing to do; write -o OUT, --states DIR, --overlays DIR or --list"};
  for (const std::string& out : o.outputs) {
    const std::string e = lowerExtension(out);
    if (e != ".exr" && e != ".png" && e != ".jpg" && e != ".webp")
      return Error{fmt::format("{}: unknown kind of picture '{}'; use .exr, .png, .jpg or .webp", out, e)};
    if (const Status s = checkWritable(out); !s) return s;
  }
  if (const Status s = checkFormat(o); !s) return s;
  if (const Status s = checkFolder("--states", o.statesFolder); !s) return s;
  if (const Status s = checkFolder("--overlays", o.overlaysFolder); !s) return s;
  if (const Status s = checkUrlPrefix(o.urlPrefix); !s) return s;
  if (!o.only.empty() && o.statesFolder.empty() && o.overlaysFolder.empty())
    return Error{"--only goes with --states or --overlays"};
  if (o.overlaysFolder.empty() && (!o.cardFile.empty() || o.blend != "auto"))
    return Error{"--home-assistant and --blend go with --overlays DIR"};
  if (o.cardFile.empty() && (!o.entities.empty() || o.dimmed))
    return Error{"--entity and --dimmed go with --home-assistant FILE"};
  if (!o.cardFile.empty() && lowerExtension(o.cardFile) != ".yaml" && lowerExtension(o.cardFile) != ".yml")
    return Error{fmt::format("--home-assistant {}: name a .yaml file", o.cardFile)};
  std::vector<std::string> files = {o.file, o.cardFile, o.dimmed ? sensorsFileOf(o.cardFile).string() : "",
                                    o.statesFolder, o.overlaysFolder};
  files.insert(files.end(), o.outputs.begin(), o.outputs.end());
  if (const Status s = checkDistinct(files); !s) return s;
  return o.cardFile.empty() ? Status(Ok{}) : checkWritable(o.cardFile);
}

Result<std::optional<BlendMode>> blendOf(const std::string& name) {
  if (name == "auto") return std::optional<BlendMode>();
  for (const BlendMode blend : kBlendModes) {
    if (name == cssName(blend)) return std::optional<BlendMode>(blend);
  }
  return Error{fmt::format("--blend {}: write auto, screen, normal, plus-lighter or lighten", name)};
}

// At commas; \, stands for a comma within a name.
std::vector<std::string> splitNames(const std::string& text) {
  std::vector<std::string> names(1);
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == ',') {
      names.back() += text[++i];
    } else if (text[i] == ',') {
      names.emplace_back();
    } else {
      names.back() += text[i];
    }
  }
  return names;
}

// A whole text may be one name with commas in it.
std::vector<std::string> namesOf(const MixHome& home, const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  for (const std::string& text : texts) {
    const bool isName = std::any_of(home.layers.begin(), home.layers.end(),
                                    [&](const LayerInfo& l) { return isLamp(l) && l.name == text; });
    const std::vector<std::string> parts = isName ? std::vector{text} : splitNames(text);
    names.insert(names.end(), parts.begin(), parts.end());
  }
  return names;
}

// Lamps named by --only, else all; without those that are off anyway.
Result<Switches> switchesOf(const MixHome& home, const Mixture& mixture, const std::vector<std::string>& only) {
  Switches switches{mixture.gains, {}};
  std::vector<bool> wanted(home.layers.size());
  for (const std::string& name : namesOf(home, only)) {
    const Result<std::vector<size_t>> found = findLamps(home.layers, name);
    if (!found) return Error{"--only: " + found.error()};
    for (const size_t i : found.value()) {
      if (isBlack(mixture.gains[i]))
        return Error{fmt::format("--only: '{}' is switched off by --lamp in every state", home.layers[i].name)};
      wanted[i] = true;
    }
  }
  for (size_t i = 0; i < home.layers.size(); ++i) {
    if (isLamp(home.layers[i]) && !isBlack(mixture.gains[i]) && (only.empty() || wanted[i]))
      switches.lamps.push_back(i);
  }
  if (switches.lamps.empty()) return Error{"there is no lamp to switch"};
  return switches;
}

Result<std::map<size_t, std::string>> entitiesOf(const MixHome& home, const std::vector<std::string>& texts) {
  std::map<size_t, std::string> entities;
  for (const std::string& text : texts) {
    const Result<Assignment> a = splitAssignment("--entity", text);
    if (!a) return Error{a.error()};
    const std::string& id = a.value().value;
    const bool plain = std::all_of(id.begin(), id.end(), [](unsigned char c) {
      return std::islower(c) || std::isdigit(c) || c == '_' || c == '.';
    });
    const size_t dot = id.find('.');
    if (!plain || dot == std::string::npos || dot == 0 || dot + 1 >= id.size() || id.rfind('.') != dot)
      return Error{fmt::format("--entity {}: write an entity id of Home Assistant, for example light.sofa", text)};
    const Result<std::vector<size_t>> found = findLamps(home.layers, a.value().name);
    if (!found) return Error{"--entity: " + found.error()};
    for (const size_t i : found.value()) entities[i] = id;
  }
  return entities;
}

Metadata metadataOf(const MixOptions& o, const MixHome& home, const Mixture& mixture, const ShownMix& shown) {
  std::string gains;
  for (size_t i = 0; i < home.layers.size(); ++i) {
    const Vec3 g = mixture.gains[i];
    gains += fmt::format("{}{}: {:.4g} {:.4g} {:.4g}", i ? "; " : "", home.layers[i].name, g.x, g.y, g.z);
  }
  return {{"roomlight.version", version()},
          {"roomlight.layers", o.file},
          {"roomlight.gains", gains},
          {"roomlight.exposureEv100", fmt::format("{}", shown.look.ev100)},
          {"roomlight.tone", std::string(toneCurveName(shown.look.tone.curve))},
          {"roomlight.whiteK", fmt::format("{:.0f}", shown.white.kelvin)},
          {"roomlight.whiteGains",
           fmt::format("{:.4f} {:.4f} {:.4f}", shown.white.gains.x, shown.white.gains.y, shown.white.gains.z)}};
}

// Pictures to look at, or linear ones.
Status writeOutputs(const MixOptions& o, bool linear, const MixHome& home, const Mixture& mixture,
                    const ShownMix& shown, ProgressDisplay& display) {
  const Metadata metadata = metadataOf(o, home, mixture, shown);
  for (const std::string& out : o.outputs) {
    if ((lowerExtension(out) == ".exr") != linear) continue;
    Stopwatch mixing;
    double mixMs = 0;
    Status s = Ok{};
    if (linear) {
      const Image image = linearMix(home, mixture.gains);
      mixMs = mixing.seconds() * 1e3;
      s = writeExr(out, image, metadata);
    } else {
      const ByteImage image = displayMix(home, mixture.gains, shown.look, lowerExtension(out) != ".jpg");
      mixMs = mixing.seconds() * 1e3;
      s = writeBytes(out, image, metadata, kWebpQuality);
    }
    if (!s) return s;
    display.line(fmt::format("wrote {}: {} layers mixed in {:.1f} ms", out, home.layers.size(), mixMs));
  }
  return Ok{};
}

// What is left to be wrong once the layers are known; then the pictures.
int workMix(const MixOptions& o, const Display& how, const FollowMix& follow, const std::optional<BlendMode>& blend) {
  ProgressDisplay display(o.quiet);
  Result<MixHome> opened = openLayers(o.file);
  if (!opened) return failed(opened.error());
  MixHome& home = opened.value();
  const Result<Mixture> mixture = mixtureOf(home.layers, o.dials);
  if (!mixture) return failed(mixture.error());
  const Result<std::map<size_t, std::string>> entities = entitiesOf(home, o.entities);
  if (!entities) return failed(entities.error());
  std::optional<Switches> switches;
  if (!o.statesFolder.empty() || !o.overlaysFolder.empty()) {
    Result<Switches> found = switchesOf(home, mixture.value(), o.only);
    if (!found) return failed(found.error());
    switches = std::move(found).value();
    const size_t lamps = switches->lamps.size();
    if (!o.statesFolder.empty() && lamps > kMostSwitchedLamps) {
      return failed(
          fmt::format("--states: {} lamps have 2^{} states; at most {} lamps (65536 pictures) are switched: choose "
                      "them with --only",
                      lamps, lamps, kMostSwitchedLamps));
    }
  }
  if (o.list) fmt::print("{}", layerTable(home.layers));
  if (o.outputs.empty() && !switches) return kOk;
  const ShownMix shown = showMix(home, mixture.value(), how, follow);
  if (const Status s = writeOutputs(o, true, home, mixture.value(), shown, display); !s)
    return failed(s.error(), kFailed);
  applyLook(home, shown);
  if (const Status s = writeOutputs(o, false, home, mixture.value(), shown, display); !s)
    return failed(s.error(), kFailed);
  const Metadata metadata = metadataOf(o, home, mixture.value(), shown);
  const auto extension = [&](const char* usual) { return "." + (o.format.empty() ? std::string(usual) : o.format); };
  int code = kOk;
  if (!o.statesFolder.empty())
    code = writeStates(home, *switches, shown, metadata, {o.statesFolder, extension("webp")}, display);
  if (code == kOk && !o.overlaysFolder.empty()) {
    const std::string prefix = o.urlPrefix + (o.urlPrefix.ends_with('/') ? "" : "/");
    code = writeOverlays(home, *switches, shown, metadata,
                         {o.overlaysFolder, extension("png"), blend, o.cardFile, prefix, o.dimmed, entities.value()},
                         display);
  }
  return code;
}

int runMix(const MixOptions& o) {
  interrupted();  // from here on Ctrl-C is ours
  DisplayOptions display = o.display;
  const FollowMix follow{display.exposure == kOfThisMix, display.whiteBalance == kOfThisMix};
  if (follow.exposure) display.exposure = "auto";
  if (follow.white) display.whiteBalance = "auto";
  const Result<Display> how = readDisplay(display);
  if (!how) return failed(how.error());
  const Result<std::optional<BlendMode>> blend = blendOf(o.blend);
  if (!blend) return failed(blend.error());
  if (const Status s = checkMixOutputs(o); !s) return failed(s.error());
  int code = kFailed;
  withThreads(o.threads, [&] { code = workMix(o, how.value(), follow, blend.value()); });
  return code;
}

}  // namespace

Registered addMix(CLI::App& program) {
  const auto o = std::make_shared<MixOptions>();
  CLI::App* app =
      program.add_subcommand("mix", "Dim, colour and switch the lamps of a picture in layers, without rendering again");
  const auto each = [](CLI::Option* option) {
    option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  app->add_option("LAYERS", o->file, "Picture in layers (.exr) by render --layers")->required();
  each(app->add_option("-o,--output", o->outputs,
                       "Picture: .exr (linear, cd/m2), .png, .webp or .jpg; may be repeated"));
  each(app->add_option("--lamp", o->dials.lamps,
                       "NAME=60%, =off, =2700K, =#ffd080 or with commas between; * and ? stand for any text and "
                       "letter; may be repeated, the last one counts"));
  app->add_option("--kelvin", o->dials.kelvin, "Colour temperature of all lamps whose colour --lamp does not say");
  app->add_option("--sun", o->dials.sun, "Sunlight: 50%, off, ...");
  app->add_option("--sky", o->dials.sky, "Light of the sky: 50%, off, ...");
  addDisplayOptions(*app, o->display, ".png, .webp and .jpg");
  for (const char* name : {"--exposure", "--white-balance"}) {
    CLI::Option* option = app->get_option(name);
    option->description(
        fmt::format("{}. Automatic values are those of the unmixed picture, so that dimmed lamps look dimmed; {}: "
                    "those of this mix",
                    option->get_description(), kOfThisMix));
  }
  app->add_flag("--list", o->list, "Print the layers: kind, colour, flux, room");
  app->add_option("--states", o->statesFolder, "Write a picture of every on/off state of the lamps to this folder");
  app->add_option(
      "--overlays", o->overlaysFolder,
      "Write the picture without lamps, a transparent overlay a lamp and a page that shows them to this folder");
  app->add_option("--only", o->only,
                  "Lamps that are switched, with commas between (\\, is a comma within a name); may be repeated; the "
                  "others shine as --lamp says");
  app->add_option("--format", o->format, "Of states (default webp, or png, jpg) and overlays (default png, or webp)");
  app->add_option("--blend", o->blend,
                  "How overlays are laid: screen, normal, plus-lighter, lighten, or auto: what errs least")
      ->capture_default_str();
  app->add_option("--home-assistant", o->cardFile, "Write the YAML of a picture-elements card that shows the overlays");
  each(app->add_option("--entity", o->entities,
                       "NAME=light.sofa: the entity of a lamp, if it is not light. and its name; may be repeated"));
  app->add_option("--url-prefix", o->urlPrefix, "Where Home Assistant serves the overlays from")->capture_default_str();
  app->add_flag("--dimmed", o->dimmed,
                "The card shows brightness in steps of 10 %, by template sensors in a second file");
  app->add_option("--threads", o->threads, "Threads; 0: all cores")->check(CLI::Range(0, 4096));
  app->add_flag("--quiet", o->quiet, "Only errors");
  app->footer(
      "Examples:\n"
      "  roomlight mix layers.exr --list\n"
      "  roomlight mix layers.exr --lamp \"Sofa lamp\"=60% --lamp \"Kitchen*\"=off --kelvin 2700 --sun 50% -o "
      "evening.png\n"
      "  roomlight mix layers.exr --sun off --overlays plan --home-assistant plan/card.yaml");
  return {app, [o] { return runMix(*o); }};
}

}  // namespace roomlight::cli
