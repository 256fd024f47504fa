// A batch of shell scripts in place of renders, in a folder of the test's own.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "batch/plan_file.h"
#include "batch/runner.h"
#include "batch/status.h"
#include "unit/temporary_folder.h"

namespace roomlight::testing {

constexpr const char* kVersion = "test";

class SmallBatch : public ::testing::Test {
 protected:
  SmallBatch() : folder_(std::filesystem::weakly_canonical(files_.path()) / "batch") {
    // The first word says what to do, as commands of the program do.
    writeFile(program(), R"(#!/bin/sh
case "$1" in
  write) echo "$3" > "$2"; echo "$3" >> ../log ;;
  slow) echo "$3" > "$2"; sleep "$4" ;;
  fail) echo "warning: something else" >&2; echo "roomlight: $3" >&2; exit "$2" ;;
  once) if [ -e ../tried ]; then echo fine > "$2"; else touch ../tried; kill -9 $$; fi ;;
  say) echo "$2" ;;
  nothing) ;;
  stolen) for claim in claims/*; do echo '{"host": "there", "token": "other"}' > "$claim"; done; exit 2 ;;
  full) echo "roomlight: $2: cannot be written: No space left on device" >&2; exit 1 ;;
esac
)");
    std::filesystem::permissions(program(), std::filesystem::perms::owner_all);
  }
  std::filesystem::path program() const { return files_ / "program"; }

  // Tasks of these arguments; those that say nothing of {output} print it.
  batch::TaskList plan(const std::vector<std::vector<std::string>>& tasks, std::vector<batch::Input> inputs = {}) {
    Result<batch::TaskWriter> writer = batch::TaskWriter::open(folder_);
    EXPECT_TRUE(writer) << writer.error();
    for (const auto& arguments : tasks) {
      batch::Task task{"", "commands", "all", {{"n", arguments.back()}}, arguments, "out.txt", inputs, 1};
      task.id = batch::idText(batch::idOf(task, kVersion));
      EXPECT_TRUE(writer.value().add(task, 0));
    }
    EXPECT_TRUE(writer.value().finish({kVersion, "small", "small.toml", 0, 0, {{"commands", "all", 1, tasks.size()}}}));
    return list();
  }
  batch::TaskList list() const {
    Result<batch::TaskList> list = batch::TaskList::open(folder_);
    EXPECT_TRUE(list) << list.error();
    return std::move(list.value());
  }
  batch::RunWish wish(const batch::TaskList& list, int jobs = 1) {
    batch::RunWish wish;
    wish.program = program(), wish.version = kVersion, wish.jobs = jobs;
    for (size_t i = 0; i < list.size(); ++i) wish.tasks.push_back(i);
    wish.tell = [this](const std::string& line) { told_.push_back(line); };
    return wish;
  }
  std::string idAt(const batch::TaskList& list, size_t i) const { return batch::idText(list.entry(i).id); }
  std::string outputOf(const batch::TaskList& list, size_t i) const {
    return readFile(folder_.out(idAt(list, i)) / "out.txt");
  }
  // Neither unfinished output nor claims are left.
  void expectTidy() const {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path()))
      EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
    EXPECT_TRUE(batch::Claims(folder_).all().empty());
  }

  TemporaryFolder files_;
  batch::Folder folder_;
  std::vector<std::string> told_;
};

inline std::vector<std::string> writing(int n) { return {"write", "{output}", fmt::format("{}", n)}; }

}  // namespace roomlight::testing
