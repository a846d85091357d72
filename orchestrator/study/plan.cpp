#include "orchestrator/study/plan.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

#include "orchestrator/process/participants.hpp"
#include "orchestrator/record/summary.hpp"
#include "orchestrator/study/complaints.hpp"
#include "orchestrator/study/names.hpp"
#include "scene/load.hpp"

namespace grainstep::study {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_points = 100'000;

/// One point while its series is being expanded.
struct Draft {
  std::string name;
  std::string scene;  ///< path of the key that names it: "scene", "series.0.scene", ...
  std::vector<declare::Override> set;
  bool is_long = false;
};

class Expander {
 public:
  Expander(Plan& plan, Fidelity fidelity, const orchestrator::RunOptions& options, Complaints& complaints)
      : plan_(plan), fidelity_(fidelity), options_(options), complaints_(complaints) {}

  void all() {
    for (int i = 0; i < plan_.study.series_size(); ++i) series(i);
  }

 private:
  [[nodiscard]] declare::Origin origin(const std::string& path) const { return declare::origin_of(plan_.tree, path); }

  void append(std::vector<declare::Override>& set, const google::protobuf::RepeatedPtrField<std::string>& texts,
              const std::string& path) const {
    for (int i = 0; i < texts.size(); ++i) {
      set.push_back({.text = texts[i], .origin = origin(path + "." + std::to_string(i))});
    }
  }

  void series(int index) {
    const Series& series = plan_.study.series(index);
    const std::string path = "series." + std::to_string(index);
    Draft base{
        .name = "", .scene = series.scene().empty() ? "scene" : path + ".scene", .set = {}, .is_long = series.long_()};
    const bool full = fidelity_ == Fidelity::full;
    append(base.set, plan_.study.set(), "set");
    if (full) append(base.set, plan_.study.full(), "full");
    append(base.set, series.set(), path + ".set");
    if (full) append(base.set, series.full(), path + ".full");
    unique(series_names_, slug(series.name()), path + ".name", "series", series.name());
    point_names_.clear();
    for (int i = 0; i < series.points_size(); ++i) {
      add(index, varied(base, series.points(i), path + ".points." + std::to_string(i)));
    }
    if (series.axes_size() > 0) {
      product(index, base, 0);
    } else if (series.points_size() == 0) {
      add(index, base);
    }
  }

  Draft varied(Draft draft, const Point& point, const std::string& path) const {
    draft.name += (draft.name.empty() ? "" : ", ") + point.name();
    if (!point.scene().empty()) draft.scene = path + ".scene";
    append(draft.set, point.set(), path + ".set");
    draft.is_long = draft.is_long || point.long_();
    return draft;
  }

  void product(int index, const Draft& draft, int depth) {
    const Series& series = plan_.study.series(index);
    if (depth == series.axes_size()) return add(index, draft);
    const Axis& axis = series.axes(depth);
    const std::string path = "series." + std::to_string(index) + ".axes." + std::to_string(depth);
    if (axis.key().empty() != axis.values().empty() || axis.key().empty() == axis.choices().empty()) {
      return complaints_.add(origin(path), path, "expected either `key` and `values`, or `choices`");
    }
    for (int i = 0; i < axis.choices_size(); ++i) {
      product(index, varied(draft, axis.choices(i), path + ".choices." + std::to_string(i)), depth + 1);
    }
    for (int i = 0; i < axis.values_size(); ++i) {
      Draft next = draft;
      next.name +=
          (next.name.empty() ? "" : ", ") + axis.key().substr(axis.key().rfind('.') + 1) + "=" + axis.values(i);
      next.set.push_back(
          {.text = axis.key() + "=" + axis.values(i), .origin = origin(path + ".values." + std::to_string(i))});
      product(index, next, depth + 1);
    }
  }

  void unique(std::set<std::string>& names, const std::string& name, const std::string& path, const std::string& what,
              const std::string& written) {
    if (name.empty()) {
      complaints_.add(origin(path), path, "'" + written + "' has no letter or digit");
    } else if (!names.insert(name).second) {
      complaints_.add(origin(path), path,
                      "a second " + what + " of the name '" + written + "' (directory '" + name + "')");
    }
  }

