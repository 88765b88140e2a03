// What the node tells: from what the robot puts out to messages.
#ifndef CROSSGUARD_DDS_TELLING_HPP
#define CROSSGUARD_DDS_TELLING_HPP

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crossguard.hpp"
#include "dds.hpp"

// Where places are metres from: x to the east, y to the north.
struct Site {
  double latitude = 0, longitude = 0;

  std::pair<double, double> coordinates(double x, double y) const;
  std::pair<double, double> place(double latitude, double longitude) const;
};

// An event, with the texts that its message points to.
struct Happening {
  ros::Event plain{};
  std::string text, map_place;

  explicit Happening(std::uint8_t kind);
  Happening(std::uint8_t kind, const crossguard::Session &session);
};

Happening happening(const crossguard::StartManeuver &start, const Site &site);
Happening happening(const crossguard::StopManeuver &stop);
Happening happening(const crossguard::FallBack &fallback);
Happening happening(const crossguard::Notice &notice);
// A command that had no effect, or that means nothing.
Happening ignored(const crossguard::Why &why);
Happening refused(const std::string &why);

ros::Session session(const crossguard::Session &session);
// The session that a message names.
crossguard::Session session(const ros::Session &session);
// A header of this moment. The frame belongs to somebody else.
ros::Header header(const char *frame);
// A reason, by its number in crossguard.h.
std::string words(const crossguard::Why &why);

// What the team of this robot lets a pedestrian do, as the robot put it out.
struct Go {
  std::optional<std::chrono::milliseconds> left; // while the corridor is open
  std::optional<crossguard::Why> closed;         // why it was closed last, in this session
};

// A message of the corridor or of the state, with what it points to.
struct CorridorTold {
  ros::Corridor plain{};
  std::string text;

  CorridorTold(const crossguard::View &view, const Go &go);
  // That there is no robot any more.
  static CorridorTold inactive(std::uint32_t station);

private:
  CorridorTold() = default;
};

struct StatusTold {
  ros::Status plain{};
  std::vector<ros::Follower> followers;

  // `name` belongs to somebody else.
  StatusTold(const crossguard::View &view, const std::string &name);
};

// How often what was dropped, by its cause; and what is new since this was told last.
struct DiagnosticTold {
  ros::DiagnosticArray plain{};
  ros::DiagnosticStatus status{};
  std::vector<std::string> numbers;
  std::vector<ros::KeyValue> values;
  std::string name, message;

  DiagnosticTold(const std::map<std::string, std::uint64_t> &counters, std::uint64_t news, std::string node,
                 const std::string &robot);
};

#endif // CROSSGUARD_DDS_TELLING_HPP
