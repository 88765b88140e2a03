#include "hearing.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace {

// As far away as sensors report a person.
constexpr double metres_at_most = 1e5;

bool is_place(double x, double y) { return std::fabs(x) <= metres_at_most && std::fabs(y) <= metres_at_most; }

crossguard::Task task(const crossguard_msgs_msg_dds__Task_ &of) {
  if (of.type >= CROSSGUARD_TASKS)
    throw Refusal{"task " + std::to_string(of.type) + ": 0 to " + std::to_string(CROSSGUARD_TASKS - 1) +
                  " are possible"};
  return static_cast<crossguard::Task>(of.type);
}

// Like "segment 276:12" or "intersection 4711".
crossguard::MapPlace map_place(const std::string &text) {
  const Refusal bad{"map_place is '" + text + "': like 'segment 276:12' or 'intersection 4711' is wanted"};
  std::istringstream words{text};
  std::string kind, number, rest;
  if (!(words >> kind >> number) || words >> rest || (kind != "segment" && kind != "intersection")) throw bad;
  const auto part = [&](const std::string &digits) {
    char *end = nullptr;
    const unsigned long value = std::strtoul(digits.c_str(), &end, 10);
    if (digits.empty() || digits[0] < '0' || digits[0] > '9' || *end != '\0' || value > UINT16_MAX) throw bad;
    return static_cast<std::uint16_t>(value);
  };
  crossguard::MapPlace place;
  place.is_intersection = kind == "intersection";
  const auto colon = number.find(':');
  if (colon != std::string::npos) place.region = part(number.substr(0, colon));
  place.id = part(colon == std::string::npos ? number : number.substr(colon + 1));
  return place;
}

crossguard::TaskParameters parameters(const ros::Command &command, const Site &site) {
  crossguard::TaskParameters how;
  const double speed = command.maximum_speed;
  if (command.has_target) {
    if (!is_place(command.target.x, command.target.y))
      throw Refusal{"target is no place: metres on the site are wanted, 100 km at most"};
    how.place_deg = site.coordinates(command.target.x, command.target.y);
  }
  if (!std::isfinite(speed) || speed < 0)
    throw Refusal{"maximum_speed is none: m/s, or 0 for the follower's own limit, are wanted"};
  if (speed > 0) how.maximum_speed_mps = speed;
  if (command.map_place && *command.map_place) how.map_place = map_place(command.map_place);
  return how;
}

crossguard::Event request(const ros::Command &command) {
  using crossguard::Task;
  std::uint16_t tasks = 0;
  for (std::uint32_t nth = 0; nth < command.tasks._length; ++nth)
    tasks = static_cast<std::uint16_t>(tasks | crossguard::tasks(task(command.tasks._buffer[nth])));
  if (tasks == 0) tasks = crossguard::tasks(Task::initial_pos, Task::move);
  if (command.urgency > CROSSGUARD_URGENCY_EMERGENCY)
    throw Refusal{"urgency " + std::to_string(command.urgency) + ": 0 to 3 are possible"};
  if (command.followers < 1 || command.followers > CROSSGUARD_FOLLOWERS_MAX)
    throw Refusal{std::to_string(command.followers) + " followers: 1 to " +
                  std::to_string(CROSSGUARD_FOLLOWERS_MAX) + " are possible"};
  const auto urgency = static_cast<crossguard::Urgency>(command.urgency);
  return crossguard::Event::pedestrian_detected(command.followers, tasks, urgency, command.place);
}

} // namespace

