#include "declare/tree_builder.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"

namespace grainstep::declare {
namespace {

/// A scene has about six levels.
constexpr int deepest_level = 32;
/// All nodes together, aliases expanded: a few lines of nested aliases could otherwise fill the memory.
constexpr std::size_t largest_tree = 4UL * 1024 * 1024;
constexpr std::size_t node_weight = 64;

std::string too_deep() { return "more than " + std::to_string(deepest_level) + " levels of lists and maps"; }

/// As the loader's other texts call nothing: an empty value, ~ or null without quotation marks.
bool is_null(const std::string& text) {
  return text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL";
}

}  // namespace

void TreeBuilder::fail(int line, const std::string& text) const {
  throw InputError(problem_line({source_, line}, "", text));
}

Tree TreeBuilder::node(int line, Tree::Kind kind) const {
  Tree tree;
  tree.kind = kind;
  tree.origin = {source_, line};
  return tree;
}

void TreeBuilder::spend(int line, std::size_t weight) {
  weight_ += weight;
  if (weight_ > largest_tree) fail(line, "the file is too large once its aliases are written out");
}

/// YAML lets a later anchor of the same name take over; whoever wrote it hardly meant that.
void TreeBuilder::declare(const Place& place) {
  if (place.anchor.empty()) return;
  const auto [known, inserted] = anchors_.emplace(place.anchor, Anchored{.line = place.line, .tree = {}});
  if (!inserted) {
    fail(place.line, "the anchor '&" + place.anchor + "' is already given in line " +
                         std::to_string(known->second.line) + "; aliases must mean one thing");
  }
}

void TreeBuilder::scalar(const Place& place, const std::string& text, bool quoted) {
  declare(place);
  const std::size_t before = weight_;
  Tree tree = node(place.line, !quoted && is_null(text) ? Tree::Kind::null : Tree::Kind::scalar);
  if (tree.kind == Tree::Kind::scalar) tree.scalar = text;
  tree.quoted = quoted;
  complete({.tree = std::move(tree), .anchor = place.anchor, .levels = 1, .weight_before = before});
}

void TreeBuilder::alias(const Place& place) {
  const auto found = anchors_.find(place.anchor);
  if (found == anchors_.end()) {
    fail(place.line, "'*" + place.anchor + "' stands for nothing: expected an anchor '&" + place.anchor + "' before");
  }
  const Anchored& known = found->second;
  if (!known.finished) fail(place.line, "an alias inside of what it stands for");
  const std::size_t before = weight_;
  spend(place.line, known.weight);
  Tree copy = known.tree;
  copy.origin = {source_, place.line};
  complete({.tree = std::move(copy), .anchor = "", .levels = known.levels, .weight_before = before});
}

void TreeBuilder::open(const Place& place, Tree::Kind kind) {
  if (static_cast<int>(frames_.size()) >= deepest_level) fail(place.line, too_deep());
  declare(place);
  Frame frame;
  frame.tree = node(place.line, kind);
  frame.anchor = place.anchor;
  frame.weight_before = weight_;
  frames_.push_back(std::move(frame));
}

void TreeBuilder::close() {
  Frame frame = std::move(frames_.back());
  frames_.pop_back();
  complete({.tree = std::move(frame.tree),
            .anchor = std::move(frame.anchor),
            .levels = frame.levels,
            .weight_before = frame.weight_before});
}

/// Remember it if it has an anchor, hand it to its parent.
void TreeBuilder::complete(Finished finished) {
  auto& [tree, anchor, levels, weight_before] = finished;
  const int line = tree.origin.line;
  spend(line, node_weight + tree.scalar.size());
  if (static_cast<int>(frames_.size()) + levels > deepest_level + 1) fail(line, too_deep());
  if (!anchor.empty()) {
    Anchored& known = anchors_[anchor];
    known.finished = true;
    known.tree = tree;
    known.weight = weight_ - weight_before;
    known.levels = levels;
  }
  if (frames_.empty()) {
    root_ = std::move(tree);
    return;
  }
  Frame& parent = frames_.back();
  parent.levels = std::max(parent.levels, levels + 1);
  if (parent.tree.kind == Tree::Kind::list) {
    parent.tree.items.push_back(std::move(tree));
  } else if (parent.has_key) {
    insert(parent, std::move(tree));
  } else {
    read_key(parent, tree);
  }
}

void TreeBuilder::read_key(Frame& parent, const Tree& tree) const {
  if (tree.kind != Tree::Kind::scalar) {
    fail(tree.origin.line, "a key must be a name, but here is " + tree.description());
  }
  parent.has_key = true;
  parent.key = tree.scalar;
  parent.key_origin = tree.origin;
}

void TreeBuilder::insert(Frame& parent, Tree value) {
  parent.has_key = false;
  value.origin = parent.key_origin;
  const auto [place, inserted] = parent.tree.members.emplace(parent.key, std::move(value));
  if (!inserted) {
    problems_.add(parent.key_origin, path_of_frames(),
                  "this key is already given in line " + std::to_string(place->second.origin.line));
  }
}

/// Of the key that is being read.
std::string TreeBuilder::path_of_frames() const {
  std::string path;
  for (const auto& frame : frames_) {
    path = join_path(path, frame.tree.kind == Tree::Kind::list ? std::to_string(frame.tree.items.size()) : frame.key);
  }
  return path;
}

}  // namespace grainstep::declare
