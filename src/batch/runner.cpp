#include "batch/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>
#include <list>
#include <set>
#include <thread>

#include "batch/child.h"
#include "batch/durable.h"
#include "batch/inputs.h"
#include "batch/records.h"
#include "base/write_file.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;

constexpr int kPollMs = 100;
constexpr auto kWaitForOthers = std::chrono::milliseconds(500);

struct Running {
  size_t index;
  Task task;
  int triesBefore;
  Child child;
};

class Runner {
 public:
  Runner(const TaskList& list, const RunWish& wish)
      : list_(list), folder_(list.folder()), wish_(wish), claims_(list.folder(), wish.staleS), owner_(thisOwner()) {
    waiting_.assign(wish.tasks.begin(), wish.tasks.end());
    // Not by every job of an array: each would look at the claims of all others.
    if (wish.tasks.size() == list.size()) claims_.sweep();
  }

  Result<RunResult> run() {
    while (fatal_.empty() && !isStopped() &&
           (!waiting_.empty() || !running_.empty() || (wish_.wait && !busy_.empty()))) {
      while (fatal_.empty() && !isStopped() && !waiting_.empty() && running_.size() < static_cast<size_t>(wish_.jobs))
        begin(takeNext());
      if (running_.empty() && waiting_.empty() && !busy_.empty() && wish_.wait) waitForOthers();
      look();
      claims_.beat();
    }
    while (!isStopped() && !running_.empty()) look(), claims_.beat();  // what ended all is no reason to lose these
    out_.left += waiting_.size() + busy_.size() + running_.size();
    out_.stopped = isStopped() && out_.left > 0;
    stopRunning();
    return fatal_.empty() ? Result<RunResult>(out_) : Error{fatal_};
  }

 private:
  bool isStopped() const { return wish_.stop && *wish_.stop; }

  size_t takeNext() {
    const size_t next = waiting_.front();
    waiting_.pop_front();
    return next;
  }

  void waitForOthers() {
    std::this_thread::sleep_for(kWaitForOthers);
    waiting_.swap(busy_);
  }

  void begin(size_t index) {
    const std::string id = idText(list_.entry(index).id);
    std::error_code code;
    if (fs::exists(folder_.done(id), code)) return void(++out_.already);
    std::optional<FailedRecord> failure = failedRecord(folder_, id);
    if (failure && failure->isFinal && wish_.again && retried_.insert(index).second) failure.reset();
    if (failure && failure->isFinal) return void(++out_.failed);
    const Result<bool> mine = claims_.take(id);
    if (!mine) return stopFor(mine.error());
    if (!mine.value()) return busy_.push_back(index);
    // Done by the one who had the claim until now; or its output is there, whole, and only the note of it is missing.
    if (fs::exists(folder_.done(id), code) || fs::exists(folder_.out(id), code)) {
      if (!fs::exists(folder_.done(id), code)) keep(id, {0, 0, 1, owner_.host});
      claims_.release(id);
      return void(++out_.already);
    }
    Result<Task> task = list_.task(index);
    if (!task) return void(fatal_ = task.error());
    start(index, std::move(task.value()), failure ? failure->tries : 0);
  }

  // Empty, or what has changed.
  std::string changedInput(const Task& task) {
    for (const Input& input : task.inputs) {
      const fs::path file = (folder_.path() / input.file).lexically_normal();
      const std::string hash = hashes_.of(file);
      if (hash == input.hash) continue;
      return fmt::format("{} {} since the plan was made; plan again", file.string(),
                         hash.empty() ? "has gone or cannot be read" : "has changed");
    }
    return {};
  }

  void start(size_t index, Task task, int triesBefore) {
    if (const std::string changed = changedInput(task); !changed.empty())
      return fail(index, task.id, {changed, "input", triesBefore + 1, true, owner_.host});
    const std::string unfinished = Folder::unfinished(task.id);
    std::error_code code;
    fs::remove_all(folder_.path() / unfinished, code);
    fs::create_directories(folder_.path() / unfinished, code);
    if (code) {
      claims_.release(task.id);
      return stopFor(cannotWrite(folder_.path() / unfinished, code.value()).message);
    }
    const fs::path printed = printsOutput(task) ? folder_.path() / unfinished / task.output : fs::path();
    Result<Child> child = Child::start(wish_.program, words(task, unfinished), folder_.path(), printed);
    if (!child) {
      discard(task.id);
      claims_.release(task.id);
      return void(fatal_ = child.error());
    }
    running_.push_back({index, std::move(task), triesBefore, std::move(child.value())});
  }

  std::vector<std::string> words(const Task& task, const std::string& unfinished) const {
    std::vector<std::string> out;
    for (std::string word : task.arguments) {
      replace(word, kOutputWord, unfinished + "/" + task.output);
      replace(word, kFolderWord, unfinished);
      out.push_back(std::move(word));
    }
    static const std::set<std::string> kThreaded = {"render", "walk", "measure", "optimise", "validate", "bake", "mix"};
    const int threads = std::max(1, wish_.cores / std::max(1, wish_.jobs));
    if (kThreaded.contains(out.front()) && std::find(out.begin(), out.end(), "--threads") == out.end())
      out.insert(out.end(), {"--threads", std::to_string(threads)});
    if (!wish_.lightCache.empty() && std::find(out.begin(), out.end(), kLightForWord) != out.end())
      out.insert(out.end(), {"--light-cache", wish_.lightCache});
    return out;
  }

