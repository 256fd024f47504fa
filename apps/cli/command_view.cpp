// roomlight view: walk through a home in a browser.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>
#include <memory>

#include "arguments.h"
#include "base/platform/terminal.h"
#include "commands.h"
#include "console.h"
#include "engine/settings.h"
#include "engine/stages.h"
#include "engine/technique.h"
#include "exit_status.h"
#include "server/view_server.h"
#include "started_programs.h"
#include "view/open_home.h"

namespace roomlight::cli {
namespace {

struct ServeOptions : SceneOptions {
  std::string viewer, quality, address = "127.0.0.1";
  std::optional<std::string> technique;
  std::optional<int> threads;
  int port = 0, windows = 8;
  bool noOpen = false, quiet = false;
};

Result<RenderSettings> readSettings(const ServeOptions& o) {
  RenderSettings s;
  if (!o.quality.empty()) {
    if (const Status status = applyQuality(o.quality, s); !status) return Error{"--" + status.error()};
  }
  s.technique = o.technique.value_or(s.technique);
  s.threads = o.threads.value_or(s.threads);
  if (const Status status = checkSettings(s); !status) return Error{status.error()};
  if (const Status status = checkTechnique(s.technique); !status) return Error{status.error()};
  return s;
}

// Error: nobody can read them.
Status printLinks(const std::vector<std::string>& links) {
  const int reason = writeToOutput(fmt::format("{}\n", fmt::join(links, "\n")));
  if (reason == 0) return Ok{};
  return Error{fmt::format("nobody can read the page's link: standard output: {}", std::strerror(reason))};
}

int runView(const ServeOptions& o) {
  // Before the number is that of another file.
  if (!isOutputOpen())
    return failed("nobody can read the page's link: standard output is closed; leave it open", kFailed);
  const std::atomic<bool>& stop = interrupted();  // from here on Ctrl-C is ours
  const Result<RenderSettings> settings = readSettings(o);
  if (!settings) return failed(settings.error());
  Result<home::OpenWish> open = readSceneOptions(o);
  if (!open) return failed(open.error());
  open.value().allCameras = true;
  Result<server::StaticFiles> page =
      server::readStaticFiles(o.viewer.empty() ? pageFolder("viewer", "dist") : std::filesystem::path(o.viewer));
  if (!page) return failed(page.error());
  ProgressDisplay display(o.quiet);
  RenderProgress progress{[&](const std::string& stage, float f) { display.report(stage, f); }, &stop, {}};
  RenderStats stats;
  Stages loading(progress, stats);
  Result<view::OpenedView> home = loading.run("load", [&](const Progress&) { return view::openHome(open.value()); });
  if (!home) return failed(home.error());
  if (const Status s = writeAddedLight(o, home.value().opened); !s) return failed(s.error());
  if (!o.quiet) printOpened(o, home.value().opened);
  server::Options options;
  options.address = o.address;
  options.port = static_cast<uint16_t>(o.port);
  options.mostWindows = static_cast<size_t>(o.windows);
  std::optional<BrowserPage> shown;
  Status told = Ok{};
  server::Served tell;
  tell.listening = [&](const server::Links& links) {
    if (o.address != "127.0.0.1" && o.address != "::1")
      printWarnings({fmt::format(
          "--address {}: everybody who can reach it and has the link may look and change; nothing is encrypted",
          o.address)});
    told = printLinks(links.all);
    if (told && !o.noOpen) shown.emplace(links.here);
    return told;
  };
  tell.failed = [](const std::string& line) { printError(line); };
  const Status served =
      server::serveHome(std::move(home.value().home), settings.value(), options, std::move(page).value(), tell, stop);
  if (!told) return failed(told.error(), kFailed);
  return served ? kOk : failed(served.error());
}

}  // namespace

Registered addView(CLI::App& program) {
  const auto o = std::make_shared<ServeOptions>();
  CLI::App* app = program.add_subcommand("view", "Walk through a home in a browser, move things, dim lamps, read lux");
  addSceneOptions(*app, *o, "HOME");
  app->add_option("--technique", o->technique, listed("How light is computed:", describedTechniques()));
  app->add_option("--quality", o->quality, listed("How fine the light is kept:", qualities()));
  app->add_option("--port", o->port, "Port to listen on; 0: any that is free")
      ->capture_default_str()
      ->check(CLI::Range(0, 65535));
  app->add_option("--address", o->address,
                  "Address to listen on; anything but this machine's own lets others in; 0.0.0.0: all it has, with a "
                  "link for each")
      ->capture_default_str();
  app->add_option("--windows", o->windows, "Windows that may be open at once")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  app->add_option("--viewer", o->viewer, "Folder of the built page");
  app->add_flag("--no-open", o->noOpen, "Print the link only, open no browser");
  app->add_option("--threads", o->threads, "Threads; 0: all cores");
  app->add_flag("--quiet", o->quiet, "Only the link and errors");
  app->footer(
      "Prints the link of the page and opens it. The link holds a secret: whoever has it may look and change while the "
      "program runs.\n"
      "Ctrl-C ends it.\n"
      "Example: roomlight view flat.glb --lighting evening.json");
  return {app, [o] { return runView(*o); }};
}

}  // namespace roomlight::cli
