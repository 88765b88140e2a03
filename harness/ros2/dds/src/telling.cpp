#include "telling.hpp"

#include <algorithm>
#include <cmath>

using std::chrono::duration_cast;
using std::chrono::milliseconds;

namespace {

// As the sites of `crossguard run`.
constexpr double metres_per_degree = 111195.0;
// For how long a corridor is told at most, whatever the leases say.
constexpr milliseconds valid_at_most{300};

double shrink(double latitude) { return std::cos(latitude * std::acos(-1.0) / 180.0); }

// Messages take strings by pointers that they do not write to.
char *borrowed(const std::string &text) { return const_cast<char *>(text.c_str()); }

std::uint8_t code(const crossguard::Notice &notice) {
  switch (notice.kind) {
  case CROSSGUARD_NOTICE_ROLES_ESTABLISHED: return crossguard_msgs_msg_dds__Event_Constants_ROLES_ESTABLISHED;
  case CROSSGUARD_NOTICE_FOLLOWER_JOINED: return crossguard_msgs_msg_dds__Event_Constants_FOLLOWER_JOINED;
  case CROSSGUARD_NOTICE_FOLLOWER_GONE: return crossguard_msgs_msg_dds__Event_Constants_FOLLOWER_GONE;
  case CROSSGUARD_NOTICE_LEASE_GRANTED: return crossguard_msgs_msg_dds__Event_Constants_LEASE_GRANTED;
  case CROSSGUARD_NOTICE_LEASE_EXPIRED: return crossguard_msgs_msg_dds__Event_Constants_LEASE_EXPIRED;
  case CROSSGUARD_NOTICE_COMMAND_ACKNOWLEDGED: return crossguard_msgs_msg_dds__Event_Constants_COMMAND_ACKNOWLEDGED;
  case CROSSGUARD_NOTICE_COMMAND_REJECTED: return crossguard_msgs_msg_dds__Event_Constants_COMMAND_REJECTED;
  case CROSSGUARD_NOTICE_MANEUVER_REPORTED: return crossguard_msgs_msg_dds__Event_Constants_MANEUVER_REPORTED;
  case CROSSGUARD_NOTICE_MANEUVER_IN_POSITION: return crossguard_msgs_msg_dds__Event_Constants_MANEUVER_IN_POSITION;
  case CROSSGUARD_NOTICE_MANEUVER_COMPLETED: return crossguard_msgs_msg_dds__Event_Constants_MANEUVER_COMPLETED;
  case CROSSGUARD_NOTICE_MANEUVER_FAILED: return crossguard_msgs_msg_dds__Event_Constants_MANEUVER_FAILED;
  case CROSSGUARD_NOTICE_FOLLOWER_SAFE_IDLE: return crossguard_msgs_msg_dds__Event_Constants_FOLLOWER_SAFE_IDLE;
  case CROSSGUARD_NOTICE_OFFER_LAPSED: return crossguard_msgs_msg_dds__Event_Constants_OFFER_LAPSED;
  case CROSSGUARD_NOTICE_YIELDED: return crossguard_msgs_msg_dds__Event_Constants_YIELDED;
  case CROSSGUARD_NOTICE_SESSION_ENDED: return crossguard_msgs_msg_dds__Event_Constants_SESSION_ENDED;
  case CROSSGUARD_NOTICE_OFFERING: return crossguard_msgs_msg_dds__Event_Constants_OFFERING;
  case CROSSGUARD_NOTICE_JOINED: return crossguard_msgs_msg_dds__Event_Constants_JOINED;
  case CROSSGUARD_NOTICE_RELEASED: return crossguard_msgs_msg_dds__Event_Constants_RELEASED;
  case CROSSGUARD_NOTICE_CONTACT_LOST: return crossguard_msgs_msg_dds__Event_Constants_CONTACT_LOST;
  case CROSSGUARD_NOTICE_CONTACT_REGAINED: return crossguard_msgs_msg_dds__Event_Constants_CONTACT_REGAINED;
  case CROSSGUARD_NOTICE_NONE: break;
  }
  return 0;
}

std::uint8_t code(crossguard::Fallback policy) {
  switch (policy) {
  case CROSSGUARD_FALLBACK_STOP_IN_PLACE: return crossguard_msgs_msg_dds__Event_Constants_POLICY_STOP_IN_PLACE;
  case CROSSGUARD_FALLBACK_GO_TO_SAFE_POSITION:
    return crossguard_msgs_msg_dds__Event_Constants_POLICY_GO_TO_SAFE_POSITION;
  case CROSSGUARD_FALLBACK_ESCORT_TO_KERB: return crossguard_msgs_msg_dds__Event_Constants_POLICY_ESCORT_TO_KERB;
  case CROSSGUARD_FALLBACK_HOLD_UNTIL_CLEAR: return crossguard_msgs_msg_dds__Event_Constants_POLICY_HOLD_UNTIL_CLEAR;
  }
  return crossguard_msgs_msg_dds__Event_Constants_POLICY_NONE;
}

std::uint8_t progress(std::uint8_t of) {
  switch (of) {
  case CROSSGUARD_PROGRESS_EXECUTING: return crossguard_msgs_msg_dds__Follower_Constants_PROGRESS_EXECUTING;
  case CROSSGUARD_PROGRESS_IN_POSITION: return crossguard_msgs_msg_dds__Follower_Constants_PROGRESS_IN_POSITION;
  case CROSSGUARD_PROGRESS_COMPLETED: return crossguard_msgs_msg_dds__Follower_Constants_PROGRESS_COMPLETED;
  case CROSSGUARD_PROGRESS_FAILED: return crossguard_msgs_msg_dds__Follower_Constants_PROGRESS_FAILED;
  case CROSSGUARD_PROGRESS_SAFE_IDLE: return crossguard_msgs_msg_dds__Follower_Constants_PROGRESS_SAFE_IDLE;
  default: return crossguard_msgs_msg_dds__Follower_Constants_PROGRESS_NONE;
  }
}

std::uint8_t code(const crossguard::Why &closed) {
  switch (closed.reason) {
  case CROSSGUARD_REASON_FOLLOWER_MISSING: return crossguard_msgs_msg_dds__Corridor_Constants_REASON_FOLLOWER_MISSING;
  case CROSSGUARD_REASON_SESSION_ENDED: return crossguard_msgs_msg_dds__Corridor_Constants_REASON_SESSION_ENDED;
  case CROSSGUARD_REASON_APPLICATION: return crossguard_msgs_msg_dds__Corridor_Constants_REASON_APPLICATION;
  case CROSSGUARD_REASON_YIELDED: return crossguard_msgs_msg_dds__Corridor_Constants_REASON_YIELDED;
  // All others are about a follower that is not engaged.
  default: return crossguard_msgs_msg_dds__Corridor_Constants_REASON_NOT_ENGAGED;
  }
}

Happening about(std::uint8_t kind, const crossguard::Maneuver &maneuver) {
  Happening it{kind, maneuver.session};
  it.plain.station = maneuver.session.leader;
  it.plain.request = maneuver.request;
  it.plain.task.type = static_cast<std::uint8_t>(maneuver.task);
  return it;
}

} // namespace

