#include "results/vtk_xml.hpp"

#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "results/atomic_file.hpp"

namespace grainstep::results::vtk {
namespace {

template <class Value>
constexpr const char* type_name();
template <>
constexpr const char* type_name<float>() {
  return "Float32";
}
template <>
constexpr const char* type_name<std::int32_t>() {
  return "Int32";
}
template <>
constexpr const char* type_name<std::uint8_t>() {
  return "UInt8";
}

/// The descriptions of arrays and, kept apart, the bytes that they point into. Numbers are of single precision: what is
/// looked at needs no more, and half of the bytes are half of the time; results.h5 has them whole.
class Document {
 public:
  /// For arrays of so many bytes altogether, their lengths not counted.
  explicit Document(std::size_t bytes) { appended_.reserve(bytes + 64 * sizeof(std::uint64_t)); }

  /// An array of `count` values, the n-th of which is value(n).
  template <class Value, class Of>
  void array(const std::string& name, std::size_t components, std::size_t count, Of&& value) {
    xml_ += "<DataArray type=\"" + std::string(type_name<Value>()) + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
            std::to_string(components) + "\" format=\"appended\" offset=\"" + std::to_string(appended_.size()) +
            "\"/>\n";
    const std::uint64_t bytes = count * sizeof(Value);
    const std::size_t at = appended_.size();
    appended_.resize(at + sizeof bytes + bytes);
    std::memcpy(appended_.data() + at, &bytes, sizeof bytes);
    char* to = appended_.data() + at + sizeof bytes;
    for (std::size_t n = 0; n < count; ++n) {
      const auto one = static_cast<Value>(value(n));
      std::memcpy(to + n * sizeof one, &one, sizeof one);
    }
  }
  /// Vectors of two components get a third one.
  void vectors(const std::string& name, std::size_t components, const google::protobuf::RepeatedField<double>& values) {
    const double* const from = values.data();
    const auto count = static_cast<std::size_t>(values.size());
    if (components == 2) {
      array<float>(name, 3, count / 2 * 3,
                   [from](std::size_t n) { return n % 3 == 2 ? 0.0 : from[n / 3 * 2 + n % 3]; });
    } else {
      array<float>(name, components, count, [from](std::size_t n) { return from[n]; });
    }
  }
  void text(const std::string& xml) { xml_ += xml; }

  [[nodiscard]] std::string finish(const std::string& type) const {
    const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    std::string out = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"" + order +
                      "\" header_type=\"UInt64\">\n" + xml_ + "<AppendedData encoding=\"raw\">\n_";
    out.reserve(out.size() + appended_.size() + 64);
    return out.append(appended_).append("\n</AppendedData>\n</VTKFile>\n");
  }

 private:
  std::string xml_;
  std::string appended_;
};

void add_fields(Document& document, const google::protobuf::RepeatedPtrField<wire::Field>& fields) {
  for (const wire::Field& field : fields) document.vectors(field.name(), field.components(), field.value());
}

void add_points(Document& document, const wire::Snapshot& snapshot) {
  document.text("<Points>\n");
  document.vectors("Points", dimension_of(snapshot), snapshot.position());
  document.text("</Points>\n");
}

/// Of all numbers of a snapshot, vectors of two with a third one.
std::size_t bytes_of(const wire::Snapshot& snapshot) {
  std::size_t values = 3 * static_cast<std::size_t>(snapshot.position_size());
  for (const auto* fields : {&snapshot.point_field(), &snapshot.cell_field()}) {
    for (const wire::Field& field : *fields) values += 3 * static_cast<std::size_t>(field.value_size()) / 2 + 1;
  }
  return sizeof(float) * (values + 3 * static_cast<std::size_t>(snapshot.cell_size()));
}

}  // namespace

std::size_t dimension_of(const wire::Snapshot& snapshot) { return snapshot.dimension() == 3 ? 3 : 2; }

std::string particles(const wire::Snapshot& snapshot) {
  const std::size_t points = static_cast<std::size_t>(snapshot.position_size()) / dimension_of(snapshot);
  const std::string count = std::to_string(points);
  Document document(bytes_of(snapshot) + 2 * sizeof(std::int32_t) * points);
  document.text("<PolyData>\n<Piece NumberOfPoints=\"" + count + "\" NumberOfVerts=\"" + count +
                "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData>\n");
  add_fields(document, snapshot.point_field());
  document.text("</PointData>\n");
  add_points(document, snapshot);
  document.text("<Verts>\n");
  document.array<std::int32_t>("connectivity", 1, points, [](std::size_t n) { return n; });
  document.array<std::int32_t>("offsets", 1, points, [](std::size_t n) { return n + 1; });
  document.text("</Verts>\n</Piece>\n</PolyData>\n");
  return document.finish("PolyData");
}

std::size_t points_per_cell(const wire::Snapshot& snapshot) {
  switch (snapshot.cell_shape()) {
    case wire::TETRAHEDRON:
      return 4;
    case wire::HEXAHEDRON:
      return 8;
    default:
      return 3;
  }
}

namespace {

std::uint8_t vtk_type(wire::CellShape shape) {
  switch (shape) {
    case wire::TETRAHEDRON:
      return 10;  // VTK_TETRA
    case wire::HEXAHEDRON:
      return 12;  // VTK_HEXAHEDRON
    default:
      return 5;  // VTK_TRIANGLE
  }
}

}  // namespace

std::string structure(const wire::Snapshot& snapshot) {
  const std::size_t corners = points_per_cell(snapshot);
  const std::size_t points = static_cast<std::size_t>(snapshot.position_size()) / dimension_of(snapshot);
  const std::size_t cells = static_cast<std::size_t>(snapshot.cell_size()) / corners;
  Document document(bytes_of(snapshot));
  document.text("<UnstructuredGrid>\n<Piece NumberOfPoints=\"" + std::to_string(points) + "\" NumberOfCells=\"" +
                std::to_string(cells) + "\">\n<PointData>\n");
  add_fields(document, snapshot.point_field());
  document.text("</PointData>\n<CellData>\n");
  add_fields(document, snapshot.cell_field());
  document.text("</CellData>\n");
  add_points(document, snapshot);
  document.text("<Cells>\n");
  const auto* nodes = snapshot.cell().data();
  document.array<std::int32_t>("connectivity", 1, cells * corners, [nodes](std::size_t n) { return nodes[n]; });
  document.array<std::int32_t>("offsets", 1, cells, [corners](std::size_t n) { return (n + 1) * corners; });
  document.array<std::uint8_t>("types", 1, cells, [&](std::size_t) { return vtk_type(snapshot.cell_shape()); });
  document.text("</Cells>\n</Piece>\n</UnstructuredGrid>\n");
  return document.finish("UnstructuredGrid");
}

void TimeSeries::add(double time, const std::string& file) {
  char number[32];
  std::snprintf(number, sizeof number, "%.17g", time);
  entries_ += "<DataSet timestep=\"" + std::string(number) + "\" part=\"0\" file=\"" + file + "\"/>\n";
  write();
}

void TimeSeries::write() const {
  if (entries_.empty()) return;
  write_atomically(path_, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n" +
                              entries_ + "</Collection>\n</VTKFile>\n");
}

}  // namespace grainstep::results::vtk
