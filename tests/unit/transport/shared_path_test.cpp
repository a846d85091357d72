/// @file The short path of data: its memory and its name, both ends of it, and who listens.
#include "transport/shared_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "patience.hpp"
#include "transport/shared_channel.hpp"

namespace grainstep::transport {
namespace {

using ::testing::HasSubstr;
using Way = SharedPath::Way;

Bytes some(std::size_t size, int value) { return Bytes(size, static_cast<std::byte>(value)); }

void nothing() {}

TEST(SharedPath, ItsNameIsGoneOnceBothParticipantsCame) {
  SharedPath path = SharedPath::create(100);
  EXPECT_EQ(std::filesystem::status(path.file().parent_path()).permissions(), std::filesystem::perms::owner_all);
  EXPECT_EQ(std::filesystem::status(path.file()).permissions() & ~std::filesystem::perms::owner_all,
            std::filesystem::perms::none);
  const SharedPath one = SharedPath::open(path.file());
  path.close_door();
  EXPECT_TRUE(std::filesystem::exists(path.file()));
  const SharedPath other = SharedPath::open(path.file());
  path.close_door();
  EXPECT_FALSE(std::filesystem::exists(path.file().parent_path()));
}

TEST(SharedPath, ItsNameGoesWithItsCreator) {
  std::filesystem::path file;
  {
    const SharedPath path = SharedPath::create(100);
    const SharedPath one = SharedPath::open(path.file());
    file = path.file();
  }
  EXPECT_FALSE(std::filesystem::exists(file.parent_path()));
}

TEST(SharedPath, WhatIsNotThereCannotBeOpened) {
  EXPECT_THROW(static_cast<void>(SharedPath::open("/dev/shm/grainstep-none/data")), std::system_error);
  EXPECT_THROW(static_cast<void>(SharedPath::open("/dev/shm")), std::system_error);
  EXPECT_THROW(static_cast<void>(SharedPath::open("/dev/null")), std::system_error);
}

TEST(SharedPath, WhatIsAnotherFileIsRefused) {
  const TemporaryDirectory directory;
  for (const std::size_t size : {std::size_t{1}, std::size_t{63}, std::size_t{10'000}}) {
    const auto file = directory.path() / "other";
    std::ofstream(file) << std::string(size, 'x');
    EXPECT_THROW(static_cast<void>(SharedPath::open(file)), std::range_error) << size;
  }
}

TEST(SharedPath, AShapeThatDoesNotFitTheFileIsRefused) {
  const SharedPath path = SharedPath::create(100);
  const auto size = std::filesystem::file_size(path.file());
  std::filesystem::resize_file(path.file(), size - 1);
  EXPECT_THROW(static_cast<void>(SharedPath::open(path.file())), std::range_error);
  std::filesystem::resize_file(path.file(), size);
  std::fstream(path.file(), std::ios::in | std::ios::out | std::ios::binary)
      .seekp(16)
      .write("\xff\xff\xff\xff\xff\xff", 6);
  EXPECT_THROW(static_cast<void>(SharedPath::open(path.file())), std::range_error) << "slots without number";
}

TEST(SharedPath, ThatNoMachineHasRoomForIsSaid) {
  EXPECT_THROW(static_cast<void>(SharedPath::create(std::uint64_t{1} << 50U)), std::system_error);
}

TEST(SharedChannel, AnswersGoBackAndForthAndAreHeard) {
  const SharedPath path = SharedPath::create(1000);
  constexpr int windows = 3000;
  std::thread structure([&] {
    const SharedPath mine = SharedPath::open(path.file());
    SharedChannel channel(mine, Way::kinematics, "impactor", nothing);
    Bytes message;
    for (int i = 0; i < windows; ++i) {
      ASSERT_TRUE(channel.receive(message, grainstep::testing::soon()));
      ASSERT_EQ(message, some(500, i));
      channel.send(some(1000, i + 1));
    }
  });
  std::thread listening([&] {
    SharedChannel forces(path, Way::forces, "impactor");
    SharedChannel kinematics(path, Way::kinematics, "structure");
    Bytes message;
    for (int i = 0; i < windows; ++i) {
      while (!forces.receive(message, Clock::now())) std::this_thread::yield();
      ASSERT_EQ(message, some(500, i));
      while (!kinematics.receive(message, Clock::now())) std::this_thread::yield();
      ASSERT_EQ(message, some(1000, i + 1));
    }
  });
  SharedChannel impactor(path, Way::forces, "structure", nothing);
  Bytes message;
  for (int i = 0; i < windows; ++i) {
    impactor.send(some(500, i));
    ASSERT_TRUE(impactor.receive(message, grainstep::testing::soon()));
    ASSERT_EQ(message, some(1000, i + 1));
  }
  structure.join();
  listening.join();
}

TEST(SharedChannel, WhoWaitsLooksUpEveryFewMilliseconds) {
  const SharedPath path = SharedPath::create(100);
  int looks = 0;
  SharedChannel channel(path, Way::forces, "structure", [&] {
    if (++looks == 3) throw PeerError("orchestrator", "says Stop");
  });
  Bytes message;
  EXPECT_THROW(static_cast<void>(channel.receive(message, grainstep::testing::soon())), PeerError);
  EXPECT_EQ(looks, 3);
}

TEST(SharedChannel, WhoFindsNoRoomLooksUpToo) {
  const SharedPath path = SharedPath::create(100);
  SharedChannel channel(path, Way::forces, "structure", [] { throw PeerError("orchestrator", "says Stop"); });
  const auto fill = [&] {
    for (int i = 0; i < 1'000'000; ++i) channel.send(some(100, i));
  };
  EXPECT_THROW(fill(), PeerError);
}

TEST(SharedChannel, AWaitEndsAtItsDeadline) {
  const SharedPath path = SharedPath::create(100);
  SharedChannel channel(path, Way::forces, "structure", nothing);
  Bytes message;
  EXPECT_FALSE(channel.receive(message, in(std::chrono::milliseconds(20))));
  SharedChannel listener(path, Way::forces, "impactor");
  EXPECT_FALSE(listener.receive(message, grainstep::testing::soon())) << "who listens does not wait";
}

TEST(SharedChannel, NamesWhoDamagedTheMemory) {
  const SharedPath path = SharedPath::create(100);
  SharedChannel listener(path, Way::forces, "impactor");
  std::fstream file(path.file(), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(192).write("\xff\xff\xff\xff\xff\xff\xff\xff", 8);  // the header is two lines, aligned to 64 bytes
  file.seekp(128).write("\xff\xff\xff\xff\xff\xff\xff\xff", 8);
  file.close();
  Bytes message;
  try {
    static_cast<void>(listener.receive(message, Clock::now()));
    FAIL() << "took it";
  } catch (const PeerError& error) {
    EXPECT_THAT(error.what(), HasSubstr("impactor: shared memory is damaged"));
  }
}

}  // namespace
}  // namespace grainstep::transport
