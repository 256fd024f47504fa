#include "bake/kept_light.h"

#include <cstring>

#include "base/sealed_file.h"

namespace roomlight::bake {
namespace {

constexpr std::string_view kExtension = ".light";

}  // namespace

std::optional<std::vector<float>> KeptLight::find(const std::string& name, size_t count) const {
  if (folder_.empty()) return std::nullopt;
  const Result<std::optional<std::string>> bytes = loadSealed(folder_ / (name + std::string(kExtension)));
  if (!bytes || !bytes.value() || bytes.value()->size() != count * sizeof(float)) return std::nullopt;
  std::vector<float> numbers(count);
  std::memcpy(numbers.data(), bytes.value()->data(), bytes.value()->size());
  return numbers;
}

void KeptLight::keep(const std::string& name, std::span<const float> numbers) const {
  if (folder_.empty()) return;
  std::error_code code;
  std::filesystem::create_directory(folder_, code);
  static_cast<void>(saveSealed(folder_ / (name + std::string(kExtension)),
                               {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()}));
}

void KeptLight::forget() const {
  if (folder_.empty()) return;
  std::error_code code;
  std::vector<std::filesystem::path> ours;
  for (std::filesystem::directory_iterator i(folder_, code), end; !code && i != end; i.increment(code)) {
    if (i->path().extension() == kExtension) ours.push_back(i->path());
  }
  for (const std::filesystem::path& file : ours) std::filesystem::remove(file, code);
  std::filesystem::remove(folder_, code);  // if it is empty
}

bool KeptLight::any() const {
  std::error_code code;
  return !folder_.empty() && std::filesystem::is_directory(folder_, code) && !std::filesystem::is_empty(folder_, code);
}

}  // namespace roomlight::bake
