#include "replay/recording.hpp"

#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "participant/check_surface.hpp"
#include "replay/format.hpp"

namespace grainstep::replay {
namespace {

constexpr std::size_t block_values = std::size_t{1} << 19U;  // 4 MiB of each kind

std::filesystem::path file_of(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::is_directory(path, none) ? path / record_file : path;
}

/// Not even opened: a pipe would keep us waiting.
void require_file(const std::filesystem::path& path, const std::string& key) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_regular_file(status)) return;
  const bool there = std::filesystem::exists(status);
  throw InputError(key + ": " + path.string() + (there ? ": is no file" : ": no such file") +
                   "; expected the directory of a run that had output.record: true, or the " + record_file + " in it");
}

results::h5::File opened(const std::filesystem::path& path, const std::string& key) {
  require_file(path, key);
  try {
    return results::h5::File::read(path);
  } catch (const OutputError& error) {
    throw InputError(key + ": " + error.what());
  }
}

}  // namespace

Recording::Recording(const std::filesystem::path& path, const std::string& key)
    : key_(key),
      path_(file_of(path)),
      file_(opened(path_, key)),
      impulse_{.dataset = dataset::impulse},
      position_{.dataset = dataset::position},
      velocity_{.dataset = dataset::velocity} {
  try {
    read_about();
    read_shapes();
    read_books();
  } catch (const OutputError& error) {
    throw InputError(key_ + ": " + error.what() + ". It is no record of a surface, or it is damaged");
  }
}

void Recording::refuse(const std::string& why) const {
  throw InputError(key_ + ": " + path_.string() + ": " + why + ". It is no record of a surface, or it is damaged");
}

void Recording::read_about() {
  const auto read = google::protobuf::util::JsonStringToMessage(file_.read_text(dataset::about), &about_);
  if (!read.ok()) refuse(std::string(dataset::about) + ": " + std::string(read.message()));
  const unsigned dimension = about_.dimension();
  if (dimension != 2 && dimension != 3)
    refuse(std::string(dataset::about) + ": dimension " + std::to_string(dimension));
  if (!std::isfinite(about_.window()) || !(about_.window() > 0.0)) refuse(std::string(dataset::about) + ": window");
  if (const auto problem = participant::surface_problem(about_.structure().surface(), dimension)) {
    refuse(std::string(dataset::about) + ": structure.surface" + *problem);
  }
  columns_ = static_cast<std::size_t>(about_.structure().surface().position_size());
}

void Recording::read_shapes() {
  const std::uint64_t rows = file_.shape(dataset::time).rows;
  if (rows == 0) refuse("has no rows: the run ended before its first window");
  for (const Rows* one : {&impulse_, &position_, &velocity_}) {
    const auto [found, columns] = file_.shape(one->dataset);
    if (found == rows && columns == columns_) continue;
    refuse(std::string(one->dataset) + " is " + std::to_string(found) + " x " + std::to_string(columns) +
           ", expected " + std::to_string(rows) + " x " + std::to_string(columns_));
  }
  last_ = rows - 1;
}

void Recording::read_books() {
  impactor_momentum_.assign(about_.dimension(), 0.0);
  if (!file_.has(dataset::impactor_energy)) return;
  const std::vector<double> energy = file_.read_doubles(dataset::impactor_energy);
  const std::vector<double> momentum = file_.read_doubles(dataset::impactor_momentum);
  if (energy.size() != 1 || momentum.size() != impactor_momentum_.size()) refuse("/impactor has other sizes");
  impactor_energy_ = energy.front();
  impactor_momentum_ = momentum;
}

std::span<const double> Recording::row(Rows& rows, std::uint64_t window) {
  const std::uint64_t held = rows.values.size() / columns_;
  if (window < rows.first || window >= rows.first + held) {
    const std::uint64_t most = std::max<std::uint64_t>(1, block_values / columns_);
    const std::uint64_t count = std::min(most, last_ + 1 - window);
    rows.first = window;
    rows.values.resize(count * columns_);
    try {
      file_.read_rows(rows.dataset, window, count, rows.values);
    } catch (const OutputError& error) {
      rows.values.clear();
      refuse(error.what());
    }
    if (!std::ranges::all_of(rows.values, [](double value) { return std::isfinite(value); })) {
      rows.values.clear();
      refuse(std::string(rows.dataset) + " holds what is no number");
    }
  }
  return std::span(rows.values).subspan((window - rows.first) * columns_, columns_);
}

}  // namespace grainstep::replay
