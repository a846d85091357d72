#include "results/vtk_xml.hpp"

#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <span>

#include "results/atomic_file.hpp"

namespace grainstep::results::vtk {
namespace {

template <class Value>
constexpr const char* type_name();
template <>
constexpr const char* type_name<double>() {
  return "Float64";
}
template <>
constexpr const char* type_name<std::int64_t>() {
  return "Int64";
}
template <>
constexpr const char* type_name<std::uint8_t>() {
  return "UInt8";
}

/// The descriptions of arrays and, kept apart, the bytes that they point into.
class Document {
 public:
  template <class Value>
  void array(const std::string& name, std::size_t components, std::span<const Value> values) {
    xml_ += "<DataArray type=\"" + std::string(type_name<Value>()) + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
            std::to_string(components) + "\" format=\"appended\" offset=\"" + std::to_string(appended_.size()) +
            "\"/>\n";
    const std::uint64_t bytes = values.size_bytes();
    append(&bytes, sizeof bytes);
    append(values.data(), bytes);
  }
  void text(const std::string& xml) { xml_ += xml; }

  [[nodiscard]] std::string finish(const std::string& type) const {
    const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"" + order +
           "\" header_type=\"UInt64\">\n" + xml_ + "<AppendedData encoding=\"raw\">\n_" + appended_ +
           "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  void append(const void* data, std::size_t bytes) {
    if (bytes > 0) {
      const std::size_t old = appended_.size();
      appended_.resize(old + bytes);
      std::memcpy(appended_.data() + old, data, bytes);
    }
  }
  std::string xml_;
  std::string appended_;
};

std::vector<double> with_third_component(std::span<const double> values) {
  std::vector<double> out;
  out.reserve(values.size() / 2 * 3);
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    out.insert(out.end(), {values[i], values[i + 1], 0.0});
  }
  return out;
}

std::span<const double> span_of(const google::protobuf::RepeatedField<double>& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

void add_fields(Document& document, const google::protobuf::RepeatedPtrField<wire::Field>& fields) {
  for (const wire::Field& field : fields) {
    if (field.components() == 2) {
      document.array<double>(field.name(), 3, with_third_component(span_of(field.value())));
    } else {
      document.array(field.name(), field.components(), span_of(field.value()));
    }
  }
}

void add_points(Document& document, const wire::Snapshot& snapshot) {
  document.text("<Points>\n");
  if (dimension_of(snapshot) == 3) {
    document.array("Points", 3, span_of(snapshot.position()));
  } else {
    document.array<double>("Points", 3, with_third_component(span_of(snapshot.position())));
  }
  document.text("</Points>\n");
}

std::vector<std::int64_t> counted(std::size_t count, std::int64_t first, std::int64_t step) {
  std::vector<std::int64_t> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = first + static_cast<std::int64_t>(i) * step;
  }
  return out;
}

}  // namespace

std::size_t dimension_of(const wire::Snapshot& snapshot) { return snapshot.dimension() == 3 ? 3 : 2; }

std::string particles(const wire::Snapshot& snapshot) {
  const std::size_t points = static_cast<std::size_t>(snapshot.position_size()) / dimension_of(snapshot);
  const std::string count = std::to_string(points);
  Document document;
  document.text("<PolyData>\n<Piece NumberOfPoints=\"" + count + "\" NumberOfVerts=\"" + count +
                "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData>\n");
  add_fields(document, snapshot.point_field());
  document.text("</PointData>\n");
  add_points(document, snapshot);
  document.text("<Verts>\n");
  document.array<std::int64_t>("connectivity", 1, counted(points, 0, 1));
  document.array<std::int64_t>("offsets", 1, counted(points, 1, 1));
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
  Document document;
  document.text("<UnstructuredGrid>\n<Piece NumberOfPoints=\"" + std::to_string(points) + "\" NumberOfCells=\"" +
                std::to_string(cells) + "\">\n<PointData>\n");
  add_fields(document, snapshot.point_field());
  document.text("</PointData>\n<CellData>\n");
  add_fields(document, snapshot.cell_field());
  document.text("</CellData>\n");
  add_points(document, snapshot);
  document.text("<Cells>\n");
  document.array<std::int64_t>("connectivity", 1,
                               std::vector<std::int64_t>(snapshot.cell().begin(), snapshot.cell().end()));
  document.array<std::int64_t>("offsets", 1,
                               counted(cells, static_cast<std::int64_t>(corners), static_cast<std::int64_t>(corners)));
  document.array<std::uint8_t>("types", 1, std::vector<std::uint8_t>(cells, vtk_type(snapshot.cell_shape())));
  document.text("</Cells>\n</Piece>\n</UnstructuredGrid>\n");
  return document.finish("UnstructuredGrid");
}

void TimeSeries::add(double time, const std::string& file) {
  char number[32];
  std::snprintf(number, sizeof number, "%.17g", time);
  entries_ += "<DataSet timestep=\"" + std::string(number) + "\" part=\"0\" file=\"" + file + "\"/>\n";
  write_atomically(path_, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n" +
                              entries_ + "</Collection>\n</VTKFile>\n");
}

}  // namespace grainstep::results::vtk
