#include "batch/plan_file.h"

#include <fmt/format.h>

#include <chrono>

#include "batch/claim.h"
#include "batch/plan_kinds.h"
#include "batch/records.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;
using optimise::TomlPlace;

constexpr uint64_t kMostTasks = 100000000;

// Without symbolic links, also where the folder is still to be made.
fs::path wholePath(const fs::path& path) {
  std::error_code code;
  fs::path whole = fs::weakly_canonical(fs::absolute(path, code), code);
  return whole.has_filename() ? whole : whole.parent_path();
}

void readSections(const TomlPlace& root, const PlanPaths& paths, Plan& plan) {
  for (const SectionKind& kind : sectionKinds()) {
    if (!root.has(kind.name)) continue;
    const TomlPlace list = root[kind.name];
    if (!list.isArray()) {
      list.fail(fmt::format("must be a list of tables; write [[{}]]", kind.name));
      continue;
    }
    for (size_t i = 0, n = list.size(); i < n; ++i) {
      const TomlPlace table = list.at(i);
      Section section;
      section.kind = kind.name, section.line = table.line();
      kind.read(table, paths, section);
      section.name = table.text("name", fmt::format("{} {}", kind.name, i + 1));
      plan.sections.push_back(std::move(section));
    }
  }
  uint64_t all = 0;
  for (const Section& s : plan.sections) all += std::min(taskCount(s), kMostTasks + 1);
  if (plan.sections.empty()) root.fail("has no tasks; write a table such as [[pictures]]");
  if (all > kMostTasks) root.fail(fmt::format("is of more than {} tasks; make several batches of it", kMostTasks));
}

// The words of a section's first task, checked as the command line would.
Status checkSections(const Plan& plan, InputHashes& hashes, const std::string& version, const CheckWords& check) {
  for (const Section& section : plan.sections) {
    Plan first{plan.file, plan.folder, plan.name, {section}};
    for (Axis& axis : first.sections.front().axes) axis.values.resize(1);
    const Status s = expand(first, hashes, version, [&](const Task& task, uint32_t) {
      const Status known = check(task.arguments);
      return known ? known
                   : Status(Error{
                         fmt::format("{}:{}: {}: {}", plan.file.string(), section.line, section.kind, known.error())});
    });
    if (!s) return s;
  }
  return Ok{};
}

}  // namespace

Result<Plan> readPlanFile(const fs::path& file, const fs::path& folder) {
  const Result<optimise::TomlNode> tree = optimise::readToml(file);
  if (!tree) return Error{tree.error()};
  optimise::TomlError error{file.string(), {}};
  const TomlPlace root(tree.value(), {}, error);
  Plan plan;
  plan.file = file, plan.folder = wholePath(folder);
  std::vector<std::string> keys = {"name"};
  for (const SectionKind& kind : sectionKinds()) keys.emplace_back(kind.name);
  if (knowsKeys(root, keys)) {
    plan.name = root.text("name", file.stem().string());
    readSections(root, {wholePath(file).parent_path(), plan.folder}, plan);
  }
  return error.first.empty() ? Result<Plan>(std::move(plan)) : Error{error.first};
}

uint64_t taskCount(const Section& section) {
  uint64_t count = 1;
  for (const Axis& axis : section.axes) count = std::min(count * axis.values.size(), kMostTasks + 1);
  return count;
}

Result<Planned> planBatch(const fs::path& file, const fs::path& folderPath, const std::string& version,
                          const CheckWords& check) {
  const Result<Plan> plan = readPlanFile(file, folderPath);
  if (!plan) return Error{plan.error()};
  InputHashes hashes;
  if (const Status s = checkSections(plan.value(), hashes, version, check); !s) return Error{s.error()};
  const Folder folder(plan.value().folder);
  if (const size_t running = Claims(folder).liveCount(); running > 0)
    return Error{
        fmt::format("{}: {} of its tasks are being run; wait for them, or stop them", folderPath.string(), running)};
  Result<TaskWriter> writer = TaskWriter::open(folder);
  if (!writer) return Error{writer.error()};
  Planned out;
  for (const Section& s : plan.value().sections) out.sections.push_back({s.kind, s.name, s.line, 0});
  const Status written = expand(plan.value(), hashes, version, [&](const Task& task, uint32_t section) {
    ++out.tasks, ++out.sections[section].tasks;
    return writer.value().add(task, section);
  });
  if (!written) return Error{written.error()};
  const PlanInfo info{version, plan.value().name, file.filename().string(), 0, 0, out.sections};
  if (const Status s = writer.value().finish(info); !s) return Error{s.error()};
  const Result<TaskList> list = TaskList::open(folder);
  if (!list) return Error{list.error()};
  const IdSet done = idsIn(folder.path() / "done");
  for (const Entry& e : list.value().entries()) out.done += done.contains(e.id);
  return out;
}

}  // namespace roomlight::batch
