// What a run records of its surface is read back bit for bit, and nothing else is taken for it.
#include "replay/recording.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <functional>

#include "base/error.hpp"
#include "tests/unit/replay/recorded.hpp"

namespace grainstep::replay {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

void expect_all_rows(Recording& read, std::uint64_t last) {
  ASSERT_EQ(read.last(), last);
  for (std::uint64_t n = 0; n <= last; ++n) {
    const wire::Forces forces = test::forces(n);
    const wire::Kinematics surface = test::kinematics(n);
    for (int i = 0; i < static_cast<int>(test::values); ++i) {
      ASSERT_EQ(read.impulse(n)[i], forces.impulse(i)) << n;
      ASSERT_EQ(read.position(n)[i], surface.position(i)) << n;
      ASSERT_EQ(read.velocity(n)[i], surface.velocity(i)) << n;
    }
  }
}

std::string refusal(const std::filesystem::path& path) {
  try {
    Recording read(path, "a.key");
    for (std::uint64_t n = 0; n <= read.last(); ++n) static_cast<void>(read.impulse(n));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Recording, HoldsWhatPassedTheSurface) {
  const test::Recorded recorded;
  Recording read(recorded.directory(), "a.key");
  expect_all_rows(read, test::windows);
  EXPECT_EQ(read.about().SerializeAsString(), test::about().SerializeAsString());
  EXPECT_EQ(read.end(), 40 * test::window);
  EXPECT_EQ(read.impactor_energy(), 3.5);
  EXPECT_THAT(read.impactor_momentum(), ElementsAre(0.0, -1.25));
}

TEST(Recording, RowsAreThereInAnyOrder) {
  const test::Recorded recorded;
  Recording read(recorded.file(), "a.key");
  for (const std::uint64_t n : {40U, 0U, 17U, 16U}) EXPECT_EQ(read.impulse(n)[1], test::impulse(n, 0, 1));
}

// Of a run that went on: what it had recorded after its checkpoint, it records again.
TEST(Recording, GoesOnAfterAWindow) {
  const test::Recorded recorded(29);
  {
    orchestrator::SurfaceRecord record(recorded.file(), test::about(), 12);
    test::add(record, 13, test::windows);
    record.flush();
  }
  Recording read(recorded.file(), "a.key");
  expect_all_rows(read, test::windows);
}

TEST(Recording, LessThanACheckpointNeedsIsNoRecordToGoOnWith) {
  const test::Recorded recorded(5);
  EXPECT_THROW(orchestrator::SurfaceRecord(recorded.file(), test::about(), 12), OutputError);
}

TEST(Recording, WhatIsNoneIsRefused) {
  const TemporaryDirectory directory;
  EXPECT_THAT(refusal(directory.path() / "absent"), HasSubstr("no such file"));
  EXPECT_THAT(refusal(directory.path()), HasSubstr("surface.h5: no such file; expected the directory of a run"));
  EXPECT_THAT(refusal("/dev/zero"), HasSubstr("is no file"));
  std::ofstream(directory.path() / "text") << "nothing\n";
  EXPECT_THAT(refusal(directory.path() / "text"), HasSubstr("a.key: "));
}

/// A record of which one thing was changed.
std::string refusal_after(const std::function<void(results::h5::File&)>& change) {
  const test::Recorded recorded;
  {
    results::h5::File file = results::h5::File::open(recorded.file());
    change(file);
    file.close();
  }
  return refusal(recorded.file());
}

TEST(Recording, WhatDoesNotFitIsRefused) {
  using results::h5::File;
  EXPECT_THAT(refusal_after([](File& file) { file.remove("/velocity"); }), HasSubstr("/velocity"));
  EXPECT_THAT(refusal_after([](File& file) { file.shrink("/velocity", 40); }),
              HasSubstr("/velocity is 40 x 6, expected 41 x 6"));
  EXPECT_THAT(refusal_after([](File& file) { file.remove("/about"); }), HasSubstr("/about"));
  const auto about_is = [](const std::string& text) {
    return [text](File& file) {
      file.remove("/about");
      file.write("/about", text, "");
    };
  };
  EXPECT_THAT(refusal_after(about_is("{")), HasSubstr("/about"));
  EXPECT_THAT(refusal_after(about_is("{}")), HasSubstr("dimension 0"));
  EXPECT_THAT(refusal_after(about_is(R"({"dimension": 2, "window": "NaN"})")), HasSubstr("window"));
  EXPECT_THAT(refusal_after(about_is(R"({"dimension": 2, "window": 1, "structure": {"surface": {"position": [1]}}})")),
              HasSubstr("structure.surface"));
  EXPECT_THAT(refusal_after([](File& file) {
                file.remove("/impactor/energy");
                file.write("/impactor/energy", std::vector<double>{1.0, 2.0}, 0, {});
              }),
              HasSubstr("/impactor has other sizes"));
  EXPECT_THAT(refusal_after([](File& file) {
                file.shrink("/impulse", 40);
                file.append("/impulse", std::vector<double>(6, std::nan("")), 6, {});
              }),
              HasSubstr("holds what is no number"));
}

TEST(Recording, ABitThatFlippedIsNoticed) {
  const test::Recorded recorded;
  std::string bytes;
  {
    std::ifstream file(recorded.file(), std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
  }
  // The last byte of the packed rows that were written last lies in the last chunk of the file.
  std::size_t noticed = 0;
  std::size_t tried = 0;
  for (std::size_t at = bytes.size() / 2; at < bytes.size(); at += 97, ++tried) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    std::ofstream(recorded.file(), std::ios::binary) << changed;
    if (refusal(recorded.file()) != "none") {
      ++noticed;
      continue;
    }
    Recording read(recorded.file(), "a.key");  // a byte that says nothing of the rows: they are what they were
    for (std::uint64_t n = 0; n <= read.last(); ++n)
      ASSERT_EQ(read.impulse(n)[1], test::impulse(n, 0, 1)) << "byte " << at;
  }
  EXPECT_GT(noticed, 0U) << "of " << tried;
}

}  // namespace
}  // namespace grainstep::replay
