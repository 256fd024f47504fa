#include "measure/meter_plan.h"

#include <string_view>

namespace roomlight {
namespace {

constexpr const char* kHomes = "GB 50034";
constexpr const char* kOffices = "EN 12464-1";

RoomUse home(const char* name, double lux) {
  return {name, {.lux = Target{lux, kHomes}, .uniformity = {}, .ugr = {}, .wattsPerM2 = Target{6, kHomes}}, 0.75};
}
RoomUse hall() { return {"hall", {.lux = Target{50, kHomes}, .uniformity = {}, .ugr = {}, .wattsPerM2 = {}}, 0.01}; }
RoomUse office() { return {"office", {Target{500, kOffices}, Target{0.6, kOffices}, Target{19, kOffices}, {}}, 0.75}; }

// Beginnings of words in names of rooms, in small letters; with a blank behind them whole words.
struct Word {
  std::string_view begins;
  const char* use;
};
constexpr Word kWords[] = {
    {"kitch", "kitchen"},     {"küch", "kitchen"},    {"kuech", "kitchen"},    {"cuisin", "kitchen"},
    {"cocin", "kitchen"},     {"cucin", "kitchen"},   {"bath", "bathroom"},    {"badez", "bathroom"},
    {"bad ", "bathroom"},     {"toilet", "bathroom"}, {"wc ", "bathroom"},     {"shower", "bathroom"},
    {"dusch", "bathroom"},    {"bain", "bathroom"},   {"bagn", "bathroom"},    {"baño", "bathroom"},
    {"bed", "bedroom"},       {"schlaf", "bedroom"},  {"kinder", "bedroom"},   {"child", "bedroom"},
    {"kid", "bedroom"},       {"guest", "bedroom"},   {"nursery", "bedroom"},  {"chambre", "bedroom"},
    {"camera", "bedroom"},    {"dormit", "bedroom"},  {"dining", "dining"},    {"esszimmer", "dining"},
    {"essbereich", "dining"}, {"manger", "dining"},   {"comedor", "dining"},   {"pranzo", "dining"},
    {"living", "living"},     {"lounge", "living"},   {"wohn", "living"},      {"salon", "living"},
    {"séjour", "living"},     {"sejour", "living"},   {"soggiorno", "living"}, {"family", "living"},
    {"studio", "living"},     {"office", "office"},   {"study", "office"},     {"büro", "office"},
    {"arbeits", "office"},    {"bureau", "office"},   {"oficina", "office"},   {"ufficio", "office"},
    {"hall", "hall"},         {"corrid", "hall"},     {"landing", "hall"},     {"entr", "hall"},
    {"stair", "hall"},        {"flur", "hall"},       {"diele", "hall"},       {"trepp", "hall"},
    {"couloir", "hall"},      {"pasillo", "hall"},    {"ingresso", "hall"}};

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (static_cast<unsigned char>(c) & 0x80) != 0; }

}  // namespace

const std::vector<RoomUse>& roomUses() {
  static const std::vector<RoomUse> uses = {home("living", 100),
                                            home("bedroom", 75),
                                            home("dining", 150),
                                            home("kitchen", 100),
                                            home("bathroom", 100),
                                            hall(),
                                            office()};
  return uses;
}

const RoomUse* findRoomUse(const std::string& name) {
  for (const RoomUse& use : roomUses()) {
    if (use.name == name) return &use;
  }
  return nullptr;
}

const RoomUse* useByName(const std::string& name) {
  std::string small = name + " ";
  for (char& c : small) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : isLetter(c) ? c : ' ';
  for (const Word& word : kWords) {
    for (size_t at = small.find(word.begins); at != std::string::npos; at = small.find(word.begins, at + 1)) {
      if (at == 0 || !isLetter(small[at - 1])) return findRoomUse(word.use);
    }
  }
  return nullptr;
}

}  // namespace roomlight
