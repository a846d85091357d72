#include "transport/zap.hpp"

#include <cstring>
#include <vector>
#include <zmq_addon.hpp>

namespace grainstep::transport {
namespace {

// Frames of a request: version, request id, domain, address, identity, mechanism, credentials.
constexpr std::size_t request_id = 1;
constexpr std::size_t mechanism_frame = 5;
constexpr std::size_t credentials_frame = 6;

}  // namespace

ZapHandler::ZapHandler(zmq::context_t& context, const std::optional<CurveKeys>& keys)
    : socket_(context, zmq::socket_type::rep) {
  socket_.set(zmq::sockopt::linger, 0);
  socket_.bind("inproc://zeromq.zap.01");
  if (keys) {
    peer_key_ = key_bytes(keys->peer_public);
  }
}

bool ZapHandler::admits(const zmq::message_t& mechanism, const zmq::message_t* key) const {
  if (!peer_key_) {
    return mechanism.to_string_view() == "NULL";
  }
  return mechanism.to_string_view() == "CURVE" && key != nullptr && key->size() == peer_key_->size() &&
         std::memcmp(key->data(), peer_key_->data(), peer_key_->size()) == 0;
}

void ZapHandler::answer(bool taken) {
  std::vector<zmq::message_t> request;
  while (zmq::recv_multipart(socket_, std::back_inserter(request), zmq::recv_flags::dontwait)) {
    const bool complete = request.size() > mechanism_frame;
    const zmq::message_t* key = request.size() > credentials_frame ? &request[credentials_frame] : nullptr;
    const bool welcome = complete && !taken && admits(request[mechanism_frame], key);
    const auto id = complete ? request[request_id].to_string() : std::string();
    const std::array<zmq::const_buffer, 6> reply = {
        zmq::buffer(std::string_view("1.0")),
        zmq::buffer(id),
        zmq::buffer(std::string_view(welcome ? "200" : "400")),
        zmq::buffer(std::string_view(welcome ? "" : (taken ? "has its peer already" : "unknown key"))),
        zmq::buffer(std::string_view("")),
        zmq::buffer(std::string_view(""))};
    (void)zmq::send_multipart(socket_, reply, zmq::send_flags::dontwait);  // unsent: the handshake times out
    request.clear();
  }
}

}  // namespace grainstep::transport
