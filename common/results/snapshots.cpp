#include "results/snapshots.hpp"

#include <cstdio>

#include "results/atomic_file.hpp"

namespace grainstep::results {
namespace {

std::vector<double> values_of(const google::protobuf::RepeatedField<double>& values) {
  return {values.begin(), values.end()};
}

std::size_t columns_of(unsigned components) { return components == 1 ? 0 : components; }

}  // namespace

Snapshots::Snapshots(const RunDirectory& directory, ResultsFile& file)
    : directory_(directory),
      file_(file),
      particles_{.name = "particles", .collection = vtk::TimeSeries(directory.series("particles"))},
      impactor_{.name = "impactor", .collection = vtk::TimeSeries(directory.series("impactor"))},
      structure_{.name = "structure", .collection = vtk::TimeSeries(directory.series("structure"))} {}

void Snapshots::add_arrays(const std::string& group, double time, const wire::Snapshot& snapshot) {
  file_.add(
      Array{.dataset = group + "/time", .meaning = {"s", "time since first contact"}, .values = {time}, .indices = {}});
  file_.add(Array{.dataset = group + "/position",
                  .meaning = {"m", "position of every point"},
                  .columns = vtk::dimension_of(snapshot),
                  .values = values_of(snapshot.position()),
                  .indices = {}});
  if (snapshot.cell_size() > 0) {
    const std::size_t points = vtk::points_per_cell(snapshot);
    file_.add(Array{.dataset = group + "/cell",
                    .meaning = {"", points == 3 ? "points of every triangle" : "points of every cell"},
                    .columns = points,
                    .values = {},
                    .indices = {snapshot.cell().begin(), snapshot.cell().end()}});
  }
  const auto add_fields = [&](const char* kind, const auto& fields) {
    for (const wire::Field& field : fields) {
      file_.add(Array{.dataset = group + "/" + kind + "/" + field.name(),
                      .meaning = {field.unit(), field.name()},
                      .columns = columns_of(field.components()),
                      .values = values_of(field.value()),
                      .indices = {}});
    }
  };
  add_fields("point", snapshot.point_field());
  add_fields("cell_data", snapshot.cell_field());
}

void Snapshots::add(wire::Role side, double time, const wire::Snapshot& snapshot) {
  if (snapshot.position().empty()) return;  // an impactor without particles has nothing to show
  const bool is_mesh = snapshot.cell_size() > 0;
  Series& of_impactor = is_mesh ? impactor_ : particles_;
  Series& target = side == wire::IMPACTOR ? of_impactor : structure_;
  char number[32];
  std::snprintf(number, sizeof number, "%04llu", static_cast<unsigned long long>(target.count++));
  add_arrays(std::string("/snapshots/") + target.name + "/" + number, time, snapshot);
  const std::string file = std::string(target.name) + "_" + number + (is_mesh ? ".vtu" : ".vtp");
  write_atomically(directory_.paraview() / file, is_mesh ? vtk::structure(snapshot) : vtk::particles(snapshot));
  target.collection.add(time, (directory_.paraview().filename() / file).string());
}

}  // namespace grainstep::results
