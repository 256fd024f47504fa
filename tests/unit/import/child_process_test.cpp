// The program that reads models of formats that a library reads for us, and whatever may happen to it.
#include "import/child_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "import/failure.h"
#include "support/foreign_files.h"
#include "unit/import/sh3d_file.h"

namespace roomlight {
namespace {

using namespace testing;
using namespace importers;

constexpr const char* kReader = "ROOMLIGHT_MODEL_READER";

// The tests' programs do not lie beside it.
[[maybe_unused]] const int kReaderIsKnown = setenv(kReader, ROOMLIGHT_READER, 1);

// Another reader for a while.
class OtherReader {
 public:
  explicit OtherReader(const char* program) { setenv(kReader, program, 1); }
  ~OtherReader() { setenv(kReader, ROOMLIGHT_READER, 1); }
  OtherReader(const OtherReader&) = delete;
  OtherReader& operator=(const OtherReader&) = delete;
};

std::string toldBy(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const Bytes& input = {}) {
  const Bytes bytes = inChildProcess(program, arguments, input);
  return std::string(bytes.begin(), bytes.end());
}

std::string failureOf(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
  try {
    inChildProcess(program, arguments, {});
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "none";
}

TEST(ChildProcess, handsOverAllBytes) {
  Bytes bytes(3'000'000);
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<uint8_t>(i * 2654435761u >> 13);
  EXPECT_EQ(inChildProcess(ROOMLIGHT_READER_DOUBLE, {"reverse"}, bytes), Bytes(bytes.rbegin(), bytes.rend()));
  EXPECT_TRUE(inChildProcess(ROOMLIGHT_READER_DOUBLE, {"reverse"}, {}).empty());
}

TEST(ChildProcess, chatterOfLibrariesIsNoResult) { EXPECT_EQ(toldBy(ROOMLIGHT_READER_DOUBLE, {"chatter"}), "result"); }

TEST(ChildProcess, failuresComeBackAsTheyAre) { EXPECT_EQ(failureOf(ROOMLIGHT_READER_DOUBLE, {"fail"}), "because"); }

TEST(ChildProcess, crashesAndGreedAreOneLine) {
  for (const char* what : {"abort", "greed"})
    EXPECT_EQ(failureOf(ROOMLIGHT_READER_DOUBLE, {what}), "is damaged, or needs too much time or memory") << what;
}

TEST(ChildProcess, hasItsLimitsAlsoWhereSignalsAreBlocked) {
  sigset_t alarm, before;
  sigemptyset(&alarm), sigaddset(&alarm, SIGALRM);
  pthread_sigmask(SIG_BLOCK, &alarm, &before);
  EXPECT_EQ(toldBy(ROOMLIGHT_READER_DOUBLE, {"limits"}), "60 s, no core, memory, alarm, wakes");
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

TEST(ChildProcess, seesNoFileOfItsParent) {
  const int number = open("/dev/null", O_RDONLY);
  ASSERT_GE(number, 3);
  EXPECT_EQ(toldBy(ROOMLIGHT_READER_DOUBLE, {"open", std::to_string(number)}), "no");
  EXPECT_EQ(toldBy(ROOMLIGHT_READER_DOUBLE, {"open", "0"}), "yes");
  close(number);
}

TEST(ChildProcess, aMissingProgramIsNamed) {
  EXPECT_EQ(failureOf("/nowhere/roomlight-model-reader", {}),
            "cannot be read, as no process can be started for it (roomlight-model-reader: No such file or directory)");
}

class ModelReader : public ::testing::Test {
 protected:
  std::string errorOf(const char* reader) {
    const OtherReader other(reader);
    writeFile(folder_ / "a.stl", stlBytes(tableZUp()));
    const Result<Imported> r = importScene(folder_ / "a.stl");
    EXPECT_FALSE(r.ok());
    if (r.ok()) return {};
    EXPECT_NE(r.error().find("a.stl: "), std::string::npos) << r.error();
    EXPECT_EQ(r.error().find('\n'), std::string::npos) << r.error();
    return r.error();
  }
  TemporaryFolder folder_;
};

TEST_F(ModelReader, thatIsMissingOrEndsBadlyIsOneLine) {
  EXPECT_NE(errorOf("/nowhere/reader").find("as no process can be started for it (reader: "), std::string::npos);
  EXPECT_NE(errorOf("/dev/null").find("as no process can be started for it"), std::string::npos);
  EXPECT_NE(errorOf(ROOMLIGHT_READER_DOUBLE).find("is damaged, or needs too much time or memory"), std::string::npos);
  EXPECT_NE(errorOf("/bin/true").find("is damaged"), std::string::npos);  // it writes nothing
}

TEST_F(ModelReader, doesNothingElse) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {}, {"stl"}, {"obj", "own", "1"}, {"stl", "any", "1"}, {"stl", "own", "-1"}, {"stl", "own", "1", "2"}})
    EXPECT_NE(failureOf(modelReader(), words).find("roomlight reads models by this program"), std::string::npos);
}

// A home's models are read by several threads.
TEST_F(ModelReader, readsManyAtATime) {
  constexpr size_t kModels = 200;
  const std::string model = studio3d(tableZUp());
  std::string pieces;
  ZipEntries entries;
  for (size_t i = 0; i < kModels; ++i) {
    const std::string name = std::to_string(i) + ".3ds";
    pieces += "<pieceOfFurniture name='piece' x='" + std::to_string(i * 200) +
              "' y='0' width='100' depth='50' height='80' model='" + name + "'/>";
    entries.emplace_back(name, model);
  }
  const Result<Imported> r = importHome(pieces, entries);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(facesOf(r.value().scene, "piece").size(), kModels * 60);
  for (const std::string& warning : r.value().warnings) EXPECT_EQ(warning.find("model"), std::string::npos) << warning;
}

}  // namespace
}  // namespace roomlight
