#include "results/snapshots.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "scratch.hpp"

namespace grainstep::results {
namespace {

using ::testing::HasSubstr;

void set(wire::Field& field, const std::string& name, unsigned components, std::initializer_list<double> values) {
  field.set_name(name);
  field.set_unit("SI");
  field.set_components(components);
  for (const double value : values) field.add_value(value);
}

wire::Snapshot triangle() {
  wire::Snapshot out;
  for (const double x : {0.0, 0.0, 1.0, 0.0, 0.0, 2.0}) out.add_position(x);
  set(*out.add_point_field(), "velocity", 2, {1.0, -2.0, 3.0, -4.0, 5.0, -6.0});
  return out;
}

class SnapshotsTest : public ::testing::Test {
 protected:
  SnapshotsTest() { static_cast<void>(directory_.prepare(Existing::refuse)); }
  Scratch scratch_;
  RunDirectory directory_{scratch_.path() / "run"};
};

TEST_F(SnapshotsTest, ParticlesAreReadByVtk) {
  ResultsFile file(directory_.results(), {});
  Snapshots snapshots(directory_, file);
  auto snapshot = triangle();
  set(*snapshot.add_point_field(), "radius", 1, {0.5, 0.25, 0.125});
  snapshots.add(wire::IMPACTOR, 0.0, snapshot);
  const std::string seen = read_with("vtk", directory_.paraview() / "particles_0000.vtp");
  EXPECT_THAT(seen, HasSubstr("points 3 cells 3\ntypes [1]\n"));
  EXPECT_THAT(seen, HasSubstr("coordinates [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]"));
  EXPECT_THAT(seen, HasSubstr("point velocity [[1.0, -2.0, 0.0], [3.0, -4.0, 0.0], [5.0, -6.0, 0.0]]"));
  EXPECT_THAT(seen, HasSubstr("point radius [0.5, 0.25, 0.125]"));
}

TEST_F(SnapshotsTest, SpheresHaveThreeCoordinates) {
  ResultsFile file(directory_.results(), {});
  Snapshots snapshots(directory_, file);
  wire::Snapshot snapshot;
  snapshot.set_dimension(3);
  for (const double x : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) snapshot.add_position(x);
  set(*snapshot.add_point_field(), "velocity", 3, {1.0, -2.0, 3.0, -4.0, 5.0, -6.0});
  snapshots.add(wire::IMPACTOR, 0.0, snapshot);
  file.flush();
  const std::string seen = read_with("vtk", directory_.paraview() / "particles_0000.vtp");
  EXPECT_THAT(seen, HasSubstr("points 2 cells 2\n"));
  EXPECT_THAT(seen, HasSubstr("coordinates [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]"));
  EXPECT_THAT(seen, HasSubstr("point velocity [[1.0, -2.0, 3.0], [-4.0, 5.0, -6.0]]"));
  EXPECT_THAT(read_with("hdf5", directory_.results()), HasSubstr("[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]"));
}

TEST_F(SnapshotsTest, StructureIsReadByVtkAndByH5py) {
  ResultsFile file(directory_.results(), {});
  Snapshots snapshots(directory_, file);
  auto snapshot = triangle();
  for (const unsigned node : {0U, 1U, 2U}) snapshot.add_cell(node);
  set(*snapshot.add_cell_field(), "von_mises_stress", 1, {4e8});
  snapshots.add(wire::STRUCTURE, 0.0, snapshot);
  snapshots.add(wire::STRUCTURE, 1.25e-5, snapshot);
  file.flush();
  const std::string seen = read_with("vtk", directory_.paraview() / "structure_0001.vtu");
  EXPECT_THAT(seen, HasSubstr("points 3 cells 1\ntypes [5]\n"));
  EXPECT_THAT(seen, HasSubstr("cell von_mises_stress [400000000.0]"));
  std::ifstream file_of_vtk(directory_.paraview() / "structure_0001.vtu", std::ios::binary);
  const std::string written{std::istreambuf_iterator<char>(file_of_vtk), {}};
  EXPECT_THAT(written, HasSubstr("Float32"));
  EXPECT_EQ(written.find("Float64"), std::string::npos) << "twice as long as need be";
  EXPECT_EQ(read_with("collection", directory_.path() / "structure.pvd"),
            "0 paraview/structure_0000.vtu\n1.2500000000000001e-05 paraview/structure_0001.vtu\n");
  const std::string arrays = read_with("hdf5", directory_.results());
  EXPECT_THAT(arrays, HasSubstr("snapshots/structure/0001/time unit=s title=time since first contact [1.25e-05]"));
  EXPECT_THAT(arrays, HasSubstr("snapshots/structure/0000/cell unit= title=points of every triangle [[0, 1, 2]]"));
  EXPECT_THAT(arrays, HasSubstr("snapshots/structure/0000/cell_data/von_mises_stress unit=SI"));
}

// An impactor without particles has nothing to show, and leaves no files of nothing.
TEST_F(SnapshotsTest, NothingIsNoSnapshot) {
  ResultsFile file(directory_.results(), {});
  Snapshots snapshots(directory_, file);
  snapshots.add(wire::IMPACTOR, 0.0, {});
  snapshots.add(wire::STRUCTURE, 0.0, {});
  EXPECT_FALSE(std::filesystem::exists(directory_.paraview() / "particles_0000.vtp"));
  EXPECT_FALSE(std::filesystem::exists(directory_.path() / "particles.pvd"));
  EXPECT_FALSE(std::filesystem::exists(directory_.paraview() / "structure_0000.vtu"));
}

}  // namespace
}  // namespace grainstep::results
