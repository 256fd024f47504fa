// The module `roomlight._roomlight`: include/roomlight as Python objects, for the package's own files alone.
#include <signal.h>

#include <array>

#include "bindings.h"
#include "calls.h"

namespace roomlight::python {
namespace {

// The program takes signals and keeps them; Python has them back.
class KeptSignals {
 public:
  KeptSignals() {
    for (size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], nullptr, &before_[i]);
  }
  ~KeptSignals() {
    for (size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  }
  KeptSignals(const KeptSignals&) = delete;
  KeptSignals& operator=(const KeptSignals&) = delete;

 private:
  static constexpr std::array<int, 4> kSignals{SIGINT, SIGTERM, SIGHUP, SIGPIPE};
  std::array<struct sigaction, kSignals.size()> before_{};
};

int runWords(const std::vector<std::string>& words) {
  std::vector<const char*> argv;
  for (const std::string& w : words) argv.push_back(w.c_str());
  argv.push_back(nullptr);
  const KeptSignals kept;
  return unlocked([&] { return runProgram(static_cast<int>(words.size()), argv.data()); });
}

}  // namespace

void bindProgram(py::module_& module) {
  module.def("run_program", &runWords);
  module.def("version", &version);
  module.def("build_id", &buildId);
  module.def("instruction_set", &instructionSet);
  py::module_::import("atexit").attr("register")(py::cpp_function(&endLongWork));
}

}  // namespace roomlight::python

PYBIND11_MODULE(_roomlight, module) {
  using namespace roomlight::python;
  bindHome(module);
  bindPictures(module);
  bindLayers(module);
  bindMeters(module);
  bindProgram(module);
}