std::pair<double, double> Site::coordinates(double x, double y) const {
  return {latitude + y / metres_per_degree, longitude + x / (metres_per_degree * shrink(latitude))};
}

std::pair<double, double> Site::place(double at_latitude, double at_longitude) const {
  return {(at_longitude - longitude) * metres_per_degree * shrink(latitude),
          (at_latitude - latitude) * metres_per_degree};
}

ros::Session session(const crossguard::Session &of) {
  return {of.leader, static_cast<std::uint16_t>(of.number >> 16), static_cast<std::uint16_t>(of.number & 0xffff)};
}

crossguard::Session session(const ros::Session &of) {
  return {of.leader, static_cast<std::uint32_t>(of.boot) << 16 | of.count};
}

ros::Header header(const char *frame) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto seconds = duration_cast<std::chrono::seconds>(now);
  ros::Header header{};
  header.stamp.sec = static_cast<std::int32_t>(seconds.count());
  header.stamp.nanosec =
      static_cast<std::uint32_t>(duration_cast<std::chrono::nanoseconds>(now - seconds).count());
  header.frame_id = const_cast<char *>(frame);
  return header;
}

std::string words(const crossguard::Why &why) {
  std::string text = "reason " + std::to_string(why.reason) + " (CrossguardReason in crossguard.h)";
  if (why.reason == CROSSGUARD_REASON_UNAVAILABLE) text += ", unavailable for " + std::to_string(why.unavailability);
  if (why.station != 0) text += ", station " + std::to_string(why.station);
  return text;
}

