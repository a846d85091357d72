/// @file What decides the bits of a computation, in one string of bytes: written and read back by one function of each
/// class, so that nothing can be forgotten on one of the two ways:
///
///     template <class Archive>
///     void serialize(Archive& archive) {
///       archive("positions", positions_);
///       archive("time", time_);
///     }
///
/// Takes what can be copied as bytes, containers of anything that it takes, optionals, Protobuf messages, and classes
/// with a serialize() of their own. Bytes are those of this build on this machine, for nobody else; whoever keeps them
/// adds a checksum, and says which build they are of.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace grainstep::base {

template <typename T, typename Archive>
concept Serializable = requires(T& value, Archive& archive) {
  value.serialize(archive);
};

template <typename T>
concept Message = requires(T& value, std::string text) {
  value.AppendToString(&text);
  { value.ParseFromArray(text.data(), 0) } -> std::same_as<bool>;
};

template <typename T>
concept Growing = requires(T& value) {
  value.resize(value.size());
  value.data();
};

/// Bytes are all that there is to say of it.
template <typename T>
inline constexpr bool plain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

class Saving {
 public:
  static constexpr bool loads = false;

  template <typename T>
  void operator()(std::string_view name, T& value) {
    count(name.size());
    bytes(name.data(), name.size());
    put(value);
  }

  /// Of containers whose sizes follow from the model: they must be the same when they are read back.
  template <typename T>
  void fixed(std::string_view name, T& value) {
    (*this)(name, value);
  }

  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  void bytes(const void* from, std::size_t size);
  void count(std::uint64_t number) { bytes(&number, sizeof number); }

  template <typename T>
  void put(T& value) {
    if constexpr (Serializable<T, Saving>) {
      value.serialize(*this);
    } else if constexpr (Message<T>) {
      std::string text;
      value.AppendToString(&text);
      put(text);
    } else if constexpr (Growing<T>) {
      count(value.size());
      put_all(value);
    } else if constexpr (plain<T>) {
      bytes(&value, sizeof value);
    } else if constexpr (requires { value.has_value(); }) {
      count(value.has_value() ? 1 : 0);
      if (value) put(*value);
    } else {
      put_all(value);
    }
  }

  template <typename Container>
  void put_all(Container& all) {
    if constexpr (plain<typename Container::value_type> && Growing<Container>) {
      bytes(all.data(), all.size() * sizeof *all.data());
    } else {
      for (auto& one : all) put(one);
    }
  }

  std::string bytes_;
};

/// Throws std::range_error, which names the part, where the bytes are not what the same classes have written.
class Loading {
 public:
  static constexpr bool loads = true;

  /// The bytes must stay where they are.
  explicit Loading(std::string_view from) : left_(from) {}

  template <typename T>
  void operator()(std::string_view name, T& value) {
    part_ = name;
    if (next(count()) != name) refuse("is not where it is expected");
    get(value);
  }

  template <typename T>
  void fixed(std::string_view name, T& value) {
    fixed_ = true;
    (*this)(name, value);
    fixed_ = false;
  }

  /// Everything has been read.
  void end() const;

 private:
  [[noreturn]] void refuse(const char* why) const;
  std::string_view next(std::size_t size);
  std::uint64_t count();

  template <typename T>
  void get(T& value) {
    if constexpr (Serializable<T, Loading>) {
      value.serialize(*this);
    } else if constexpr (Message<T>) {
      const std::string_view text = next(count());
      if (!value.ParseFromArray(text.data(), static_cast<int>(text.size()))) refuse("is no message of its kind");
    } else if constexpr (Growing<T>) {
      const std::uint64_t size = count();
      if (fixed_ && size != value.size()) refuse("has another size: it is of another model");
      if (size > left_.size()) refuse("is cut off");  // every element has a byte at least
      value.resize(size);
      get_all(value);
    } else if constexpr (plain<T>) {
      std::memcpy(static_cast<void*>(&value), next(sizeof value).data(), sizeof value);
    } else if constexpr (requires { value.has_value(); }) {
      if (count() == 0) return value.reset();
      get(value.emplace());
    } else {
      get_all(value);
    }
  }

  template <typename Container>
  void get_all(Container& all) {
    if constexpr (plain<typename Container::value_type> && Growing<Container>) {
      const std::size_t element = sizeof *all.data();
      if (all.size() > left_.size() / element) refuse("is cut off");
      if (all.size() == 0) return;  // memcpy is not defined for the null pointers of the empty
      std::memcpy(static_cast<void*>(all.data()), next(all.size() * element).data(), all.size() * element);
    } else {
      for (auto& one : all) get(one);
    }
  }

  std::string_view left_;
  std::string_view part_;
  bool fixed_ = false;
};

template <typename T>
[[nodiscard]] std::string saved(T& value) {
  Saving archive;
  value.serialize(archive);
  return archive.take();
}

/// std::range_error as Loading, also where something is left over.
template <typename T>
void restore(T& value, std::string_view from) {
  Loading archive(from);
  value.serialize(archive);
  archive.end();
}

}  // namespace grainstep::base
