#include "fe-service/foam/block_contact.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "fe-service/foam/block.hpp"

namespace grainstep::fe {
namespace {

using contact::MovingSurface;
using surface::Vec3;

/// Nodes are looked for anew when one has moved a radius: every ten steps or so at the speed of impact.
constexpr double kMargin = 1.0;

contact::SurfaceContactSettings settings_of(const FoamModel& model) {
  contact::SurfaceContactSettings settings;
  settings.law = {.normal_stiffness = model.contact_stiffness,
                  .tangential_stiffness = model.tangential_stiffness,
                  .damping_rate = 0.0,
                  .friction = model.friction,
                  .tension_cutoff = false};
  settings.largest_radius = model.radius;
  settings.particle_margin = kMargin * model.radius;
  settings.surface_margin = kMargin * model.radius;
  settings.name = "foam node";
  settings.remedy = "take shorter steps (steps.impactor) or raise impactor.foam.contact_stiffness";
  return settings;
}

std::vector<double*> rows_of(std::vector<Vec3>& values) {
  std::vector<double*> rows;
  rows.reserve(values.size());
  for (Vec3& value : values) rows.push_back(value.c.data());
  return rows;
}

}  // namespace

BlockContact::BlockContact(const FoamModel& model, const Body& body)
    : nodes_(outline(body.mesh())),
      position_(nodes_.size()),
      velocity_(nodes_.size()),
      force_(nodes_.size()),
      torque_(nodes_.size()),
      spring_(nodes_.size()),
      remembered_(nodes_.size()),
      position_rows_(rows_of(position_)),
      velocity_rows_(rows_of(velocity_)),
      spin_rows_(nodes_.size(), no_spin_.c.data()),
      force_rows_(rows_of(force_)),
      torque_rows_(rows_of(torque_)),
      radius_(nodes_.size(), model.radius),
      area_(outline_areas(body.mesh(), body.measure())),
      reach_(model.radius),
      contacts_(settings_of(model)) {
  for (const std::size_t i : nodes_) {
    mass_.push_back(body.corners.mass[i]);
    identity_.push_back(static_cast<std::int32_t>(identity_.size()));
  }
}

contact::ParticleArrays BlockContact::arrays() {
  contact::ParticleArrays out;
  out.owned = static_cast<int>(nodes_.size());
  out.position = position_rows_.data();
  out.velocity = velocity_rows_.data();
  out.spin = spin_rows_.data();
  out.force = force_rows_.data();
  out.torque = torque_rows_.data();
  out.radius = radius_.data();
  out.mass = mass_.data();
  out.share = area_.data();
  out.identity = identity_.data();
  out.spring = spring_.data();
  return out;
}

/// Copies the nodes, and forgets the candidates where one has moved by the margin.
void BlockContact::look(const Body& body, double next) {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const std::size_t i = nodes_[k];
    position_[k] = {{body.corners.x[i], body.corners.y[i], 0.0}};
    velocity_[k] = {{body.corners.u[i], body.corners.v[i], 0.0}};
    force_[k] = {};
    built_ = built_ && norm(position_[k] - remembered_[k]) < kMargin * reach_;
    if (norm(velocity_[k]) * next <= radius_[k]) continue;
    throw NumericalError(
        fmt::format("a node of the foam at x1 = {:g} m, x2 = {:g} m moves at {:g} m/s, further than its contact radius "
                    "of {:g} m in a step of {:g} s: the computation is unstable; take shorter steps (steps.impactor)",
                    position_[k][0], position_[k][1], norm(velocity_[k]), radius_[k], next));
  }
}

void BlockContact::evaluate(const Body& body, MovingSurface& surface, double dt, double next, double weight,
                            std::vector<surface::Vec2>& nodal) {
  look(body, next);
  const contact::ParticleArrays nodes = arrays();
  if (!built_ || contacts_.surface_left_margin(surface)) {
    contacts_.rebuild(nodes, surface);
    remembered_ = position_;
    built_ = true;
  }
  if (const auto failure = contacts_.evaluate(nodes, surface, dt, weight, nodal)) throw NumericalError(*failure);
  contacts_.apply(nodes);
}

void BlockContact::push(Body& body, double weight) {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const std::size_t i = nodes_[k];
    body.corners.u[i] += weight * force_[k][0] * body.corners.inverse_mass[i];
    body.corners.v[i] += weight * force_[k][1] * body.corners.inverse_mass[i];
  }
}

void BlockContact::end_interval(const Body& body, const MovingSurface& surface, double dt, double part) {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const std::size_t i = nodes_[k];
    velocity_[k] += part * (Vec3{{body.corners.u[i], body.corners.v[i], 0.0}} - velocity_[k]);
  }
  contacts_.end_interval(arrays(), surface, dt);
}

}  // namespace grainstep::fe
