#include "link.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

std::optional<sockaddr_in> endpoint(const std::string &text) {
  const auto colon = text.rfind(':');
  if (colon == std::string::npos) return std::nullopt;
  const std::string host = text.substr(0, colon), port = text.substr(colon + 1);
  char *end = nullptr;
  const long number = std::strtol(port.c_str(), &end, 10);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  if (port.empty() || *end != '\0' || number < 1 || number > 65535 ||
      inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1)
    return std::nullopt;
  address.sin_port = htons(static_cast<std::uint16_t>(number));
  return address;
}

Link::Link(const sockaddr_in &own, std::vector<sockaddr_in> peers)
    : socket_{::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)}, peers_{std::move(peers)} {
  is_open_ = socket_ >= 0 && bind(socket_, reinterpret_cast<const sockaddr *>(&own), sizeof own) == 0;
}

Link::~Link() {
  if (socket_ >= 0) close(socket_);
}

void Link::send(crossguard::Octets packet) const {
  for (const sockaddr_in &peer : peers_)
    (void)::sendto(socket_, packet.data, packet.size, 0, reinterpret_cast<const sockaddr *>(&peer),
                   sizeof peer);
}

std::optional<crossguard::Octets> Link::receive() {
  const auto called = Clock::now();
  const ssize_t length = recv(socket_, packet_.data(), packet_.size(), 0);
  if (length >= 0) return crossguard::Octets{packet_.data(), static_cast<std::size_t>(length)};
  // An error of an earlier datagram (a peer that is not there) says nothing about what waits.
  if (errno == EAGAIN || errno == EWOULDBLOCK) empty_ = called;
  return std::nullopt;
}

std::chrono::milliseconds Link::waited() const {
  return std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - empty_);
}
