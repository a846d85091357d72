/// @file From a YAML parser's events to a Tree, in bounded memory.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "declare/problems.hpp"
#include "declare/tree.hpp"

namespace grainstep::declare {

/// Call order: one node (scalar, alias, or open ... close with nodes between), then take(). In a map, keys and values
/// alternate. Every call may throw InputError ("file:line: what is wrong"); nothing may be called after that.
class TreeBuilder {
 public:
  /// Where a node begins, and what later aliases call it.
  struct Place {
    int line = 0;             ///< from 1
    std::string anchor = {};  ///< empty: none
  };

  /// Duplicate keys go to `problems`, with the first one kept.
  TreeBuilder(std::string source, Problems& problems) : source_(std::move(source)), problems_(problems) {}

  void scalar(const Place& place, const std::string& text, bool quoted);
  void alias(const Place& place);  ///< of the node whose anchor was place.anchor
  void open(const Place& place, Tree::Kind kind);
  void close();

  [[nodiscard]] Tree take() { return std::move(root_); }

 private:
  struct Frame {
    Tree tree;
    std::string anchor;
    int levels = 1;  ///< depth of what it holds so far, itself included
    std::size_t weight_before = 0;
    bool has_key = false;
    std::string key;
    Origin key_origin;
  };
  struct Anchored {
    int line = 0;
    bool finished = false;
    Tree tree;
    std::size_t weight = 0;
    int levels = 1;
  };
  struct Finished {
    Tree tree;
    std::string anchor;
    int levels = 1;
    std::size_t weight_before = 0;
  };

  [[nodiscard]] Tree node(int line, Tree::Kind kind) const;
  void declare(const Place& place);
  void spend(int line, std::size_t weight);
  void complete(Finished node);
  void read_key(Frame& parent, const Tree& tree) const;
  void insert(Frame& parent, Tree value);
  [[nodiscard]] std::string path_of_frames() const;
  [[noreturn]] void fail(int line, const std::string& text) const;

  std::string source_;
  Problems& problems_;
  Tree root_;
  std::vector<Frame> frames_;
  std::map<std::string, Anchored> anchors_;
  std::size_t weight_ = 0;
};

}  // namespace grainstep::declare
