// Parts of a robot, for the loop in the README.
#include <chrono>
#include <cstdint>
#include <optional>
#include <ostream>

#include <crossguard.hpp>

struct Link {
  void send(crossguard::Octets packet);
  std::optional<crossguard::Octets> receive(std::optional<std::chrono::milliseconds> at_most);
};
struct Legs {
  void start(crossguard::Maneuver maneuver, crossguard::TaskParameters parameters);
  void stop();
  void fall_back(crossguard::Fallback policy);
};
struct Board {
  void go_for(std::chrono::milliseconds at_most);
  void stop();
};
struct Gps {
  double latitude() const;
};

extern Link radio;
extern Legs body;
extern Board sign;
extern Gps gps;
extern std::ostream &journal;

std::chrono::milliseconds since_last_time();
std::uint64_t timestamp_its();
std::uint64_t log_us();
