#include "batch/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "base/platform/process.h"
#include "batch/durable.h"
#include "batch/status.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostArrays = 8;
constexpr size_t kDigits = 10;  // of a line in a list, with its end one more

// For a shell: between single quotes.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string head(const TaskList& list, const SlurmWish& wish, const std::string& job) {
  std::string out = fmt::format(
      "#!/bin/sh\n#SBATCH --job-name={}\n#SBATCH --output={}\n#SBATCH --open-mode=append\n#SBATCH --requeue\n", job,
      (list.folder().slurm() / "%x-%j.log").string());
  if (!wish.partition.empty()) out += fmt::format("#SBATCH --partition={}\n", wish.partition);
  if (!wish.time.empty()) out += fmt::format("#SBATCH --time={}\n", wish.time);
  return out;
}

std::string jobName(const std::string& name) {
  std::string out;
  for (const char c : name) out += std::isalnum(static_cast<unsigned char>(c)) ? c : '-';
  return "roomlight-" + out.substr(0, 40);
}

bool isThere(const char* program) { return runInShell(fmt::format("command -v {}", program)).isDone; }

// "1234" or "1234;cluster" of sbatch --parsable.
Result<std::string> submit(const fs::path& script, const std::string& options) {
  const ShellCommand out = runInShell(fmt::format("sbatch --parsable {}{}", options, quoted(script.string())));
  const std::string number = out.text.substr(0, out.text.find(';'));
  if (out.isDone && !number.empty() && number.find_first_not_of("0123456789") == std::string::npos) return number;
  std::string line = out.text.substr(out.text.rfind('\n') == std::string::npos ? 0 : out.text.rfind('\n') + 1);
  return Error{fmt::format("sbatch {}: {}", script.string(), line.empty() ? "has failed" : line)};
}

// Numbers between commas.
std::string submittedJobs(const Folder& folder) {
  std::istringstream lines(textOf(folder.slurm() / "jobs"));
  std::string jobs;
  for (std::string job; std::getline(lines, job);) {
    if (!job.empty() && job.find_first_not_of("0123456789") == std::string::npos)
      jobs += (jobs.empty() ? "" : ",") + job;
  }
  return jobs;
}

}  // namespace

SlurmPlan slurmPlan(const TaskList& list, const std::vector<size_t>& left, const SlurmWish& wish) {
  SlurmPlan plan;
  const Costs costs(list, idsIn(list.folder().path() / "done"));
  plan.tasks = left.size();
  for (const size_t i : left) plan.seconds += costs.seconds(list.entry(i));
  const double each = plan.seconds / static_cast<double>(std::max<size_t>(1, left.size()));
  const double fitting = std::ceil(60 * wish.chunkMinutes / std::max(each, 1e-3));
  const size_t most = kMostArrays * wish.mostInArray, least = (left.size() + most - 1) / most;
  plan.chunk = std::clamp<size_t>(static_cast<size_t>(std::min(fitting, 1e9)), 1, std::max<size_t>(1, left.size()));
  plan.chunk = std::max(plan.chunk, least);
  plan.chunks = (left.size() + plan.chunk - 1) / plan.chunk;
  const fs::path folder = list.folder().slurm();
  const std::string name = jobName(list.info().name), batch = quoted(list.folder().path().string());
  // Jobs that wait still read the lists of earlier submits.
  std::error_code code;
  size_t number = 1;
  while (fs::exists(folder / fmt::format("tasks_{}.list", number), code)) ++number;
  plan.list = folder / fmt::format("tasks_{}.list", number);
  const std::string run = fmt::format("exec {} batch run {} --again --list {} --chunk {}",
                                      quoted(wish.program.string()), batch, quoted(plan.list.string()), plan.chunk);
  for (size_t first = 0; first < plan.chunks; first += wish.mostInArray) {
    const size_t count = std::min(wish.mostInArray, plan.chunks - first);
    std::string text = head(list, wish, name);
    text += fmt::format("#SBATCH --array=0-{}{}\n", count - 1,
                        wish.arrayLimit > 0 ? fmt::format("%{}", wish.arrayLimit) : "");
    text += fmt::format("#SBATCH --cpus-per-task={}\n#SBATCH --signal=B:TERM@60\n", wish.cpus);
    text += fmt::format("{} --index $(({} + SLURM_ARRAY_TASK_ID))\n", run, first);
    plan.arrays.push_back(folder / fmt::format("array_{}_{}.sh", number, plan.arrays.size()));
    plan.contents.push_back(text);
  }
  plan.merge = folder / fmt::format("merge_{}.sh", number);
  plan.contents.push_back(head(list, wish, name + "-merge") +
                          fmt::format("exec {} batch merge {}\n", quoted(wish.program.string()), batch));
  return plan;
}

