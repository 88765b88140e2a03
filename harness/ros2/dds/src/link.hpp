// The V2X link: GeoNetworking packets as UDP datagrams, to the peers that are named.
#ifndef CROSSGUARD_DDS_LINK_HPP
#define CROSSGUARD_DDS_LINK_HPP

#include <netinet/in.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crossguard.hpp"

// An IPv4 address and port, like 127.0.0.1:4001.
std::optional<sockaddr_in> endpoint(const std::string &text);

class Link {
public:
  using Clock = std::chrono::steady_clock;

  // Opens the socket at its own address. `is_open` says whether that was possible, and errno why not.
  Link(const sockaddr_in &own, std::vector<sockaddr_in> peers);
  ~Link();
  Link(const Link &) = delete;
  Link &operator=(const Link &) = delete;

  bool is_open() const { return is_open_; }
  int socket() const { return socket_; }
  // A packet that the link does not take is as lost as one on the air.
  void send(crossguard::Octets packet) const;
  // The next packet that is there.
  std::optional<crossguard::Octets> receive();
  // For how long the packet may have waited at most. Only a link that has nothing when it is asked is empty: this
  // process may have been stopped since.
  std::chrono::milliseconds waited() const;

private:
  int socket_ = -1;
  bool is_open_ = false;
  std::vector<sockaddr_in> peers_;
  Clock::time_point empty_ = Clock::now();
  std::array<std::uint8_t, 2048> packet_{};
};

#endif // CROSSGUARD_DDS_LINK_HPP
