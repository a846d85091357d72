#include "transport/curve.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"

namespace grainstep::transport {
namespace {

namespace fs = std::filesystem;

class Curve : public ::testing::Test {
 protected:
  TemporaryDirectory directory_;
  fs::path keys_ = directory_.path() / "keys";
};

TEST_F(Curve, keys_belong_together) {
  make_keys(keys_);
  const auto orchestrator = load_keys(keys_, Side::orchestrator);
  const auto participant = load_keys(keys_, Side::participant);
  EXPECT_EQ(orchestrator.own_public, participant.peer_public);
  EXPECT_EQ(participant.own_public, orchestrator.peer_public);
  EXPECT_NE(orchestrator.own_secret, participant.own_secret);
}

TEST_F(Curve, secrets_are_for_their_owner_only) {
  make_keys(keys_);
  EXPECT_EQ(fs::status(keys_).permissions(), fs::perms::owner_all);
  const auto secret = keys_ / "participant.key";
  EXPECT_EQ(fs::status(secret).permissions() & (fs::perms::group_all | fs::perms::others_all), fs::perms::none);
  fs::permissions(secret, fs::perms::group_read, fs::perm_options::add);
  EXPECT_THROW((void)load_keys(keys_, Side::participant), InputError);
}

TEST_F(Curve, keys_in_use_are_not_overwritten) {
  make_keys(keys_);
  const auto before = load_keys(keys_, Side::orchestrator).own_secret;
  EXPECT_THROW(make_keys(keys_), InputError);
  EXPECT_EQ(load_keys(keys_, Side::orchestrator).own_secret, before);
}

TEST_F(Curve, missing_and_broken_keys_are_named) {
  EXPECT_THROW((void)load_keys(keys_, Side::participant), InputError);
  make_keys(keys_);
  std::ofstream(keys_ / "orchestrator.pub") << "too short\n";
  try {
    (void)load_keys(keys_, Side::participant);
    FAIL() << "loaded";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("orchestrator.pub: is not a CURVE key"), std::string::npos);
  }
}

}  // namespace
}  // namespace grainstep::transport