Status writeSlurm(const SlurmPlan& plan, const std::vector<size_t>& left) {
  std::error_code code;
  fs::create_directories(plan.list.parent_path(), code);
  std::string lines;
  lines.reserve(left.size() * (kDigits + 1));
  for (const size_t i : left) lines += fmt::format("{:010}\n", i);
  if (const Status s = writeDurably(plan.list, lines); !s) return s;
  for (size_t i = 0; i < plan.contents.size(); ++i) {
    const fs::path& script = i < plan.arrays.size() ? plan.arrays[i] : plan.merge;
    if (const Status s = writeDurably(script, plan.contents[i]); !s) return s;
  }
  return Ok{};
}

Result<std::vector<std::string>> submitSlurm(const Folder& folder, const SlurmPlan& plan) {
  if (!isThere("sbatch")) return Error{"sbatch is not there: submit where Slurm is, or see --dry-run"};
  std::vector<std::string> jobs;
  std::string after;
  const auto keep = [&] {
    std::string text;
    for (const std::string& job : jobs) text += job + "\n";
    return writeDurably(folder.slurm() / "jobs", text);
  };
  for (const fs::path& script : plan.arrays) {
    const Result<std::string> job = submit(script, "");
    if (!job) return Error{job.error()};
    jobs.push_back(job.value()), after += ":" + job.value();
    if (const Status s = keep(); !s) return Error{s.error()};
  }
  const Result<std::string> merge =
      submit(plan.merge, fmt::format("--dependency=afterok{} --kill-on-invalid-dep=yes ", after));
  if (!merge) return Error{merge.error()};
  jobs.push_back(merge.value());
  const Status kept = keep();
  return kept ? Result<std::vector<std::string>>(jobs) : Error{kept.error()};
}

Result<bool> isQueued(const Folder& folder) {
  const std::string jobs = submittedJobs(folder);
  if (jobs.empty()) return false;
  if (!isThere("squeue")) return Error{"squeue is not there"};
  const ShellCommand said = runInShell("squeue -h -o %T -j " + jobs);
  return said.isDone && !said.text.empty();
}

std::string slurmStatus(const Folder& folder) {
  const std::string jobs = submittedJobs(folder);
  if (jobs.empty()) return {};
  // The queue forgets jobs; accounting, where there is any, does not.
  ShellCommand said = isThere("sacct") ? runInShell("sacct -n -X -P -o State -j " + jobs) : ShellCommand();
  if (!said.isDone || said.text.empty())
    said = isThere("squeue") ? runInShell("squeue -h -r -o %T -j " + jobs) : ShellCommand();
  if (!said.isDone) return {};
  std::map<std::string, size_t> counts;
  std::istringstream states(said.text);
  for (std::string state; std::getline(states, state);) ++counts[state.substr(0, state.find(' '))];
  std::string out;
  for (const auto& [state, count] : counts) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", count, state);
  return fmt::format("Slurm, jobs {}: {}", jobs, out.empty() ? "none in the queue" : out);
}

Result<std::vector<size_t>> readTaskNumbers(const fs::path& list, size_t first, size_t count) {
  std::ifstream in(list, std::ios::binary);
  if (!in) return Error{fmt::format("{}: cannot be read", list.string())};
  std::string bytes(count * (kDigits + 1), '\0');
  in.seekg(static_cast<std::streamoff>(first * (kDigits + 1)));
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<size_t>(in.gcount()));
  std::vector<size_t> out;
  for (size_t at = 0; at + kDigits < bytes.size(); at += kDigits + 1) {
    size_t number = 0;
    const char* const end = bytes.data() + at + kDigits;
    if (std::from_chars(bytes.data() + at, end, number).ptr != end || *end != '\n')
      return Error{fmt::format("{}:{}: is no number of a task", list.string(), first + out.size() + 1)};
    out.push_back(number);
  }
  return out;
}

}  // namespace roomlight::batch
