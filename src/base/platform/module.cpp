#include "base/platform/module.h"

#ifdef __linux__

#include <dlfcn.h>
#include <elf.h>
#include <link.h>

#include <cstring>

#include "base/hash.h"
#include "base/sealed_file.h"

namespace roomlight {
namespace {

constexpr int kLevelsToPrefix = 4;
const char kInThisModule = 0;

// What dl_iterate_phdr tells of the module that holds an address of this code.
struct Module {
  std::string buildId;
};

std::string hexadecimal(const unsigned char* bytes, size_t count) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (size_t i = 0; i < count; ++i) text += {kDigits[bytes[i] >> 4], kDigits[bytes[i] & 15]};
  return text;
}

std::string buildIdIn(const unsigned char* notes, size_t size) {
  constexpr size_t kAlign = 4;
  const auto padded = [](size_t n) { return (n + kAlign - 1) / kAlign * kAlign; };
  while (size >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes, sizeof note);
    const size_t name = sizeof note, text = name + padded(note.n_namesz), end = text + padded(note.n_descsz);
    if (end > size) break;
    if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 && std::memcmp(notes + name, "GNU", 4) == 0)
      return hexadecimal(notes + text, note.n_descsz);
    notes += end, size -= end;
  }
  return {};
}

int lookAt(dl_phdr_info* info, size_t, void* found) {
  const auto here = reinterpret_cast<ElfW(Addr)>(&kInThisModule);
  bool holdsThis = false;
  std::string id;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = info->dlpi_phdr[i];
    const ElfW(Addr) begin = info->dlpi_addr + part.p_vaddr;
    if (part.p_type == PT_LOAD && here >= begin && here - begin < part.p_memsz) holdsThis = true;
    if (part.p_type == PT_NOTE && id.empty())
      id = buildIdIn(reinterpret_cast<const unsigned char*>(begin), part.p_memsz);
  }
  if (!holdsThis) return 0;
  *static_cast<Module*>(found) = {id};
  return 1;
}

}  // namespace

const std::string& buildId() {
  static const std::string id = [] {
    Module module;
    dl_iterate_phdr(lookAt, &module);
    // A linker that was not asked for it leaves none.
    return module.buildId.empty() ? hashOf(contentOf(runningProgram()).value_or("")) : module.buildId;
  }();
  return id;
}

std::filesystem::path runningProgram() { return "/proc/self/exe"; }

std::filesystem::path programFolder() {
  std::error_code code;
  return std::filesystem::read_symlink(runningProgram(), code).parent_path();
}

std::filesystem::path moduleFolder() {
  Dl_info info{};
  std::error_code code;
  if (dladdr(&kInThisModule, &info) == 0 || !info.dli_fname) return {};
  // A program's own name is as it was called, which says nothing of where it lies; that of a library is its path.
  const std::filesystem::path file = std::filesystem::canonical(info.dli_fname, code);
  return code || file.filename().string().find(".so") == std::string::npos ? programFolder() : file.parent_path();
}

std::filesystem::path installed(const std::filesystem::path& below) {
  std::error_code code;
  std::filesystem::path folder = moduleFolder();
  for (int up = 0; up < kLevelsToPrefix && folder.has_relative_path(); ++up) {
    folder = folder.parent_path();
    if (std::filesystem::exists(folder / below, code)) return folder / below;
  }
  return programFolder().parent_path() / below;
}

}  // namespace roomlight

#endif