Happening::Happening(std::uint8_t kind) {
  plain.kind = kind;
  plain.task.type = crossguard_msgs_msg_dds__Task_Constants_NONE;
}

Happening::Happening(std::uint8_t kind, const crossguard::Session &of) : Happening{kind} {
  plain.in_session = true;
  plain.session = session(of);
}

Happening happening(const crossguard::StartManeuver &start, const Site &site) {
  Happening it = about(crossguard_msgs_msg_dds__Event_Constants_START_MANEUVER, start.maneuver);
  const crossguard::TaskParameters &how = start.parameters;
  it.text = "start";
  // An offset is from the leader's place, which is not known here.
  if (how.place_deg && !how.is_offset) {
    const auto [x, y] = site.place(how.place_deg->first, how.place_deg->second);
    it.plain.has_target = true;
    it.plain.target = {x, y, 0};
  }
  it.plain.maximum_speed = how.maximum_speed_mps.value_or(0);
  if (how.map_place) {
    it.map_place = how.map_place->is_intersection ? "intersection " : "segment ";
    if (how.map_place->region) it.map_place += std::to_string(*how.map_place->region) + ":";
    it.map_place += std::to_string(how.map_place->id);
  }
  return it;
}

Happening happening(const crossguard::StopManeuver &stop) {
  Happening it = about(crossguard_msgs_msg_dds__Event_Constants_STOP_MANEUVER, stop.maneuver);
  it.text = "stop: " + words(stop.why);
  return it;
}

Happening happening(const crossguard::FallBack &fallback) {
  Happening it = about(crossguard_msgs_msg_dds__Event_Constants_FALL_BACK, fallback.maneuver);
  it.plain.policy = code(fallback.policy);
  it.text = "fall back";
  return it;
}

Happening happening(const crossguard::Notice &notice) {
  Happening it{code(notice)};
  it.plain.in_session = notice.session.leader != 0 || notice.session.number != 0;
  it.plain.session = session(notice.session);
  it.plain.station = notice.station;
  it.plain.request = notice.request;
  if (notice.why.reason != CROSSGUARD_REASON_NONE) it.text = words(notice.why);
  return it;
}

Happening ignored(const crossguard::Why &why) {
  Happening it{crossguard_msgs_msg_dds__Event_Constants_COMMAND_IGNORED};
  it.plain.station = why.station;
  it.text = words(why);
  return it;
}

Happening refused(const std::string &why) {
  Happening it{crossguard_msgs_msg_dds__Event_Constants_COMMAND_REFUSED};
  it.text = why;
  return it;
}

CorridorTold::CorridorTold(const crossguard::View &view, const Go &go) {
  const bool leads = view.role == CROSSGUARD_ROLE_LEADER;
  const auto left = std::min(go.left.value_or(milliseconds{0}), valid_at_most);
  plain.station = view.station;
  plain.open = leads && view.corridor == CROSSGUARD_CORRIDOR_OPEN && left > milliseconds{0};
  const auto valid = plain.open ? left : valid_at_most;
  plain.valid_for.nanosec = static_cast<std::uint32_t>(std::chrono::nanoseconds{valid}.count());
  plain.road_occupied = (leads && view.corridor != CROSSGUARD_CORRIDOR_CLEAR) || view.duty == CROSSGUARD_DUTY_CROSSING;
  plain.in_session = leads;
  if (leads) plain.session = session(view.session);
  if (plain.open) return;
  if (leads && view.corridor == CROSSGUARD_CORRIDOR_OPEN) {
    plain.reason = crossguard_msgs_msg_dds__Corridor_Constants_REASON_STALE;
    text = "the leases have ended";
  } else if (go.closed) {
    plain.reason = code(*go.closed);
    if (plain.reason == crossguard_msgs_msg_dds__Corridor_Constants_REASON_NOT_ENGAGED)
      plain.follower = go.closed->station;
    if (plain.reason == crossguard_msgs_msg_dds__Corridor_Constants_REASON_YIELDED) plain.leader = go.closed->station;
    text = words(*go.closed);
  } else {
    plain.reason = leads ? crossguard_msgs_msg_dds__Corridor_Constants_REASON_NOT_OPENED
                         : crossguard_msgs_msg_dds__Corridor_Constants_REASON_NOT_LEADING;
    text = leads ? "not opened in this session yet" : "the robot leads no session";
  }
}

