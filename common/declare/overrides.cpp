#include "declare/overrides.hpp"

#include <charconv>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "declare/yaml.hpp"

namespace grainstep::declare {
namespace {

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> names{""};
  for (const char c : path) {
    if (c == '.') {
      names.emplace_back();
    } else {
      names.back() += c;
    }
  }
  return names;
}

std::optional<std::size_t> item_number(const std::string& name) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return index;
}

/// The place that `name` has in `parent`, made if it is not there.
Tree& descend(Tree& parent, const std::string& name, const Origin& origin) {
  const auto index = item_number(name);
  if (parent.kind == Tree::Kind::null) parent.kind = index == 0 ? Tree::Kind::list : Tree::Kind::map;
  if (parent.kind == Tree::Kind::map) {
    const auto [place, inserted] = parent.members.try_emplace(name);
    if (inserted) place->second.origin = origin;
    return place->second;
  }
  if (parent.kind != Tree::Kind::list) throw InputError("what should hold '" + name + "' is " + parent.description());
  if (!index || *index > parent.items.size()) {
    throw InputError("'" + name + "' is not an item of this list of " + std::to_string(parent.items.size()) +
                     "; its items are counted from 0");
  }
  if (*index == parent.items.size()) {
    parent.items.emplace_back();
    parent.items.back().origin = origin;
  }
  return parent.items[*index];
}

void set_origin(Tree& tree, const Origin& origin) {
  tree.origin = origin;
  for (auto& item : tree.items) set_origin(item, origin);
  for (auto& [name, member] : tree.members) set_origin(member, origin);
}

}  // namespace

void apply_override(Tree& root, const Override& override, Problems& problems) {
  const auto& [text, origin] = override;
  const auto equals = text.find('=');
  const std::string path = text.substr(0, equals);
  const auto names = split_path(path);
  try {
    if (equals == std::string::npos) throw InputError("expected PATH=VALUE, for example impactor.slug.speed='300 m/s'");
    if (names.front() == "include") throw InputError("a file is included by a file only");
    Tree value = parse_yaml(text.substr(equals + 1), origin.source, problems);
    set_origin(value, origin);
    Tree* place = &root;
    for (const auto& name : names) {
      if (name.empty()) throw InputError("a name is missing in this path");
      place = &descend(*place, name, origin);
    }
    merge(*place, std::move(value));
  } catch (const InputError& error) {
    problems.add(origin, path, error.what());
  }
}

}  // namespace grainstep::declare