  static void replace(std::string& word, std::string_view what, const std::string& by) {
    for (size_t at = word.find(what); at != std::string::npos; at = word.find(what, at + by.size()))
      word.replace(at, what.size(), by);
  }

  // Waits a moment for news of the children, and takes them.
  void look() {
    if (running_.empty()) return;
    std::vector<int> handles;
    for (const Running& r : running_) handles.push_back(r.child.handle());
    waitForAny(handles, kPollMs);
    for (auto it = running_.begin(); it != running_.end();) {
      if (wish_.timeoutS > 0 && it->child.seconds() > wish_.timeoutS)
        it->child.kill(fmt::format("took longer than {:g} s", wish_.timeoutS));
      if (!it->child.hasEnded()) {
        ++it;
        continue;
      }
      // Stopped from outside together with this process: not its fault.
      if (!isStopped() || it->child.ended().isDone)
        end(*it);
      else
        discard(it->task.id), claims_.release(it->task.id), ++out_.left;
      it = running_.erase(it);
    }
  }

  void end(const Running& r) {
    const Ended& e = r.child.ended();
    out_.workSeconds += e.seconds;
    const int tries = r.triesBefore + 1;
    if (e.isDone && !hasOutput(r.task.id))
      return fail(r.index, r.task.id, {"has written no output", "output", tries, true, owner_.host});
    if (e.isDone) return finish(r, {e.seconds, e.peakMiB, tries, owner_.host});
    if (tellsOfFullDisk(e.line)) {
      discard(r.task.id), claims_.release(r.task.id), ++out_.left;
      return stopFor(e.line);
    }
    constexpr int kBadInput = 2;
    fail(r.index, r.task.id, {e.line, e.how, tries, e.exitStatus == kBadInput || tries >= kMostTries, owner_.host});
  }

  // Nothing more can be done here.
  void stopFor(const std::string& line) {
    fatal_ = tellsOfFullDisk(line)
                 ? fmt::format("{}: the disk or quota is full; make room and run again: what is done is kept",
                               folder_.path().string())
                 : line;
  }

  bool hasOutput(const std::string& id) const {
    std::error_code code;
    for (fs::recursive_directory_iterator it(folder_.path() / Folder::unfinished(id), code), end; !code && it != end;
         it.increment(code)) {
      if (it->is_regular_file(code) && it->file_size(code) > 0) return true;
    }
    return false;
  }

  void finish(const Running& r, const DoneRecord& record) {
    const fs::path unfinished = folder_.path() / Folder::unfinished(r.task.id);
    Status status = syncTree(unfinished);
    if (status) status = publishFolder(unfinished, folder_.out(r.task.id));
    if (status) status = keepDone(folder_, r.task.id, record);
    if (!status) {
      discard(r.task.id), claims_.release(r.task.id), ++out_.left;
      return stopFor(status.error());
    }
    forgetFailed(folder_, r.task.id);
    claims_.release(r.task.id);
    ++out_.done;
  }

  void keep(const std::string& id, const DoneRecord& record) {
    if (const Status s = keepDone(folder_, id, record); !s) stopFor(s.error());
  }

  void fail(size_t index, const std::string& id, FailedRecord record) {
    discard(id);
    // Another has taken it over, as this process had been asleep or cut off, and removed what its task was writing.
    if (!claims_.holds(id)) {
      claims_.release(id);
      return busy_.push_back(index);
    }
    const Status kept = keepFailed(folder_, id, record);
    claims_.release(id);
    if (!kept) return stopFor(kept.error());
    if (wish_.tell)
      wish_.tell(
          fmt::format("task {} ({}): {}{}", index, id, record.line,
                      record.isFinal ? "" : fmt::format("; try {} of {} follows", record.tries + 1, kMostTries)));
    if (record.isFinal) return void(++out_.failed);
    waiting_.push_back(index);
  }

  void discard(const std::string& id) {
    std::error_code ignored;
    fs::remove_all(folder_.path() / Folder::unfinished(id), ignored);
  }

  void stopRunning() {
    for (Running& r : running_) r.child.kill("was stopped");
    for (Running& r : running_) {
      while (!r.child.hasEnded()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
      discard(r.task.id);
      claims_.release(r.task.id);
    }
    running_.clear();
  }

  const TaskList& list_;
  const Folder& folder_;
  const RunWish& wish_;
  Claims claims_;
  const Owner owner_;
  InputHashes hashes_;
  std::deque<size_t> waiting_, busy_;  // busy: others run these
  std::set<size_t> retried_;
  std::list<Running> running_;
  std::string fatal_;
  RunResult out_;
};

}  // namespace

Result<RunResult> runTasks(const TaskList& list, const RunWish& wish) {
  if (list.info().version != wish.version)
    return Error{fmt::format("{}: was planned by roomlight {}, this is {}; plan again", list.folder().plan().string(),
                             list.info().version, wish.version)};
  std::error_code code;
  fs::create_directories(list.folder().claims(), code);
  if (code) return cannotWrite(list.folder().claims(), code.value());
  return Runner(list, wish).run();
}

}  // namespace roomlight::batch
