#include "declare/read.hpp"

#include "base/assert.hpp"
#include "base/error.hpp"
#include "declare/declaration.hpp"
#include "declare/free_settings.hpp"
#include "declare/scalar.hpp"
#include "declare/suggest.hpp"
#include "declare/yaml.hpp"

namespace grainstep::declare {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

std::string found_instead(const Tree& tree, const std::string& expected) {
  return "expected " + expected + ", found " + tree.description();
}

std::string advice_for(const std::string& name, const std::vector<std::string>& known) {
  if (name == "include") return "; a file is included at its top level only";
  if (name == "<<") return "; YAML's merge key is not read: write the keys out, or put them into a file to include";
  if (name.find(':') != std::string::npos) return "; a blank is missing behind its colon";
  return hint(name, known);
}

class Reader {
 public:
  explicit Reader(Problems& problems) : problems_(problems) {}

  void section(const Tree& tree, const std::string& path, Message& message) {
    const auto& descriptor = *message.GetDescriptor();
    if (section_of(descriptor).scalar_form()) return scalar_section(tree, path, message);
    if (tree.kind != Tree::Kind::map) {
      return problems_.add(tree.origin, path, found_instead(tree, expected_section(descriptor)));
    }
    refuse_unknown(tree, path, descriptor);
    for (int i = 0; i < descriptor.field_count(); ++i) {
      const FieldDescriptor& field = *descriptor.field(i);
      const auto member = tree.members.find(field.name());
      if (member == tree.members.end()) {
        absent(tree, path, message, field);
      } else {
        present(member->second, join_path(path, field.name()), message, field);
      }
    }
  }

 private:
  void refuse_unknown(const Tree& tree, const std::string& path, const google::protobuf::Descriptor& descriptor) {
    const auto known = key_names(descriptor);
    for (const auto& [name, member] : tree.members) {
      if (descriptor.FindFieldByName(name) != nullptr) continue;
      const std::string advice = advice_for(name, known);
      problems_.add(
          member.origin, join_path(path, name),
          "unknown key" + advice + (advice.ends_with('?') ? " " : ". ") + "Known keys here: " + join_words(known));
    }
  }

  void scalar_section(const Tree& tree, const std::string& path, Message& message) {
    if (tree.kind != Tree::Kind::scalar) {
      return problems_.add(tree.origin, path, found_instead(tree, expected_section(*message.GetDescriptor())));
    }
    guarded(tree, path, [&] { set_alternative(tree, message); });
  }

  void absent(const Tree& parent, const std::string& path, Message& message, const FieldDescriptor& field) {
    const auto& key = key_of(field);
    if (key.required()) {
      problems_.add(parent.origin, path,
                    "required key '" + field.name() + "' is missing: " + key.text() + " Expected " +
                        (field.is_repeated() ? "a list" : expected_value(field)));
    } else if (!key.default_value().empty()) {
      const Tree value = parse_yaml(key.default_value(), "default", problems_);
      present(value, join_path(path, field.name()), message, field);
    }
  }

  void present(const Tree& tree, const std::string& path, Message& message, const FieldDescriptor& field) {
    if (tree.kind == Tree::Kind::null) {
      return problems_.add(
          tree.origin, path,
          "this key has no value; expected " + (field.is_repeated() ? std::string("a list") : expected_value(field)));
    }
    const auto* oneof = field.real_containing_oneof();
    if (oneof != nullptr && message.GetReflection()->HasOneof(message, oneof)) {
      return problems_.add(tree.origin, path, "only one of the alternatives may be given: " + member_names(*oneof));
    }
    if (!field.is_repeated()) return value(tree, path, message, field);
    if (tree.kind != Tree::Kind::list) return problems_.add(tree.origin, path, found_instead(tree, "a list"));
    if (key_of(field).has_min_items() && tree.items.size() < key_of(field).min_items()) {
      problems_.add(tree.origin, path,
                    "a list of " + std::to_string(tree.items.size()) + "; it needs at least " +
                        std::to_string(key_of(field).min_items()));
    }
    for (std::size_t i = 0; i < tree.items.size(); ++i) {
      value(tree.items[i], join_path(path, std::to_string(i)), message, field);
    }
  }

  static std::string member_names(const google::protobuf::OneofDescriptor& oneof) {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(oneof.field_count()));
    for (int i = 0; i < oneof.field_count(); ++i) names.push_back(oneof.field(i)->name());
    return join_words(names);
  }

  /// One value: of a key, or of one item of its list.
  void value(const Tree& tree, const std::string& path, Message& message, const FieldDescriptor& field) {
    GS_ASSERT(!field.is_map(), field.full_name() + ": scenes have no map fields");
    if (is_free(field) && tree.kind != Tree::Kind::map) {
      return problems_.add(tree.origin, path, found_instead(tree, expected_value(field)));
    }
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      const auto& reflection = *message.GetReflection();
      Message& part =
          field.is_repeated() ? *reflection.AddMessage(&message, &field) : *reflection.MutableMessage(&message, &field);
      if (is_free(field)) {
        return guarded(tree, path, [&] { part.CopyFrom(free_settings(tree)); });
      }
      return section(tree, path, part);
    }
    if (tree.kind != Tree::Kind::scalar) {
      return problems_.add(tree.origin, path, found_instead(tree, expected_value(field)));
    }
    guarded(tree, path, [&] { set_scalar(tree, message, field); });
  }

  template <typename Action>
  void guarded(const Tree& tree, const std::string& path, Action action) {
    try {
      action();
    } catch (const InputError& error) {
      problems_.add(tree.origin, path, error.what());
    }
  }

  Problems& problems_;
};

}  // namespace

void read_message(const Tree& tree, const std::string& path, Message& message, Problems& problems) {
  Reader(problems).section(tree, path, message);
}

std::unique_ptr<Message> defaults_of(const Message& kind) {
  std::unique_ptr<Message> defaults(kind.New());
  Tree nothing;
  nothing.kind = Tree::Kind::map;
  Problems ignored;
  read_message(nothing, "", *defaults, ignored);
  return defaults;
}

}  // namespace grainstep::declare
