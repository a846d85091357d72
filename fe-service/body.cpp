#include "fe-service/body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grainstep::fe {

namespace {

void resize(Nodes& nodes, std::size_t n) {
  for (Array* array : {&nodes.x, &nodes.y, &nodes.x0, &nodes.y0, &nodes.u, &nodes.v, &nodes.fx, &nodes.fy, &nodes.mass,
                       &nodes.inverse_mass}) {
    array->assign(n, 0.0);
  }
}

void invert_mass(Nodes& nodes) {
  std::transform(nodes.mass.begin(), nodes.mass.end(), nodes.inverse_mass.begin(),
                 [](double m) { return m > 0.0 ? 1.0 / m : 0.0; });
}

int state_components(const Material& material) { return traits_of(material).state; }

/// Index of a triangle's component 0 in the state of its row.
std::size_t state_index(int components, int column, int triangle) {
  const auto batch = static_cast<std::size_t>(column / kBatchQuads);
  const int lane = triangle * kBatchQuads + column % kBatchQuads;
  return batch * static_cast<std::size_t>(components) * static_cast<std::size_t>(kBatchTriangles) +
         static_cast<std::size_t>(lane);
}

}  // namespace

std::size_t memory_bytes(const Mesh& mesh, const std::vector<Material>& layers) {
  constexpr std::size_t arrays = 10;  // of Nodes
  std::size_t doubles =
      arrays * (mesh.corner_stride() * (mesh.rows.size() + 1) + mesh.centre_stride() * mesh.rows.size());
  doubles += scratch_size(mesh.columns);
  for (const ElementRow& row : mesh.rows) {
    doubles += mesh.batches() * static_cast<std::size_t>(state_components(layers[row.layer]) * kBatchTriangles);
  }
  return doubles * sizeof(double);
}

Body::Body(Mesh mesh, std::vector<Material> layers, const Measure& measure, const Kernels& kernels)
    : mesh_(std::move(mesh)), layers_(std::move(layers)), measure_(measure), kernels_(&kernels) {
  resize(corners, mesh_.corner_stride() * (mesh_.rows.size() + 1));
  resize(centres, mesh_.centre_stride() * mesh_.rows.size());
  scratch_.assign(scratch_size(mesh_.columns), 0.0);
  place_nodes();
  share_mass();
  create_state();
}

void Body::place_nodes() {
  for (int row = 0; row <= mesh_.row_count(); ++row) {
    for (int column = 0; column <= mesh_.columns; ++column) {
      const std::size_t at = mesh_.corner({row, column});
      corners.x0[at] = mesh_.corner_x(column);
      corners.y0[at] = mesh_.level[row];
    }
  }
  for (int row = 0; row < mesh_.row_count(); ++row) {
    for (int column = 0; column < mesh_.columns; ++column) {
      const std::size_t at = row * mesh_.centre_stride() + column;
      centres.x0[at] = 0.5 * (mesh_.corner_x(column) + mesh_.corner_x(column + 1));
      centres.y0[at] = 0.5 * (mesh_.level[row] + mesh_.level[row + 1]);
    }
  }
  corners.x = corners.x0;
  corners.y = corners.y0;
  centres.x = centres.x0;
  centres.y = centres.y0;
}

/// The integral of density x shape function: in plane strain a third of a quad's mass to its centre, a sixth to each
/// corner.
void Body::share_mass() {
  for (int row = 0; row < mesh_.row_count(); ++row) {
    const double density = elastic_part(material(row)).density;
    for (int column = 0; column < mesh_.columns; ++column) {
      const double x = centres.x0[row * mesh_.centre_stride() + column];
      const double areal = density * mesh_.rows[row].quad_area;
      centres.mass[row * mesh_.centre_stride() + column] = areal * thickness(measure_, x) / 3.0;
      for (const Corner c :
           {Corner{row, column}, Corner{row, column + 1}, Corner{row + 1, column}, Corner{row + 1, column + 1}}) {
        corners.mass[mesh_.corner(c)] += areal * corner_thickness(measure_, x, mesh_.corner_x(c.column)) / 6.0;
      }
    }
  }
  invert_mass(corners);
  invert_mass(centres);
}

void Body::create_state() {
  for (int row = 0; row < mesh_.row_count(); ++row) {
    state_.emplace_back(mesh_.batches() * state_components(material(row)) * kBatchTriangles, 0.0);
    for (int component = kStressState; component < state_components(material(row)); ++component) {
      const auto initial = [component](const auto& law) { return law.initial(component); };
      fill_state(row, component, std::visit(initial, material(row)));
    }
  }
}

void Body::fill_state(int row, int component, double value) {
  const int components = state_components(material(row));
  for (std::size_t batch = 0; batch < mesh_.batches(); ++batch) {
    const auto first = state_[row].begin() + (batch * components + component) * kBatchTriangles;
    std::fill(first, first + kBatchTriangles, value);
  }
}

