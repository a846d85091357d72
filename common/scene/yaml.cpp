#include "scene/yaml.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"

namespace grainstep::scene {
namespace {

/// A scene has about six levels.
constexpr int deepest_level = 32;
/// All nodes together, aliases expanded: a few lines of nested aliases could otherwise fill the memory.
constexpr std::size_t largest_tree = 4UL * 1024 * 1024;
constexpr std::size_t node_weight = 64;

/// Builds the tree from the parser's events.
class Builder final : public YAML::EventHandler {
 public:
  Builder(std::string source, Problems& problems) : source_(std::move(source)), problems_(problems) {}

  [[nodiscard]] Tree take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnAnchor(const YAML::Mark&, const std::string&) override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    complete(node(mark, Tree::Kind::null), anchor, 1);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    Tree scalar = node(mark, Tree::Kind::scalar);
    scalar.scalar = value;
    scalar.quoted = tag == "!";
    complete(std::move(scalar), anchor, 1);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) fail(mark, "an alias inside of what it stands for");
    spend(mark, found->second.weight);
    Tree copy = found->second.tree;
    copy.origin = at(mark);
    complete(std::move(copy), 0, found->second.levels);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, Tree::Kind::list, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, Tree::Kind::map, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Frame {
    Tree tree;
    YAML::anchor_t anchor = 0;
    int levels = 1;  ///< depth of what it holds so far, itself included
    std::size_t weight_before = 0;
    bool has_key = false;
    std::string key;
    Origin key_origin;
  };
  struct Anchored {
    Tree tree;
    std::size_t weight = 0;
    int levels = 1;
  };

  [[nodiscard]] Origin at(const YAML::Mark& mark) const { return {source_, mark.line + 1}; }

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& text) const {
    throw InputError(problem_line(at(mark), "", text));
  }

  void spend(const YAML::Mark& mark, std::size_t weight) {
    weight_ += weight;
    if (weight_ > largest_tree) fail(mark, "the file is too large once its aliases are written out");
  }

  Tree node(const YAML::Mark& mark, Tree::Kind kind) {
    Tree tree;
    tree.kind = kind;
    tree.origin = at(mark);
    return tree;
  }

  void open(const YAML::Mark& mark, Tree::Kind kind, YAML::anchor_t anchor) {
    if (static_cast<int>(frames_.size()) >= deepest_level) fail(mark, too_deep());
    Frame frame;
    frame.tree = node(mark, kind);
    frame.anchor = anchor;
    frame.weight_before = weight_;
    frames_.push_back(std::move(frame));
  }

  void close() {
    Frame frame = std::move(frames_.back());
    frames_.pop_back();
    weight_at_open_ = frame.weight_before;
    complete(std::move(frame.tree), frame.anchor, frame.levels);
  }

  static std::string too_deep() { return "more than " + std::to_string(deepest_level) + " levels of lists and maps"; }

  /// A finished node: remember it if it has an anchor, hand it to its parent.
  void complete(Tree tree, YAML::anchor_t anchor, int levels) {
    const bool leaf = tree.kind == Tree::Kind::scalar || tree.kind == Tree::Kind::null;
    const std::size_t before = leaf ? weight_ : weight_at_open_;
    weight_ += node_weight + tree.scalar.size();
    const YAML::Mark mark = mark_of(tree);
    spend(mark, 0);
    if (static_cast<int>(frames_.size()) + levels > deepest_level + 1) fail(mark, too_deep());
    if (anchor != 0) anchors_[anchor] = {tree, weight_ - before, levels};
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

  static YAML::Mark mark_of(const Tree& tree) {
    YAML::Mark mark;
    mark.line = tree.origin.line - 1;
    return mark;
  }

  void read_key(Frame& parent, const Tree& tree) {
    if (tree.kind != Tree::Kind::scalar) fail(mark_of(tree), "a key must be a name, but here is " + tree.description());
    parent.has_key = true;
    parent.key = tree.scalar;
    parent.key_origin = tree.origin;
  }

  void insert(Frame& parent, Tree value) {
    parent.has_key = false;
    value.origin = parent.key_origin;
    const auto [place, inserted] = parent.tree.members.emplace(parent.key, std::move(value));
    if (!inserted) {
      problems_.add(parent.key_origin, path_of_frames(),
                    "this key is already given in line " + std::to_string(place->second.origin.line));
    }
  }

  /// Path of the key that is being read.
  [[nodiscard]] std::string path_of_frames() const {
    std::string path;
    for (const auto& frame : frames_) {
      path = join_path(path, frame.tree.kind == Tree::Kind::list ? std::to_string(frame.tree.items.size()) : frame.key);
    }
    return path;
  }

  std::string source_;
  Problems& problems_;
  Tree root_;
  std::vector<Frame> frames_;
  std::unordered_map<YAML::anchor_t, Anchored> anchors_;
  std::size_t weight_ = 0;
  std::size_t weight_at_open_ = 0;
};

int line_of(const std::string& text, std::size_t offset) {
  return static_cast<int>(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

/// Control characters are no YAML, and the parser takes some of them for the end of the file.
void check_characters(const std::string& text, const std::string& source) {
  if (text.size() > largest_file) {
    throw InputError(source + ": " + std::to_string(text.size()) + " bytes; a scene has at most " +
                     std::to_string(largest_file));
  }
  const auto bad = std::find_if(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\n' && c != '\r' && c != '\t');
  });
  if (bad == text.end()) return;
  throw InputError(source + ":" + std::to_string(line_of(text, static_cast<std::size_t>(bad - text.begin()))) +
                   ": a control character (byte " + std::to_string(static_cast<unsigned char>(*bad)) +
                   "); expected YAML text in UTF-8");
}

Tree parse(const std::string& text, const std::string& source, Problems& problems) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Builder builder(source, problems);
  if (!parser.HandleNextDocument(builder)) return {};
  Tree tree = builder.take();
  Problems ignored;
  Builder second(source, ignored);
  if (parser.HandleNextDocument(second)) {
    throw InputError(source + ": more than one YAML document (---); expected one");
  }
  return tree;
}

}  // namespace

Tree parse_yaml(const std::string& text, const std::string& source, Problems& problems) {
  check_characters(text, source);
  Tree tree;
  try {
    tree = parse(text, source, problems);
  } catch (const YAML::Exception& error) {
    throw InputError(problem_line({source, error.mark.line + 1}, "", "not YAML: " + error.msg));
  }
  tree.origin = {source, 0};
  return tree;
}

}  // namespace grainstep::scene
