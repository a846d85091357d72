#include "contact/footing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace grainstep::contact {
namespace {

using surface::ClosestPoint;
using surface::Vec2;

MovingSurface surface_of(const std::vector<Vec2>& nodes) {
  wire::Surface message;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    for (const double x : nodes[i].c) message.add_position(x);
    message.add_velocity(0.3 * std::sin(3.0 * i));
    message.add_velocity(0.4 * std::cos(2.0 * i));
    if (i == 0) continue;
    message.add_facet(i - 1);
    message.add_facet(i);
  }
  return MovingSurface(message);
}

MovingSurface flat() { return surface_of({{{-9, 0}}, {{-0.7, 0}}, {{-0.2, 0}}, {{0.1, 0}}, {{0.9, 0}}, {{9, 0}}}); }
MovingSurface rough() {
  return surface_of({{{-9, 0.1}}, {{-1.2, 0.1}}, {{-0.5, -0.2}}, {{-0.1, 0.0}}, {{0.4, -0.3}}, {{0.8, 0.1}}, {{9, 0}}});
}

struct Stand {
  Stand(const MovingSurface& on, const Vec2& centre) : surface(on), nodal(on.node_count()) {
    std::vector<std::uint32_t> all(on.now().segment_count());
    std::iota(all.begin(), all.end(), 0U);
    closest = on.now().closest(centre, all);
    foot = footing.over_chord(on, centre, 1.0, all, closest);
  }
  const MovingSurface& surface;
  Footing footing;
  ClosestPoint closest;
  Foot foot;
  std::vector<Vec2> nodal;
};

TEST(Footing, OnAFlatSurfaceTheChordIsThePoint) {
  const MovingSurface surface = flat();
  for (const double overlap : {1e-5, 1e-2, 0.3, 0.9, 1.4}) {
    const Stand stand(surface, {{0.05, 1.0 - overlap}});
    ASSERT_FALSE(stand.foot.is_point());
    EXPECT_NEAR(stand.foot.at.distance, 1.0 - overlap, 1e-5 * overlap);
    EXPECT_NEAR(stand.foot.at.normal[1], 1.0, 1e-12);
    EXPECT_NEAR(stand.foot.gain, 1.0, 5e-5);
    EXPECT_NEAR(stand.foot.lever, 1.0 - overlap, 1e-12);
  }
}

TEST(Footing, AFirstTouchIsAPoint) {
  const MovingSurface surface = flat();
  EXPECT_TRUE(Stand(surface, {{0.05, 1.0 - 1e-8}}).foot.is_point());
}

TEST(Footing, NodesReceiveTheForceAndItsMoment) {
  const MovingSurface surface = rough();
  const Vec2 centre{{0.1, 0.75}};
  Stand stand(surface, centre);
  const Vec2& n = stand.foot.at.normal;
  const Vec2 t = surface::turned_left(n);
  const double push = -2.0;
  const double drag = 0.7;
  stand.footing.give(surface, stand.foot, push * n + drag * t, stand.nodal);
  Vec2 sum;
  double moment = 0.0;
  for (std::size_t i = 0; i < stand.nodal.size(); ++i) {
    sum += stand.nodal[i];
    const Vec2 arm = surface.now().nodes()[i] - centre;
    moment += arm[0] * stand.nodal[i][1] - arm[1] * stand.nodal[i][0];
  }
  EXPECT_NEAR(dot(sum, n), push, 1e-14);
  EXPECT_NEAR(dot(sum, t), drag, 1e-14);
  EXPECT_NEAR(moment, -drag * stand.foot.lever, 1e-14);  // drag t at the place -lever n from the centre
}

TEST(Footing, VelocityIsWhatTheForcesWorkOn) {
  const MovingSurface surface = rough();
  Stand stand(surface, {{0.1, 0.75}});
  const Vec2 force = 3.0 * stand.foot.at.normal - 0.8 * surface::turned_left(stand.foot.at.normal);
  stand.footing.give(surface, stand.foot, force, stand.nodal);
  double power = 0.0;
  for (std::size_t i = 0; i < stand.nodal.size(); ++i) power += dot(stand.nodal[i], surface.velocity()[i]);
  EXPECT_NEAR(dot(force, stand.footing.velocity(surface, stand.foot)), power, 1e-14);
}

// delta^2/2 is a potential of gain delta n: around a closed way over the rough surface nothing is won or lost.
TEST(Footing, TheSpringsForceHasAPotential) {
  const MovingSurface surface = rough();
  constexpr int steps = 4000;
  const auto place = [](int k) {
    const double a = 2.0 * M_PI * k / steps;
    return Vec2{{0.4 * std::sin(a), 0.8 + 0.15 * std::cos(2.0 * a)}};
  };
  double work = 0.0;
  double most = 0.0;
  for (int k = 0; k < steps; ++k) {
    const Stand stand(surface, 0.5 * (place(k) + place(k + 1)));
    const double overlap = 1.0 - stand.foot.at.distance;
    const Vec2 force = stand.foot.gain * overlap * stand.foot.at.normal;
    work += dot(force, place(k + 1) - place(k));
    most = std::max(most, 0.5 * overlap * overlap);
  }
  EXPECT_LT(std::abs(work), 1e-6 * most);
}

}  // namespace
}  // namespace grainstep::contact
