/// @file Stresses and internal forces of all rows of elements, one after the other or shared among threads.
#include <cmath>

#include "fe-service/body.hpp"

namespace grainstep::fe {
namespace {

NodeRow row_of(const Nodes& nodes, std::size_t first) {
  return {nodes.x.data() + first, nodes.y.data() + first, nodes.u.data() + first, nodes.v.data() + first};
}

}  // namespace

RowSweep Body::row_view(int row) const {
  RowSweep view;
  const std::size_t upper = mesh_.corner({row, 0});
  const std::size_t lower = mesh_.corner({row + 1, 0});
  const std::size_t centre = row * mesh_.centre_stride();
  view.upper = row_of(corners, upper);
  view.lower = row_of(corners, lower);
  view.centre = row_of(centres, centre);
  view.first_row = row == 0;
  view.quads = mesh_.columns;
  return view;
}

void Body::share_among(base::Team& team) {
  team_ = &team;
  apart_.resize(team.size() > 1 ? static_cast<std::size_t>(mesh_.row_count()) : 0);
  for (Apart& row : apart_) row.scratch.assign(scratch_size(mesh_.columns), 0.0);
}

RowSweep Body::row_to_sweep(int row, double step, double* scratch) {
  RowSweep view = row_view(row);
  const std::size_t upper = mesh_.corner({row, 0});
  const std::size_t lower = mesh_.corner({row + 1, 0});
  const std::size_t centre = row * mesh_.centre_stride();
  view.upper_force = {corners.fx.data() + upper, corners.fy.data() + upper};
  view.lower_force = {corners.fx.data() + lower, corners.fy.data() + lower};
  view.centre_force = {centres.fx.data() + centre, centres.fy.data() + centre};
  view.state = state_[row].data();
  view.scratch = scratch;
  view.step = step;
  return view;
}

void Body::sweep_one(int row, RowSweep& view) {
  std::visit([&](const auto& law) { kernels_->sweep(view, law, measure_); }, material(row));
}

void Body::add_up(int row, const RowSweep& view, SweepResult& result) const {
  result.plastic_work += view.plastic_work;
  result.viscous_work += view.viscous_work;
  result.stored += view.stored;
  result.unconverged += view.unconverged;
  const double quality = view.min_twice_area / (0.5 * mesh_.rows[row].quad_area);
  if (!(quality >= result.min_quality)) result.min_quality = quality;
}

void Body::resist(int row, RowSweep& view) {
  Resistance& resistance = resistance_[row];
  kernels_->resist(view, resistance.law, resistance.stress.data(), measure_);
  resistance.viscosity = view.viscosity;
}

SweepResult Body::sweep(double step) {
  if (!apart_.empty()) return sweep_all_apart(step);
  SweepResult result;
  result.min_quality = HUGE_VAL;
  for (int row = 0; row < mesh_.row_count(); ++row) {
    RowSweep view = row_to_sweep(row, step, scratch_.data());
    sweep_one(row, view);
    if (!resistance_.empty()) resist(row, view);
    add_up(row, view, result);
  }
  return result;
}

SweepResult Body::sweep_all_apart(double step) {
  team_->each(mesh_.row_count(), [&](std::int32_t row) { sweep_apart(row, step); });
  SweepResult result;
  result.min_quality = HUGE_VAL;
  for (int row = 0; row < mesh_.row_count(); ++row) {
    Apart& apart = apart_[static_cast<std::size_t>(row)];
    kernels_->finish_upper(apart.swept);
    if (!resistance_.empty()) kernels_->finish_upper(apart.viscous);
    add_up(row, apart.swept, result);
  }
  return result;
}

void Body::sweep_apart(int row, double step) {
  Apart& apart = apart_[static_cast<std::size_t>(row)];
  apart.swept = row_to_sweep(row, step, apart.scratch.data());
  apart.swept.leave_upper = true;
  sweep_one(row, apart.swept);
  if (resistance_.empty()) return;
  apart.viscous = apart.swept;
  apart.viscous.first_row = false;
  apart.viscous_scratch.resize(scratch_size(mesh_.columns));
  apart.viscous.scratch = apart.viscous_scratch.data();
  resist(row, apart.viscous);
  apart.swept.viscous_work = apart.viscous.viscous_work;
}

void Body::resist_volume(const BulkFactors& factors) {
  resistance_.clear();
  if (!factors.any()) return;
  for (int row = 0; row < mesh_.row_count(); ++row) {
    const Elastic& elastic = elastic_part(material(row));
    const double speed = std::sqrt(elastic.longitudinal_modulus() / elastic.density);
    const BulkViscosity law{elastic.density, factors.linear * speed, factors.quadratic * factors.quadratic};
    const double size = std::sqrt(mesh_.rows[row].quad_area);
    resistance_.push_back({law, law.density * size * law.linear_speed, Array(mesh_.centre_stride(), 0.0)});
  }
}

}  // namespace grainstep::fe
