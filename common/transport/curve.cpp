#include "transport/curve.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zmq.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/error.hpp"

namespace grainstep::transport {
namespace {

namespace fs = std::filesystem;

using KeyText = std::array<char, key_text_size + 1>;

fs::path secret_file(const fs::path& directory, const char* owner) { return directory / (std::string(owner) + ".key"); }
fs::path public_file(const fs::path& directory, const char* owner) { return directory / (std::string(owner) + ".pub"); }

/// Created with its final permissions, so that no moment exists in which others could read it.
void write_new(const fs::path& file, const char* text, mode_t mode) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (descriptor < 0) {
    throw InputError(file.string() + ": cannot be made: " + std::strerror(errno) +
                     (errno == EEXIST ? "; remove the old keys first if no run uses them" : ""));
  }
  const std::string line = std::string(text) + "\n";
  const bool written = ::write(descriptor, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  const bool closed = ::close(descriptor) == 0;
  if (!written || !closed) {
    throw InputError(file.string() + ": cannot be written: " + std::strerror(errno));
  }
}

void make_pair(const fs::path& directory, const char* owner) {
  KeyText public_key{};
  KeyText secret_key{};
  if (::zmq_curve_keypair(public_key.data(), secret_key.data()) != 0) {
    throw InputError(std::string("this libzmq cannot make CURVE keys: ") + ::zmq_strerror(errno));
  }
  write_new(secret_file(directory, owner), secret_key.data(), 0600);
  write_new(public_file(directory, owner), public_key.data(), 0644);
}

std::string read_key(const fs::path& file) {
  std::ifstream in(file);
  std::string text;
  if (!(in >> text)) {
    throw InputError(file.string() + ": cannot be read; `grainstep-keys DIR` makes keys");
  }
  std::array<std::uint8_t, 32> bytes{};
  if (text.size() != key_text_size || ::zmq_z85_decode(bytes.data(), text.c_str()) == nullptr) {
    throw InputError(file.string() + ": is not a CURVE key of " + std::to_string(key_text_size) + " Z85 characters");
  }
  return text;
}

std::string read_secret(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) == 0 && (status.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    throw InputError(file.string() + ": others than its owner may read this secret key; run `chmod 600` on it");
  }
  return read_key(file);
}

}  // namespace

void make_keys(const fs::path& directory) {
  std::error_code error;
  if (fs::create_directories(directory, error)) {
    fs::permissions(directory, fs::perms::owner_all);
  }
  make_pair(directory, "orchestrator");
  make_pair(directory, "participant");
}

CurveKeys load_keys(const fs::path& directory, Side side) {
  const bool orchestrator = side == Side::orchestrator;
  CurveKeys keys;
  keys.own_secret = read_secret(secret_file(directory, orchestrator ? "orchestrator" : "participant"));
  KeyText derived{};
  if (::zmq_curve_public(derived.data(), keys.own_secret.c_str()) != 0) {
    throw InputError(directory.string() + ": its secret key has no public key: " + ::zmq_strerror(errno));
  }
  keys.own_public = derived.data();
  keys.peer_public = side == Side::among_participants
                         ? keys.own_public
                         : read_key(public_file(directory, orchestrator ? "participant" : "orchestrator"));
  return keys;
}

std::array<std::uint8_t, 32> key_bytes(const std::string& text) {
  std::array<std::uint8_t, 32> bytes{};
  ::zmq_z85_decode(bytes.data(), text.c_str());
  return bytes;
}

}  // namespace grainstep::transport