std::optional<crossguard::Event> event(const ros::Command &command, const Site &site) {
  using crossguard::Event;
  // The task of a maneuver's end is not looked at.
  const crossguard::Maneuver maneuver{session(command.session), command.request, crossguard::Task::move};
  switch (command.kind) {
  case crossguard_msgs_msg_dds__Command_Constants_DETECT: return request(command);
  case crossguard_msgs_msg_dds__Command_Constants_ORDER:
    return Event::command(command.follower, task(command.task), parameters(command, site));
  case crossguard_msgs_msg_dds__Command_Constants_DONE: return Event::completed(maneuver);
  case crossguard_msgs_msg_dds__Command_Constants_FAIL: return Event::failed(maneuver);
  case crossguard_msgs_msg_dds__Command_Constants_IN_POSITION: return Event::in_position(maneuver);
  case crossguard_msgs_msg_dds__Command_Constants_OPEN_CORRIDOR: return Event::open_corridor();
  case crossguard_msgs_msg_dds__Command_Constants_CLOSE_CORRIDOR: return Event::close_corridor();
  case crossguard_msgs_msg_dds__Command_Constants_TASK_COMPLETED: return Event::task_completed();
  case crossguard_msgs_msg_dds__Command_Constants_ROAD_CLEAR: return Event::road_clear();
  case crossguard_msgs_msg_dds__Command_Constants_LEAVE: return Event::leave();
  case crossguard_msgs_msg_dds__Command_Constants_SET_AVAILABILITY:
    if (command.availability > CROSSGUARD_UNAVAILABILITY_NOT_SAFE)
      throw Refusal{"availability " + std::to_string(command.availability) + ": 0 to 5 are possible"};
    return Event::available(static_cast<crossguard::Unavailability>(command.availability));
  case crossguard_msgs_msg_dds__Command_Constants_SHOW:
  case crossguard_msgs_msg_dds__Command_Constants_JOB:
  case crossguard_msgs_msg_dds__Command_Constants_SERVE: return std::nullopt;
  default: throw Refusal{"kind " + std::to_string(command.kind) + " is no command"};
  }
}

namespace {

void show(const ros::Command &command, crossguard::Body &body) {
  for (const std::uint8_t signal : {command.to_vehicles, command.to_pedestrians})
    if (signal > crossguard_msgs_msg_dds__Command_Constants_SIGNAL_CAUTION)
      throw Refusal{"signal " + std::to_string(signal) + ": 0 to 3 are possible"};
  if (command.to_pedestrians == crossguard_msgs_msg_dds__Command_Constants_SIGNAL_GO)
    throw Refusal{"go is not shown to pedestrians by command; OPEN_CORRIDOR opens the corridor"};
  if (command.signal_means > 15)
    throw Refusal{"signal_means " + std::to_string(command.signal_means) + ": a sum of 1, 2, 4 and 8 is wanted"};
  if (command.signal_means != 0) body.signal_means = command.signal_means;
  body.to_vehicles = command.to_vehicles;
  body.to_pedestrians = command.to_pedestrians;
}

void serve(const ros::Command &command, crossguard::Body &body) {
  const bool is_named = command.map_place && *command.map_place;
  crossguard::MapPlace::write(is_named ? std::optional{map_place(command.map_place)} : std::nullopt, body);
}

} // namespace

void describe(const ros::Command &command, crossguard::Body &body) {
  switch (command.kind) {
  case crossguard_msgs_msg_dds__Command_Constants_SERVE: return serve(command, body);
  case crossguard_msgs_msg_dds__Command_Constants_JOB:
    if (command.job_role > crossguard_msgs_msg_dds__Command_Constants_ROLE_OTHER)
      throw Refusal{"job_role " + std::to_string(command.job_role) + ": 0 to 6 are possible"};
    body.job_role = command.job_role;
    return;
  default: return show(command, body);
  }
}

void place(const ros::PoseStamped &pose, const Site &site, crossguard::Body &body) {
  const char *frame = pose.header.frame_id;
  if (frame && *frame && std::strcmp(frame, "site") != 0)
    throw Refusal{"a pose in the frame '" + std::string{frame} + "': 'site' is wanted"};
  const auto &[x, y, z, w] = pose.pose.orientation;
  const double sine = 2 * (w * z + x * y), cosine = w * w + x * x - y * y - z * z;
  const double norm = std::hypot(sine, cosine);
  if (!(norm > 0) || !std::isfinite(norm)) throw Refusal{"the orientation of the pose is no quaternion"};
  if (!is_place(pose.pose.position.x, pose.pose.position.y)) throw Refusal{"the pose is no place on the site"};
  std::tie(body.latitude_deg, body.longitude_deg) = site.coordinates(pose.pose.position.x, pose.pose.position.y);
  const double heading = 90 - std::atan2(sine, cosine) * 180 / std::acos(-1.0);
  body.heading_deg = heading < 0 ? heading + 360 : heading;
}
