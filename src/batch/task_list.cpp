#include "batch/task_list.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/write_file.h"
#include "batch/durable.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr size_t kEntryBytes = 24;

template <class T>
void put(char*& at, T value) {
  for (size_t i = 0; i < sizeof(T); ++i) *at++ = static_cast<char>(value >> (8 * i));
}
template <class T>
T take(const char*& at) {
  T value = 0;
  for (size_t i = 0; i < sizeof(T); ++i) value |= static_cast<T>(static_cast<unsigned char>(*at++)) << (8 * i);
  return value;
}

std::string bytesOf(const Entry& e) {
  std::string bytes(kEntryBytes, '\0');
  char* at = bytes.data();
  uint32_t seconds = 0;
  std::memcpy(&seconds, &e.seconds, sizeof seconds);
  put(at, e.offset), put(at, e.id), put(at, e.section), put(at, seconds);
  return bytes;
}

Entry entryOf(const char* at) {
  Entry e;
  e.offset = take<uint64_t>(at), e.id = take<uint64_t>(at), e.section = take<uint32_t>(at);
  const uint32_t seconds = take<uint32_t>(at);
  std::memcpy(&e.seconds, &seconds, sizeof seconds);
  return e;
}

std::string jsonOf(const PlanInfo& info) {
  Json sections = Json::array();
  for (const SectionInfo& s : info.sections)
    sections.push_back({{"kind", s.kind}, {"name", s.name}, {"line", s.line}, {"tasks", s.tasks}});
  const Json json = {{"format", kFormat},   {"program", info.version}, {"name", info.name},   {"plan", info.file},
                     {"tasks", info.tasks}, {"bytes", info.bytes},     {"sections", sections}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<PlanInfo> infoOf(const fs::path& file) {
  std::error_code code;
  if (!fs::is_regular_file(file, code))
    return Error{fmt::format("{}: no such file; make a plan first: roomlight batch plan PLAN.toml -o {}", file.string(),
                             file.parent_path().string())};
  try {
    const Json json = Json::parse(textOf(file));
    if (json.at("format") != kFormat)
      return Error{fmt::format("{}: was written by another version of roomlight; plan again", file.string())};
    PlanInfo info;
    info.version = json.at("program"), info.name = json.at("name"), info.file = json.at("plan");
    info.tasks = json.at("tasks"), info.bytes = json.at("bytes");
    for (const Json& s : json.at("sections"))
      info.sections.push_back({s.at("kind"), s.at("name"), s.at("line"), s.at("tasks")});
    return info;
  } catch (const Json::exception&) {
    return Error{fmt::format("{}: is damaged; plan again", file.string())};
  }
}

}  // namespace

std::string Folder::unfinished(const std::string& id) {
  return fmt::format("out/{}/{}.{}.tmp", id.substr(0, 2), id, processToken());
}

Result<TaskWriter> TaskWriter::open(const Folder& folder) {
  std::error_code code;
  fs::create_directories(folder.claims(), code);
  if (code) return Error{fmt::format("{}: cannot be made: {}", folder.path().string(), code.message())};
  TaskWriter writer(folder, folder.tasks().string() + ".part", folder.index().string() + ".part");
  writer.tasks_.open(writer.tasksPart_, std::ios::binary | std::ios::trunc);
  writer.index_.open(writer.indexPart_, std::ios::binary | std::ios::trunc);
  if (!writer.tasks_ || !writer.index_) return cannotWrite(folder.tasks(), errno);
  return writer;
}

Status TaskWriter::add(const Task& task, uint32_t section) {
  const std::string line = lineOf(task) + "\n";
  const Entry e{offset_, std::stoull(task.id, nullptr, 16), section, static_cast<float>(task.seconds)};
  const std::string entry = bytesOf(e);
  tasks_.write(line.data(), static_cast<std::streamsize>(line.size()));
  index_.write(entry.data(), static_cast<std::streamsize>(entry.size()));
  offset_ += line.size(), ++count_;
  return tasks_ && index_ ? Status(Ok{}) : cannotWrite(folder_.tasks(), errno);
}

Status TaskWriter::finish(PlanInfo info) {
  tasks_.close(), index_.close();
  if (!tasks_ || !index_) return cannotWrite(folder_.tasks(), errno);
  info.tasks = count_, info.bytes = offset_;
  // plan.json goes first and comes last: with it the three files belong together.
  std::error_code code;
  fs::remove(folder_.plan(), code);
  fs::rename(tasksPart_, folder_.tasks(), code);
  if (!code) fs::rename(indexPart_, folder_.index(), code);
  if (code) return cannotWrite(folder_.tasks(), code.value());
  return writeDurably(folder_.plan(), jsonOf(info));
}

Result<TaskList> TaskList::open(const Folder& folder) {
  TaskList list(folder);
  Result<PlanInfo> info = infoOf(folder.plan());
  if (!info) return Error{info.error()};
  list.info_ = std::move(info.value());
  const std::string bytes = textOf(folder.index());
  std::error_code code;
  if (bytes.size() != list.info_.tasks * kEntryBytes || fs::file_size(folder.tasks(), code) != list.info_.bytes)
    return Error{fmt::format("{}: does not go with plan.json; plan again", folder.tasks().string())};
  list.entries_.reserve(list.info_.tasks);
  for (size_t at = 0; at < bytes.size(); at += kEntryBytes) {
    list.entries_.push_back(entryOf(bytes.data() + at));
    if (list.entries_.back().section >= list.info_.sections.size())
      return Error{fmt::format("{}: is damaged; plan again", folder.index().string())};
  }
  return list;
}

Result<Task> TaskList::task(size_t index) const {
  const uint64_t from = entries_[index].offset;
  const uint64_t end = index + 1 < entries_.size() ? entries_[index + 1].offset : info_.bytes;
  std::ifstream in(folder_.tasks(), std::ios::binary);
  std::string line(end > from && end <= info_.bytes ? end - from : 0, '\0');
  in.seekg(static_cast<std::streamoff>(from));
  in.read(line.data(), static_cast<std::streamsize>(line.size()));
  Result<Task> task = in && !line.empty() ? taskOf(line) : Error{"cannot be read"};
  if (!task) return Error{fmt::format("{}:{}: {}", folder_.tasks().string(), index + 1, task.error())};
  if (task.value().id != idText(entries_[index].id))
    return Error{fmt::format("{}:{}: is not the task of the index; plan again", folder_.tasks().string(), index + 1)};
  return task;
}

}  // namespace roomlight::batch
