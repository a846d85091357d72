#include "declare/tree.hpp"

#include <charconv>
#include <utility>

namespace grainstep::declare {

std::string Origin::text() const { return line > 0 ? source + ":" + std::to_string(line) : source; }

std::string Tree::description() const {
  constexpr std::size_t longest_quote = 60;
  switch (kind) {
    case Kind::scalar:
      return scalar.size() <= longest_quote ? "'" + scalar + "'"
                                            : "a text of " + std::to_string(scalar.size()) + " bytes";
    case Kind::list:
      return "a list";
    case Kind::map:
      return "a map of keys";
    case Kind::null:
      break;
  }
  return "nothing";
}

void merge(Tree& base, Tree over) {
  if (base.kind != Tree::Kind::map || over.kind != Tree::Kind::map) {
    base = std::move(over);
    return;
  }
  base.origin = over.origin;
  for (auto& [name, member] : over.members) {
    if (const auto found = base.members.find(name); found != base.members.end()) {
      merge(found->second, std::move(member));
    } else {
      base.members.emplace(name, std::move(member));
    }
  }
}

const Tree* child(const Tree& parent, std::string_view name) {
  if (parent.kind == Tree::Kind::map) {
    const auto found = parent.members.find(std::string(name));
    return found == parent.members.end() ? nullptr : &found->second;
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  const bool number = error == std::errc() && end == name.data() + name.size();
  return parent.kind == Tree::Kind::list && number && index < parent.items.size() ? &parent.items[index] : nullptr;
}

Origin origin_of(const Tree& root, std::string_view path) {
  const Tree* node = &root;
  while (!path.empty()) {
    const auto dot = path.find('.');
    const Tree* next = child(*node, path.substr(0, dot));
    if (next == nullptr) break;
    node = next;
    path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
  }
  return node->origin;
}

std::string join_path(const std::string& parent, std::string_view name) {
  return parent.empty() ? std::string(name) : parent + "." + std::string(name);
}

}  // namespace grainstep::declare