CorridorTold CorridorTold::inactive(std::uint32_t station) {
  CorridorTold it;
  it.plain.station = station;
  it.plain.reason = crossguard_msgs_msg_dds__Corridor_Constants_REASON_INACTIVE;
  it.plain.valid_for.nanosec = static_cast<std::uint32_t>(std::chrono::nanoseconds{valid_at_most}.count());
  it.text = "the node ends";
  return it;
}

StatusTold::StatusTold(const crossguard::View &view, const std::string &name) {
  plain.robot = borrowed(name);
  plain.station = view.station;
  plain.boot = view.boot;
  plain.state = static_cast<std::uint8_t>(view.state + crossguard_msgs_msg_dds__Status_Constants_STATE_IDLE);
  plain.role = view.role;
  plain.availability = view.unavailability;
  plain.in_session = view.has_session != 0;
  if (plain.in_session) plain.session = session(view.session);
  plain.executes.type = view.role == CROSSGUARD_ROLE_FOLLOWER && view.state == CROSSGUARD_STATE_MANEUVER_EXECUTING
                            ? view.task
                            : static_cast<std::uint8_t>(crossguard_msgs_msg_dds__Task_Constants_NONE);
  plain.corridor = view.corridor;
  plain.has_yielded = view.has_yielded != 0;
  plain.yields_to = view.has_yielded ? view.yields_to : 0;
  plain.duty = view.duty;
  if (view.duty != CROSSGUARD_DUTY_NONE) plain.duty_session = session(view.duty_session);
  if (view.duty == CROSSGUARD_DUTY_FALLING_BACK) plain.duty_request = view.duty_request;
  for (std::uint32_t nth = 0; nth < view.followers_length; ++nth) {
    const CrossguardFollower &of = view.followers[nth];
    ros::Follower follower{};
    follower.station = of.station;
    follower.has_joined = of.has_joined != 0;
    const bool has_task = of.progress != CROSSGUARD_PROGRESS_NONE || of.is_outstanding;
    follower.task.type =
        has_task ? of.task : static_cast<std::uint8_t>(crossguard_msgs_msg_dds__Task_Constants_NONE);
    follower.progress = progress(of.progress);
    follower.has_lease = of.has_lease != 0;
    followers.push_back(follower);
  }
  plain.followers._buffer = followers.data();
  plain.followers._length = plain.followers._maximum = static_cast<std::uint32_t>(followers.size());
}

DiagnosticTold::DiagnosticTold(const std::map<std::string, std::uint64_t> &counters, std::uint64_t news,
                               std::string node, const std::string &robot)
    : name{std::move(node)} {
  message = news == 0 ? "nothing dropped" : std::to_string(news) + " dropped since the last report";
  for (const auto &[cause, count] : counters) numbers.push_back(std::to_string(count));
  std::size_t nth = 0;
  for (const auto &[cause, count] : counters) values.push_back({borrowed(cause), borrowed(numbers[nth++])});
  status.level = news == 0 ? 0 : 1; // OK, WARN
  status.name = borrowed(name);
  status.message = borrowed(message);
  status.hardware_id = borrowed(robot);
  status.values._buffer = values.data();
  status.values._length = status.values._maximum = static_cast<std::uint32_t>(values.size());
  plain.status._buffer = &status;
  plain.status._length = plain.status._maximum = 1;
}
