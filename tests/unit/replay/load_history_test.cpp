// A recorded load on the recorded surface and on others, in its own windows and in others: what was given stays given.
#include "replay/load_history.hpp"

#include <gmock/gmock.h>

#include <array>

#include "base/error.hpp"
#include "tests/unit/replay/recorded.hpp"

namespace grainstep::replay {
namespace {

using testing::HasSubstr;

constexpr double round_off = 1e-13;

class LoadHistoryTest : public testing::Test {
 protected:
  test::Recorded recorded_;
  Recording recording_{recorded_.file(), "a.key"};
};

/// Sum over windows, nodes: (J1, J2) and the moment about the origin of the undeformed face.
std::array<double, 3> given(LoadHistory& history, const wire::Surface& surface, std::uint64_t windows) {
  std::array<double, 3> sum{};
  std::vector<double> nodal(static_cast<std::size_t>(surface.position_size()));
  for (std::uint64_t n = 0; n <= windows; ++n) {
    history.impulse(n, nodal);
    for (int i = 0; i < surface.position_size(); i += 2) {
      sum[0] += nodal[static_cast<std::size_t>(i)];
      sum[1] += nodal[static_cast<std::size_t>(i) + 1];
      sum[2] += surface.position(i) * nodal[static_cast<std::size_t>(i) + 1];
    }
  }
  return sum;
}

std::array<double, 3> recorded_in_all() {
  std::array<double, 3> sum{};
  for (std::uint64_t n = 0; n <= test::windows; ++n) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum[0] += test::impulse(n, k, 0);
      sum[1] += test::impulse(n, k, 1);
      sum[2] += static_cast<double>(k) * test::impulse(n, k, 1);
    }
  }
  return sum;
}

TEST_F(LoadHistoryTest, InItsOwnWindowsOnItsOwnSurfaceEveryBitIsHandedOn) {
  LoadHistory history(recording_, test::face({0.0, 1.0, 2.0}), "a.key");
  history.agree(test::window, 40 * test::window);
  std::vector<double> nodal(test::values);
  for (std::uint64_t n = 0; n <= test::windows; ++n) {
    history.impulse(n, nodal);
    for (std::size_t i = 0; i < test::values; ++i) ASSERT_EQ(nodal[i], test::impulse(n, i / 2, i % 2)) << n;
  }
}

TEST_F(LoadHistoryTest, InOtherWindowsTheSameIsGivenInAll) {
  const wire::Surface surface = test::face({0.0, 1.0, 2.0});
  for (const double part : {0.5, 0.31, 1.7, 3.0}) {
    LoadHistory history(recording_, surface, "a.key");
    history.agree(part * test::window, 0.4);
    const auto windows = static_cast<std::uint64_t>(40 / part);
    const auto sum = given(history, surface, windows);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(sum[i], recorded_in_all()[i], 60 * round_off) << part;
  }
}

// The impulse of t(n) acts from the middle of the window before to that of the one after.
TEST_F(LoadHistoryTest, HalfAsLongWindowsGetTheirParts) {
  LoadHistory history(recording_, test::face({0.0, 1.0, 2.0}), "a.key");
  history.agree(0.5 * test::window, 0.4);
  std::vector<double> nodal(test::values);
  const auto at = [](std::uint64_t n) { return test::impulse(n, 1, 1); };
  history.impulse(0, nodal);  // 0 to a quarter: half of what acts to a half
  EXPECT_NEAR(nodal[3], 0.5 * at(0), round_off);
  history.impulse(1, nodal);  // a quarter to three quarters
  EXPECT_NEAR(nodal[3], 0.5 * at(0) + 0.25 * at(1), round_off);
  history.impulse(2, nodal);
  EXPECT_NEAR(nodal[3], 0.5 * at(1), round_off);
  history.impulse(3, nodal);
  EXPECT_NEAR(nodal[3], 0.25 * at(1) + 0.25 * at(2), round_off);
}