  void add(int index, const Draft& draft) {
    if (plan_.points.size() >= most_points) {
      throw InputError(plan_.file.string() + ": more than " + std::to_string(most_points) + " points");
    }
    const Series& series = plan_.study.series(index);
    PlannedPoint point;
    point.series = series.name();
    point.name = draft.name.empty() ? series.name() : draft.name;
    point.id = draft.name.empty() ? series.name() : series.name() + "/" + draft.name;
    point.directory = fs::path("runs") / slug(series.name());
    if (!draft.name.empty()) {
      unique(point_names_, slug(draft.name), "series." + std::to_string(index), "point", draft.name);
      point.directory /= slug(draft.name);
    }
    for (const declare::Override& one : draft.set) point.set.push_back(one.text);
    point.is_long = draft.is_long;
    prepare(point, draft);
    plan_.points.push_back(std::move(point));
  }

  /// Relative to the file that says it.
  [[nodiscard]] fs::path scene_file(const std::string& path) const {
    const declare::Tree* node = &plan_.tree;
    for (std::size_t begin = 0; node != nullptr && begin <= path.size();) {
      const std::size_t end = std::min(path.find('.', begin), path.size());
      node = declare::child(*node, path.substr(begin, end - begin));
      begin = end + 1;
    }
    return (fs::path(origin(path).source).parent_path() / (node == nullptr ? "" : node->scalar)).lexically_normal();
  }

  /// A study has many points, and few files.
  const scene::SceneFile& read(const fs::path& file) {
    const auto known = files_.find(file);
    return known != files_.end() ? known->second : files_.emplace(file, scene::SceneFile(file)).first->second;
  }

  void prepare(PlannedPoint& point, const Draft& draft) {
    const fs::path file = scene_file(draft.scene);
    if (std::error_code ignored; !fs::is_regular_file(file, ignored)) {
      return complaints_.add(origin(draft.scene), draft.scene, "cannot read '" + file.string() + "': no such file");
    }
    try {
      scene::Scene scene = read(file).with(draft.set);
      try {
        point.preparation = orchestrator::prepare_unasked(std::move(scene), options_);
        ask(point);
      } catch (const InputError& error) {  // of a participant, which knows no files
        throw InputError(declare::problem_line(origin(draft.scene), "point '" + point.id + "'", error.what()));
      }
    } catch (const InputError& error) {
      return complaints_.add(error.what());
    }
    point.key = orchestrator::hash_text(scene::essence_hash(point.preparation.scene));
  }

  void ask(PlannedPoint& point) {
    for (const wire::Role role : {wire::IMPACTOR, wire::STRUCTURE}) {
      if (orchestrator::is_external(role, point.preparation.scene, options_)) {
        throw InputError("has an external participant, which a study cannot start");
      }
    }
    if (asked_++ < most_asked) {
      orchestrator::ask_participants(point.preparation, options_);
      const auto cost = orchestrator::cost_of(point.preparation);
      if (cost) last_estimate_ = std::max(cost->impactor, cost->structure);
    }
    point.estimate = last_estimate_;
  }

  Plan& plan_;
  Fidelity fidelity_;
  const orchestrator::RunOptions& options_;
  std::size_t asked_ = 0;
  double last_estimate_ = 0.0;
  Complaints& complaints_;
  std::map<fs::path, scene::SceneFile> files_;
  std::set<std::string> series_names_;
  std::set<std::string> point_names_;
};

}  // namespace

std::string slug(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool kept =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string_view("._+=-").find(c) != std::string_view::npos;
    const char next = kept ? c : '-';
    if (next == '=' && out.ends_with('-')) out.pop_back();
    if (next == '-' && (out.empty() || out.ends_with('-') || out.ends_with('='))) continue;
    if (next == '.' && out.empty()) continue;
    out += next;
  }
  while (out.ends_with('-')) out.pop_back();
  return out.substr(0, 120);
}

Plan load_plan(const fs::path& file, Fidelity fidelity, const orchestrator::RunOptions& options) {
  Plan plan;
  plan.file = file;
  plan.tree = scene::load(file, {}, plan.study);
  Complaints complaints;
  Expander(plan, fidelity, options, complaints).all();
  complaints.throw_if_any();
  check_names(plan, complaints);
  complaints.throw_if_any();
  return plan;
}

const PlannedPoint* point_of(const Plan& plan, const std::string& id) {
  const auto found =
      std::find_if(plan.points.begin(), plan.points.end(), [&](const PlannedPoint& point) { return point.id == id; });
  return found == plan.points.end() ? nullptr : &*found;
}

}  // namespace grainstep::study
