#include "participant/program.hpp"

#include <gmock/gmock.h>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"

namespace grainstep::participant {
namespace {

using ::testing::HasSubstr;
using ::testing::internal::CaptureStderr;
using ::testing::internal::CaptureStdout;
using ::testing::internal::GetCapturedStderr;
using ::testing::internal::GetCapturedStdout;

class TheProgram : public ::testing::Test {
 protected:
  TheProgram() { program_.option("role", "which side", role_, {"structure", "impactor"}); }
  std::optional<int> parse(std::vector<const char*> words) {
    words.insert(words.begin(), "solver");
    return program_.parse(static_cast<int>(words.size()), words.data());
  }

  Program program_{"solver", "1.2", "A solver of one's own"};
  std::string role_ = "structure";
};

TEST_F(TheProgram, ReadsWhereToConnectAndItsOwnOptions) {
  EXPECT_EQ(parse({"--connect", "ipc:///tmp/x", "--curve-dir", "keys", "--connect-deadline", "2.5", "--allow-plain-tcp",
                   "--role", "impactor"}),
            std::nullopt);
  EXPECT_EQ(program_.connect().endpoint, "ipc:///tmp/x");
  EXPECT_EQ(program_.connect().curve_dir, "keys");
  EXPECT_EQ(program_.connect().connect_deadline_s, 2.5);
  EXPECT_TRUE(program_.connect().allow_plain_tcp);
  EXPECT_EQ(role_, "impactor");
}

TEST_F(TheProgram, RefusesWhatItDoesNotKnow) {
  const std::vector<std::vector<const char*>> slips = {
      {}, {"--connect", "ipc:///x", "--role", "both"}, {"--connect", "ipc:///x", "--connect-deadline", "-1"}};
  for (const auto& words : slips) {
    CaptureStderr();
    EXPECT_EQ(parse(words), static_cast<int>(ExitCode::bad_input));
    EXPECT_THAT(GetCapturedStderr(), HasSubstr("--"));
  }
}

TEST_F(TheProgram, TellsItsVersion) {
  CaptureStdout();
  EXPECT_EQ(parse({"--version"}), 0);
  EXPECT_EQ(GetCapturedStdout(), "1.2\n");
}

TEST_F(TheProgram, SaysInOneLineWhyItCannotServe) {
  const TemporaryDirectory nobody;
  const std::string endpoint = "ipc://" + (nobody.path() / "structure").string();
  const auto never = [](transport::Channel&) { return 99; };
  ASSERT_EQ(parse({"--connect", endpoint.c_str(), "--connect-deadline", "0.05"}), std::nullopt);
  CaptureStderr();
  EXPECT_EQ(program_.run(never), static_cast<int>(ExitCode::peer));
  EXPECT_THAT(GetCapturedStderr(), ::testing::MatchesRegex("solver: .*\n"));

  ASSERT_EQ(parse({"--connect", "tcp://127.0.0.1:9", "--curve-dir", nobody.path().c_str()}), std::nullopt);
  CaptureStderr();
  EXPECT_EQ(program_.run(never), static_cast<int>(ExitCode::bad_input));
  EXPECT_THAT(GetCapturedStderr(), ::testing::MatchesRegex("solver: .*\n"));
}

}  // namespace
}  // namespace grainstep::participant