void Body::kick(double weight) {
  for (Nodes* nodes : {&corners, &centres}) {
    kernels_->kick(nodes->u.data(), nodes->fx.data(), nodes->inverse_mass.data(), weight, nodes->u.size());
    kernels_->kick(nodes->v.data(), nodes->fy.data(), nodes->inverse_mass.data(), weight, nodes->v.size());
  }
}

Vec2 Body::hold_supports() {
  Vec2 impulse{0.0, 0.0};
  for (int row = 0; row <= mesh_.row_count(); ++row) {
    const std::size_t left = mesh_.corner({row, 0});
    const std::size_t right = mesh_.corner({row, mesh_.columns});
    impulse.x -= corners.mass[left] * corners.u[left] + corners.mass[right] * corners.u[right];
    impulse.y -= corners.mass[right] * corners.v[right];
    corners.u[left] = corners.u[right] = corners.v[right] = 0.0;
    if (!mesh_.symmetric) {
      impulse.y -= corners.mass[left] * corners.v[left];
      corners.v[left] = 0.0;
    }
  }
  return impulse;
}

double Body::radial_force() const {
  double sum = 0.0;
  for (const Nodes* nodes : {&corners, &centres}) {
    for (std::size_t i = 0; i < nodes->fx.size(); ++i) sum += nodes->mass[i] > 0.0 ? nodes->fx[i] : 0.0;
  }
  return sum;
}

void Body::drift(double step) {
  for (Nodes* nodes : {&corners, &centres}) {
    kernels_->drift(nodes->x.data(), nodes->u.data(), step, nodes->x.size());
    kernels_->drift(nodes->y.data(), nodes->v.data(), step, nodes->y.size());
  }
}

double Body::stable_step() const {
  double bound = 0.0;  // of omega^2
  for (int row = 0; row < mesh_.row_count(); ++row) {
    bound = kernels_->largest_frequency(row_view(row), elastic_part(material(row)), quad_mass(row), measure_, bound);
  }
  return limit_of(bound);
}

/// Central differences with a viscosity that lags half a step are stable where M - dt/2 C - dt^2/4 K is positive. The
/// quads' parts of it are, for C <= beta K: a dilatation costs at least this modulus.
double Body::limit_of(double omega_squared) const {
  double beta = 0.0;  // s
  for (int row = 0; row < static_cast<int>(resistance_.size()); ++row) {
    const Elastic& law = elastic_part(material(row));
    const double modulus = law.lambda + (is_of_revolution(measure_) ? 2.0 / 3.0 : 1.0) * law.mu;
    beta = std::max(beta, resistance_[row].viscosity / modulus);
  }
  const double omega = std::sqrt(omega_squared);
  const double damping = 0.5 * beta * omega;
  return 2.0 / omega * (std::sqrt(1.0 + damping * damping) - damping);
}

double Body::stable_step(int row, int column) const {
  RowSweep view = row_view(row);
  for (NodeRow* nodes : {&view.upper, &view.lower, &view.centre}) {
    *nodes = {nodes->x + column, nodes->y + column, nodes->u + column, nodes->v + column};
  }
  view.quads = 1;
  QuadMass mass = quad_mass(row);
  mass.left += column * mass.width;
  return limit_of(kernels_->largest_frequency(view, elastic_part(material(row)), mass, measure_, 0.0));
}

QuadMass Body::quad_mass(int row) const {
  return {elastic_part(material(row)).density * mesh_.rows[row].quad_area, mesh_.left, mesh_.width};
}

double Body::mass() const {
  double sum = 0.0;
  for (const Nodes* nodes : {&corners, &centres}) {
    for (const double m : nodes->mass) sum += m;
  }
  return sum;
}

double Body::state(int component, int row, int column, int triangle) const {
  const int components = state_components(material(row));
  const auto offset = static_cast<std::size_t>(component) * static_cast<std::size_t>(kBatchTriangles);
  return state_[row][state_index(components, column, triangle) + offset];
}

Stress Body::stress(int row, int column, int triangle) const {
  return {state(kXX, row, column, triangle), state(kYY, row, column, triangle), state(kXY, row, column, triangle),
          state(kZZ, row, column, triangle)};
}

double Body::viscous_stress(int row, int column) const {
  return resistance_.empty() ? 0.0 : resistance_[row].stress[column];
}

double Body::plastic_strain(int row, int column, int triangle) const {
  const int flow = traits_of(material(row)).flow;
  return flow == kNoFlow ? 0.0 : std::max(0.0, state(flow, row, column, triangle));
}

Body::TriangleNodes Body::triangle(int row, int column, int triangle) const {
  const Corner ring[] = {{row + 1, column}, {row + 1, column + 1}, {row, column + 1}, {row, column}};
  const auto at = [this](Corner c) { return Vec2{corners.x[mesh_.corner(c)], corners.y[mesh_.corner(c)]}; };
  const std::size_t centre = row * mesh_.centre_stride() + column;
  return {at(ring[triangle]), at(ring[(triangle + 1) % 4]), {centres.x[centre], centres.y[centre]}};
}

}  // namespace grainstep::fe
