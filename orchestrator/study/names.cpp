#include "orchestrator/study/names.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "declare/declaration.hpp"
#include "orchestrator/record/summary.hpp"
#include "results/hdf5.hpp"
#include "results/run_directory.hpp"

namespace grainstep::study {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using Json = nlohmann::ordered_json;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::array groups_of_datasets = {"series", "ledger", "profiles", "timings"};

/// nullptr where summary.json has no such key.
const Json* in_summary(const Json& summary, const std::string& name) {
  const auto dot = name.find('.');
  const auto found = summary.find(name.substr(0, dot));
  if (found == summary.end()) return nullptr;
  if (dot == std::string::npos) return &*found;
  return found->is_object() ? in_summary(*found, name.substr(dot + 1)) : nullptr;
}

bool is_dataset(const std::string& name) {
  const auto dot = name.find('.');
  return dot != std::string::npos && std::find(groups_of_datasets.begin(), groups_of_datasets.end(),
                                               name.substr(0, dot)) != groups_of_datasets.end();
}

Values dataset(const std::filesystem::path& run, std::string name) {
  std::replace(name.begin(), name.end(), '.', '/');
  try {
    const auto file = results::h5::File::read(results::RunDirectory(run).results());
    if (!file.has("/" + name)) throw InputError(run.string() + ": results.h5 has no dataset /" + name);
    return file.read_doubles("/" + name);
  } catch (const OutputError& error) {
    throw InputError(error.what());
  }
}

double scalar_number(const Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection.GetDouble(message, &field);
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.GetUInt32(message, &field);
    case FieldDescriptor::CPPTYPE_UINT64:
      return static_cast<double>(reflection.GetUInt64(message, &field));
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.GetBool(message, &field) ? 1.0 : 0.0;
    default:
      return nothing;
  }
}

/// Of a section that is written as one scalar (`time.end`): whichever alternative holds a number.
std::optional<double> alternative_number(const Message& message) {
  std::vector<const FieldDescriptor*> set;
  message.GetReflection()->ListFields(message, &set);
  for (const FieldDescriptor* field : set) {
    if (const double value = scalar_number(message, *field); value == value) return value;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> number_at(const Message& message, const std::string& path) {
  const auto dot = path.find('.');
  const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(path.substr(0, dot));
  if (field == nullptr) return std::nullopt;
  std::string rest = dot == std::string::npos ? "" : path.substr(dot + 1);
  const auto& reflection = *message.GetReflection();
  if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
    const bool plain = rest.empty() && !field->is_repeated();
    if (!plain || (field->has_presence() && !reflection.HasField(message, field))) return std::nullopt;
    const double value = scalar_number(message, *field);
    return value == value ? std::optional(value) : std::nullopt;
  }
  if (!field->is_repeated()) {
    const Message& part = reflection.GetMessage(message, field);
    return rest.empty() ? alternative_number(part) : number_at(part, rest);
  }
  int index = -1;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), index);
  const bool inside = error == std::errc() && index >= 0 && index < reflection.FieldSize(message, field);
  if (!inside || end == rest.data() + rest.size() || *end != '.') return std::nullopt;
  rest.erase(0, static_cast<std::size_t>(end - rest.data()) + 1);
  return number_at(reflection.GetRepeatedMessage(message, field, index), rest);
}

class Numbers::OfPoint : public Names {
 public:
  OfPoint(const Numbers& all, std::size_t index) : all_(all), index_(index) {}

  [[nodiscard]] Values value(const std::string& name) const override {
    const auto& columns = all_.columns_[index_];
    if (const auto found = columns.find(name); found != columns.end()) return {found->second};
    const Outcome& outcome = all_.outcomes_[index_];
    const bool done = outcome.state == Outcome::State::done;
    if (const Json* found = done ? in_summary(outcome.summary, name) : nullptr) {
      return {found->is_number() ? found->get<double>() : nothing};
    }
    if (const auto found = number_at(all_.plan_.points[index_].preparation.scene, name)) return {*found};
    if (is_dataset(name) && done) return dataset(outcome.directory, name);
    return {nothing};
  }

  [[nodiscard]] const Names* elsewhere(const std::string& where) const override { return all_.of(where); }

 private:
  const Numbers& all_;
  std::size_t index_;
};

class Numbers::OfSeries : public Names {
 public:
  OfSeries(const Numbers& all, std::vector<std::size_t> points) : all_(all), points_(std::move(points)) {}

  [[nodiscard]] bool empty() const { return points_.empty(); }

  [[nodiscard]] Values value(const std::string& name) const override {
    Values out;
    for (const std::size_t point : points_) {
      const Values one = all_.of_point(point).value(name);
      if (one.size() != 1) throw InputError("'" + name + "' is a list for every run; `on` must be a point");
      out.push_back(one[0]);
    }
    return out;
  }

  [[nodiscard]] const Names* elsewhere(const std::string& where) const override { return all_.of(where); }

 private:
  const Numbers& all_;
  std::vector<std::size_t> points_;
};

Numbers::Numbers(const Plan& plan, const std::vector<Outcome>& outcomes)
    : plan_(plan), outcomes_(outcomes), columns_(plan.points.size()) {
  std::map<std::string, std::vector<std::size_t>> done;
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    points_.push_back(std::make_unique<OfPoint>(*this, i));
    if (outcomes[i].state == Outcome::State::done) done[plan.points[i].series].push_back(i);
  }
  for (auto& [name, indices] : done) series_.emplace(name, std::make_unique<OfSeries>(*this, std::move(indices)));
  for (const std::string& id : plan.study.reference()) {
    for (std::size_t i = 0; i < plan.points.size() && !reference_; ++i) {
      if (plan.points[i].id == id && outcomes[i].state == Outcome::State::done) reference_ = i;
    }
  }
}

Numbers::~Numbers() = default;

void Numbers::compute_columns() {
  for (const Column& column : plan_.study.columns()) {
    const Expression value(formula_of(column));
    std::vector<double> found(points_.size(), nothing);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (outcomes_[i].state == Outcome::State::done) found[i] = value.number(*points_[i]);
    }
    for (std::size_t i = 0; i < points_.size(); ++i) columns_[i][column.name()] = found[i];
  }
}

double Numbers::column(std::size_t point, const std::string& name) const { return columns_[point].at(name); }

double Numbers::of_series(const std::string& series, const Column& column) const {
  const Names* names = of(series);
  return names == nullptr ? nothing : Expression(formula_of(column)).number(*names);
}

const Names& Numbers::of_point(std::size_t point) const { return *points_[point]; }

const Names* Numbers::of(const std::string& where) const {
  if (where == "reference") return reference_ ? points_[*reference_].get() : nullptr;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (plan_.points[i].id == where) return outcomes_[i].state == Outcome::State::done ? points_[i].get() : nullptr;
  }
  const auto found = series_.find(where);
  return found == series_.end() ? nullptr : found->second.get();
}

}  // namespace grainstep::study
