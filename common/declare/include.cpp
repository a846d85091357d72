#include "declare/include.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "declare/yaml.hpp"

namespace grainstep::declare {
namespace {

namespace fs = std::filesystem;

/// Files that include two others each would otherwise double with every level.
constexpr int most_files = 64;

/// Reads one file after the other and remembers which are open.
class Includer {
 public:
  explicit Includer(Problems& problems) : problems_(problems) {}

  /// @param from where the include stands; for the first file its own name.
  Tree file(const fs::path& path, const Origin& from) {
    enter(path, from);
    Tree own = parse_yaml(text_of(path, from), path.string(), problems_);
    if (own.kind == Tree::Kind::null) own.kind = Tree::Kind::map;
    if (own.kind != Tree::Kind::map) {
      throw InputError(path.string() + ": expected a map of keys at the top level, found " + own.description());
    }
    Tree merged;
    merged.kind = Tree::Kind::map;
    for (const auto& name : take_includes(own)) {
      merge(merged, file((path.parent_path() / fs::path(name.scalar)).lexically_normal(), name.origin));
    }
    merge(merged, std::move(own));
    open_.pop_back();
    return merged;
  }

 private:
  void enter(const fs::path& path, const Origin& from) {
    std::error_code ignored;
    const fs::path identity = fs::weakly_canonical(path, ignored);
    if (std::find(open_.begin(), open_.end(), identity) != open_.end()) {
      throw InputError(problem_line(
          from, "include",
          "'" + path.string() + "' includes itself (by way of " + std::to_string(open_.size()) + " files)"));
    }
    if (++files_ > most_files) {
      throw InputError(problem_line(from, "include", "more than " + std::to_string(most_files) + " included files"));
    }
    open_.push_back(identity);
  }

  static std::string text_of(const fs::path& path, const Origin& from) {
    std::error_code error;
    const bool regular = fs::is_regular_file(path, error);
    const auto size = regular ? fs::file_size(path, error) : 0;
    if (regular && size > largest_file) {
      throw InputError(path.string() + ": " + std::to_string(size) + " bytes; a scene has at most " +
                       std::to_string(largest_file));
    }
    std::ifstream stream;
    if (regular) stream.open(path, std::ios::binary);  // a pipe would keep us waiting for its other end
    std::ostringstream text;
    if (regular && size > 0) text << stream.rdbuf();
    if (!regular || !stream) {
      throw InputError(problem_line(from, from.line > 0 ? "include" : "",
                                    "cannot read '" + path.string() + "': " +
                                        (fs::is_directory(path, error) ? "a directory, expected a file"
                                         : fs::exists(path, error)     ? "not a readable file"
                                                                       : "no such file")));
    }
    return text.str();
  }

  static std::vector<Tree> take_includes(Tree& own) {
    const auto found = own.members.find("include");
    if (found == own.members.end()) return {};
    const Tree include = std::move(found->second);
    own.members.erase(found);
    std::vector<Tree> names = include.kind == Tree::Kind::list ? include.items : std::vector{include};
    for (const auto& name : names) {
      if (name.kind == Tree::Kind::scalar && !name.scalar.empty()) continue;
      throw InputError(
          problem_line(name.origin, "include", "expected a path or a list of paths, found " + name.description()));
    }
    return names;
  }

  Problems& problems_;
  std::vector<fs::path> open_;
  int files_ = 0;
};

}  // namespace

Tree read_file(const fs::path& path, Problems& problems) {
  return Includer(problems).file(path, Origin{path.string(), 0});
}

}  // namespace grainstep::declare