TEST_F(LoadHistoryTest, OnAnotherMeshForceAndMomentStay) {
  for (const auto& nodes : {std::vector<double>{0.0, 0.4, 0.8, 1.2, 1.6, 2.0}, {0.0, 2.0}, {0.0, 0.7, 2.0, 3.0}}) {
    const wire::Surface surface = test::face(nodes);
    LoadHistory history(recording_, surface, "a.key");
    history.agree(test::window, 0.4);
    const auto sum = given(history, surface, test::windows);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(sum[i], recorded_in_all()[i], 60 * round_off) << nodes.size();
  }
}

TEST_F(LoadHistoryTest, ALoadBesideTheSurfaceIsRefused) {
  LoadHistory history(recording_, test::face({0.0, 1.0, 1.5}), "a.key");
  history.agree(test::window, 0.4);
  std::vector<double> nodal(6);
  try {
    history.impulse(3, nodal);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("acts at x1 = 2 m, x2 = 0 m, which is 0.5 m beside"));
  }
}

TEST_F(LoadHistoryTest, BehindTheEndThereIsNothingWhereTheLoadWasOver) {
  LoadHistory history(recording_, test::face({0.0, 1.0, 2.0}), "a.key");
  history.agree(test::window, 4.0);
  std::vector<double> nodal(test::values, 1.0);
  history.impulse(100, nodal);
  EXPECT_THAT(nodal, testing::Each(0.0));
}

TEST(LoadHistory, ARecordThatEndsUnderLoadIsNotPlayedBeyondIt) {
  const test::Recorded recorded(29);
  Recording recording(recorded.file(), "a.key");
  LoadHistory history(recording, test::face({0.0, 1.0, 2.0}), "a.key");
  EXPECT_NO_THROW(history.agree(0.3 * test::window, 29.4 * test::window));
  EXPECT_THROW(history.agree(0.3 * test::window, 30 * test::window), InputError);
}

TEST_F(LoadHistoryTest, TellsHowMuchFasterTheSurfaceGivesWay) {
  LoadHistory history(recording_, test::face({0.0, 1.0, 2.0}), "a.key");
  history.agree(test::window, 0.4);
  LoadHistory::Retreat sums;
  double size = 0.0, along = 0.0;
  for (std::uint64_t n = 0; n <= test::windows; ++n) {
    std::vector<double> velocity(test::values, 0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      velocity[2 * k + 1] = test::velocity(n) - 0.3;
      size += std::hypot(test::impulse(n, k, 0), test::impulse(n, k, 1));
      along += test::impulse(n, k, 1);
    }
    history.add_retreat(n, velocity, sums);
  }
  EXPECT_NEAR(sums.impulse, size, 1e-12);
  EXPECT_NEAR(sums.departure, -0.3 * along, 1e-12) << "against the load's sign: it gives way";
}

TEST_F(LoadHistoryTest, InThreeDimensionsTheSurfaceHasToBeTheSame) {
  record::About about = test::about();
  about.set_dimension(3);
  wire::Surface triangle;
  triangle.set_dimension(3);
  for (const double x : {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0}) {
    triangle.add_position(x);
    triangle.add_velocity(0.0);
  }
  for (const std::uint32_t node : {0U, 1U, 2U}) triangle.add_facet(node);
  *about.mutable_structure()->mutable_surface() = triangle;
  const TemporaryDirectory directory;
  {
    orchestrator::SurfaceRecord record(directory.path() / "surface.h5", about);
    wire::Forces forces;
    for (int i = 0; i < 9; ++i) forces.add_impulse(0.0);
    record.forces(forces);
    record.flush();
  }
  Recording recording(directory.path(), "a.key");
  EXPECT_NO_THROW(LoadHistory(recording, triangle, "a.key"));
  triangle.set_position(0, 0.5);
  EXPECT_THROW(LoadHistory(recording, triangle, "a.key"), InputError);
}

}  // namespace
}  // namespace grainstep::replay
