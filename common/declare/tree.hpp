/// @file What a scene file says, before anything is known about its meaning: scalars, lists and maps, each with the
/// place it came from. Own type, because merging must keep provenance and aliases must stay within limits.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace grainstep::declare {

/// Where something was written: a file and its line, or the command line.
struct Origin {
  std::string source;  ///< file as the user would name it, or "--set"
  int line = 0;        ///< from 1; 0: not in a particular line

  [[nodiscard]] std::string text() const;
};

struct Tree {
  enum class Kind { null, scalar, list, map };

  Kind kind = Kind::null;
  Origin origin;  ///< of the key, for the member of a map
  std::string scalar;
  bool quoted = false;  ///< the scalar stood in quotation marks: it is meant as text
  std::vector<Tree> items;
  std::map<std::string, Tree> members;

  /// What this is, for messages: "the text 'x'", "a list", "a map of keys", "nothing".
  [[nodiscard]] std::string description() const;
};

/// Lays `over` on `base`: maps merge deeply, everything else replaces.
void merge(Tree& base, Tree over);

/// Where the node at `path` ("a.b.0.c") was written; for an absent one, its nearest ancestor.
[[nodiscard]] Origin origin_of(const Tree& root, std::string_view path);

/// "a.b", or "b" where `parent` is the root.
[[nodiscard]] std::string join_path(const std::string& parent, std::string_view name);

/// nullptr where `parent` has no such member or item.
[[nodiscard]] const Tree* child(const Tree& parent, std::string_view name);

}  // namespace grainstep::declare
