// Crossguard for C++17: a thin layer over crossguard.h with RAII, enumerations, std::optional and
// std::variant. Header only, no exceptions, no allocation but that of one std::array per Turn.
//
//   crossguard::Config config{2, boot, "Go2"};
//   auto robot = crossguard::Robot::start(config);          // std::optional; see also `why`
//   crossguard::Turn turn;
//   robot->elapse(std::chrono::milliseconds{20}, turn);
//   for (const crossguard::Output &output : turn.outputs())
//     std::visit(my_visitor, output.what());
#ifndef CROSSGUARD_HPP
#define CROSSGUARD_HPP

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>

#include "crossguard.h"

namespace crossguard {

using Status = CrossguardStatus;
using State = CrossguardState;
using Role = CrossguardRole;
using Urgency = CrossguardUrgency;
using Unavailability = CrossguardUnavailability;
using Fallback = CrossguardFallback;
using Progress = CrossguardProgress;
using Corridor = CrossguardCorridor;
using Message = CrossguardMessage;
using NoticeKind = CrossguardNotice;
using Reason = CrossguardReason;
using Session = CrossguardSession;
using Body = CrossguardBody;
using View = CrossguardView;
using Heard = CrossguardHeard;

inline bool operator==(const Session &a, const Session &b) noexcept {
  return a.leader == b.leader && a.number == b.number;
}

/// A task type, 0..15.
enum class Task : std::uint8_t {
  // <named tasks>
  initial_pos = CROSSGUARD_TASK_INITIAL_POS,
  move = CROSSGUARD_TASK_MOVE,
  block = CROSSGUARD_TASK_BLOCK,
  // </named tasks>
};

/// A set of task types: bit n stands for task type n.
template <typename... Tasks> constexpr std::uint16_t tasks(Tasks... of) noexcept {
  return static_cast<std::uint16_t>((0u | ... | (1u << static_cast<unsigned>(of))));
}

/// Text of a status, in English.
inline const char *text(Status status) noexcept { return crossguard_status_text(status); }

/// Octets that belong to somebody else.
struct Octets {
  const std::uint8_t *data;
  std::size_t size;
};

/// A road segment or intersection of a map.
struct MapPlace {
  bool is_intersection = false;
  std::optional<std::uint16_t> region; ///< in which the number is unique
  std::uint16_t id = 0;

  /// The place that a struct names: that of a command, or that a robot's RAM says it is there for.
  template <class Plain> static std::optional<MapPlace> from(const Plain &plain) {
    if (plain.map_kind == 0) return std::nullopt;
    MapPlace place;
    place.is_intersection = plain.map_kind == 2;
    if (plain.has_map_region != 0) place.region = plain.map_region;
    place.id = plain.map_id;
    return place;
  }

  /// Has a struct name this place, or none: a Body says by it what the robot is there for.
  template <class Plain> static void write(const std::optional<MapPlace> &place, Plain &plain) {
    plain.map_kind = place ? (place->is_intersection ? 2 : 1) : 0;
    plain.has_map_region = place && place->region ? 1 : 0;
    plain.map_region = place ? place->region.value_or(0) : 0;
    plain.map_id = place ? place->id : 0;
  }
};

/// Where and how a maneuver is to be done; what is not set is left to the follower.
struct TaskParameters {
  std::optional<std::pair<double, double>> place_deg; ///< latitude and longitude
  std::optional<double> altitude_m;
  std::optional<double> heading_deg;
  std::optional<double> maximum_speed_mps;
  std::optional<double> pedestrian_distance_m;
  std::optional<std::chrono::milliseconds> validity;
  std::optional<int> lane;
  bool is_offset = false; ///< place and altitude are relative to the leader's position
  std::optional<MapPlace> map_place; ///< where on the map the maneuver takes place

  static TaskParameters from(const CrossguardTaskParameters &plain) {
    TaskParameters of;
    if (!std::isnan(plain.latitude_deg) && !std::isnan(plain.longitude_deg))
      of.place_deg = {plain.latitude_deg, plain.longitude_deg};
    of.altitude_m = known(plain.altitude_m);
    of.heading_deg = known(plain.heading_deg);
    of.maximum_speed_mps = known(plain.maximum_speed_mps);
    of.pedestrian_distance_m = known(plain.pedestrian_distance_m);
    if (plain.validity_ms != 0) of.validity = std::chrono::milliseconds{plain.validity_ms};
    if (plain.lane != CROSSGUARD_NO_LANE) of.lane = plain.lane;
    of.is_offset = plain.is_offset != 0;
    of.map_place = MapPlace::from(plain);
    return of;
  }

  void write(CrossguardTaskParameters &plain) const {
    const auto nan = std::nan("");
    plain.latitude_deg = place_deg ? place_deg->first : nan;
    plain.longitude_deg = place_deg ? place_deg->second : nan;
    plain.altitude_m = altitude_m.value_or(nan);
    plain.heading_deg = heading_deg.value_or(nan);
    plain.maximum_speed_mps = maximum_speed_mps.value_or(nan);
    plain.pedestrian_distance_m = pedestrian_distance_m.value_or(nan);
    plain.validity_ms = validity ? static_cast<std::uint32_t>(validity->count()) : 0;
    plain.lane = static_cast<std::int8_t>(lane.value_or(CROSSGUARD_NO_LANE));
    plain.is_offset = is_offset ? 1 : 0;
    MapPlace::write(map_place, plain);
  }

private:
  static std::optional<double> known(double quantity) {
    return std::isnan(quantity) ? std::nullopt : std::optional<double>{quantity};
  }
};

/// A maneuver of this robot.
struct Maneuver {
  Session session;
  std::uint8_t request;
  Task task;
};

/// Why something is as it is.
struct Why {
  Reason reason;
  Unavailability unavailability; ///< where the reason is CROSSGUARD_REASON_UNAVAILABLE
  std::uint32_t station;         ///< where it is about one
};

// Outputs of a robot.
struct Send {
  Message message;
  Octets packet;          ///< a whole GeoNetworking packet
  Octets octets;          ///< the message in it, UPER
  std::uint16_t port;     ///< of BTP-B
  std::uint16_t traffic_class;
};
struct StartManeuver { Maneuver maneuver; TaskParameters parameters; };
struct StopManeuver { Maneuver maneuver; Why why; };
struct FallBack { Maneuver maneuver; Fallback policy; };
/// Show go for at most this long. The sign must end it by itself, without this program's help.
struct CorridorOpened { std::chrono::milliseconds open_for; };
/// Go on showing go, for at most this long from now.
struct CorridorExtended { std::chrono::milliseconds open_for; };
struct CorridorClosed { Why why; };
struct LockIdentity { bool locked; };
struct RenewEpoch {}; ///< persist a larger boot counter, and then tell `Event::epoch_renewed`
struct Notice {
  NoticeKind kind;
  std::uint32_t station; ///< where it is about one
  Session session;       ///< where it is about one
  std::uint8_t request;  ///< where it is about a command
  Why why;               ///< where there is a reason
};
struct Ignored { Why why; };

using What = std::variant<Send, StartManeuver, StopManeuver, FallBack, CorridorOpened,
                          CorridorExtended, CorridorClosed, LockIdentity, RenewEpoch, Notice, Ignored>;

/// One output of a turn.
class Output {
public:
  Output(const CrossguardOutput &plain, const std::uint8_t *packets) noexcept
      : plain_{&plain}, packets_{packets} {}

  const CrossguardOutput &plain() const noexcept { return *plain_; }

  /// The output by its kind.
  What what() const {
    const CrossguardOutput &it = *plain_;
    switch (it.kind) {
    case CROSSGUARD_OUTPUT_KIND_SEND:
      return Send{static_cast<Message>(it.message), octets(it.packet_offset, it.packet_length),
                  octets(it.message_offset, it.message_length), it.port, it.traffic_class};
    case CROSSGUARD_OUTPUT_KIND_START_MANEUVER:
      return StartManeuver{maneuver(), TaskParameters::from(it.parameters)};
    case CROSSGUARD_OUTPUT_KIND_STOP_MANEUVER: return StopManeuver{maneuver(), why()};
    case CROSSGUARD_OUTPUT_KIND_FALL_BACK:
      return FallBack{maneuver(), static_cast<Fallback>(it.policy)};
    case CROSSGUARD_OUTPUT_KIND_CORRIDOR_OPENED: return CorridorOpened{open_for()};
    case CROSSGUARD_OUTPUT_KIND_CORRIDOR_EXTENDED: return CorridorExtended{open_for()};
    case CROSSGUARD_OUTPUT_KIND_CORRIDOR_CLOSED: return CorridorClosed{why()};
    case CROSSGUARD_OUTPUT_KIND_LOCK_IDENTITY: return LockIdentity{true};
    case CROSSGUARD_OUTPUT_KIND_UNLOCK_IDENTITY: return LockIdentity{false};
    case CROSSGUARD_OUTPUT_KIND_RENEW_EPOCH: return RenewEpoch{};
    case CROSSGUARD_OUTPUT_KIND_NOTICE:
      return Notice{static_cast<NoticeKind>(it.notice), it.station, it.session, it.request, why()};
    default: return Ignored{why()};
    }
  }

  /// The output, if it is of this kind.
  template <typename Wanted> std::optional<Wanted> as() const {
    const What all = what();
    const Wanted *wanted = std::get_if<Wanted>(&all);
    return wanted ? std::optional<Wanted>{*wanted} : std::nullopt;
  }

private:
  const CrossguardOutput *plain_;
  const std::uint8_t *packets_;

  Octets octets(std::uint32_t offset, std::uint32_t length) const {
    return {packets_ + offset, length};
  }
  std::chrono::milliseconds open_for() const {
    return std::chrono::milliseconds{plain_->open_ms};
  }
  Maneuver maneuver() const {
    return {plain_->session, plain_->request, static_cast<Task>(plain_->task)};
  }
  Why why() const {
    return {static_cast<Reason>(plain_->reason),
            static_cast<Unavailability>(plain_->unavailability), plain_->station};
  }
};

/// The buffers of a call and what came of it. Large: keep one and use it again.
class Turn {
public:
  Turn() noexcept {
    crossguard_turn_init(&plain_, packets_.data(), packets_.size(), log_.data(), log_.size());
  }
  Turn(const Turn &) = delete;
  Turn &operator=(const Turn &) = delete;

  /// The outputs, in the order in which they must be carried out.
  class Outputs {
  public:
    class Iterator {
    public:
      Iterator(const Turn &turn, std::size_t at) noexcept : turn_{&turn}, at_{at} {}
      Output operator*() const noexcept {
        return {turn_->plain_.outputs[at_], turn_->packets_.data()};
      }
      Iterator &operator++() noexcept { ++at_; return *this; }
      bool operator!=(const Iterator &other) const noexcept { return at_ != other.at_; }

    private:
      const Turn *turn_;
      std::size_t at_;
    };
    explicit Outputs(const Turn &turn) noexcept : turn_{&turn} {}
    Iterator begin() const noexcept { return {*turn_, 0}; }
    Iterator end() const noexcept { return {*turn_, turn_->plain_.outputs_length}; }
    std::size_t size() const noexcept { return turn_->plain_.outputs_length; }

  private:
    const Turn *turn_;
  };
  Outputs outputs() const noexcept { return Outputs{*this}; }

  /// State of the robot's body; set before a call.
  Body &body() noexcept { return plain_.body; }
  /// TimestampIts and the microseconds of the log's clock; set before a call.
  void at(std::uint64_t timestamp_its, std::uint64_t log_us) noexcept {
    plain_.timestamp_its = timestamp_its;
    plain_.log_at_us = log_us;
  }
  /// For how long the next packet or message has waited in this machine; set before it is received. One that
  /// waited for longer than `delay_max` is dropped.
  void waited(std::chrono::milliseconds time) noexcept {
    plain_.waited_ms = static_cast<std::uint32_t>(time.count());
  }

  /// Lines for `crossguard validate`, each with its newline.
  std::string_view log() const noexcept { return {log_.data(), plain_.log_length}; }
  /// The station that was heard, if a message was understood.
  std::optional<Heard> heard() const noexcept {
    if (plain_.heard.message == CROSSGUARD_MESSAGE_NONE) return std::nullopt;
    return plain_.heard;
  }
  /// Why a packet was dropped, if it was.
  std::optional<std::string_view> dropped() const noexcept {
    if (plain_.dropped[0] == '\0') return std::nullopt;
    return std::string_view{plain_.dropped};
  }
  CrossguardTurn *plain() noexcept { return &plain_; }

private:
  CrossguardTurn plain_;
  std::array<std::uint8_t, CROSSGUARD_PACKETS_LEN> packets_;
  std::array<char, CROSSGUARD_LOG_LEN> log_;
};

/// Configuration of a robot: station id, boot counter and name, and the defaults, for changes.
class Config {
public:
  /// `boot` is larger than at any boot before, and persisted before the robot is started.
  Config(std::uint32_t station, std::uint16_t boot, std::string_view name) noexcept {
    crossguard_config_init(&plain_);
    plain_.station = station;
    plain_.boot = boot;
    const std::size_t length = name.size() < CROSSGUARD_NAME_LEN ? name.size()
                                                                 : CROSSGUARD_NAME_LEN - 1;
    std::memcpy(plain_.name, name.data(), length);
    plain_.name[length] = '\0';
  }
  CrossguardSettings &settings() noexcept { return plain_.settings; }
  CrossguardConfig &plain() noexcept { return plain_; }
  const CrossguardConfig &plain() const noexcept { return plain_; }

  /// Why it is refused, if it is.
  std::optional<std::string> why() const {
    char text[256];
    if (crossguard_config_check(&plain_, text, sizeof text) == CROSSGUARD_STATUS_OK)
      return std::nullopt;
    return std::string{text};
  }

private:
  CrossguardConfig plain_;
};

/// An event of the robot's own application.
class Event {
public:
  static Event pedestrian_detected(std::uint8_t followers, std::uint16_t tasks,
                                   Urgency urgency = CROSSGUARD_URGENCY_MEDIUM,
                                   std::uint32_t place = 0) noexcept {
    Event event{CROSSGUARD_EVENT_KIND_PEDESTRIAN_DETECTED};
    event.plain_.followers = followers;
    event.plain_.tasks = tasks;
    event.plain_.urgency = static_cast<std::uint8_t>(urgency);
    event.plain_.place = place;
    return event;
  }
  static Event command(std::uint32_t follower, Task task, const TaskParameters &parameters = {}) {
    Event event{CROSSGUARD_EVENT_KIND_COMMAND_MANEUVER};
    event.plain_.station = follower;
    event.plain_.task = static_cast<std::uint8_t>(task);
    parameters.write(event.plain_.parameters);
    return event;
  }
  /// Only when the body holds the place from which the maneuver guards: people step on the road by it.
  static Event in_position(const Maneuver &maneuver) noexcept {
    return of(CROSSGUARD_EVENT_KIND_IN_POSITION, maneuver);
  }
  /// As soon as the body may not hold that place any more: nobody is let on the road then.
  static Event out_of_position(const Maneuver &maneuver) noexcept {
    return of(CROSSGUARD_EVENT_KIND_OUT_OF_POSITION, maneuver);
  }
  static Event completed(const Maneuver &maneuver) noexcept {
    return of(CROSSGUARD_EVENT_KIND_MANEUVER_COMPLETED, maneuver);
  }
  static Event failed(const Maneuver &maneuver) noexcept {
    return of(CROSSGUARD_EVENT_KIND_MANEUVER_FAILED, maneuver);
  }
  // <plain events>
  /// The pedestrian has crossed and nobody is on the road; the session may end. It takes the guards off the road.
  static Event task_completed() noexcept { return Event{CROSSGUARD_EVENT_KIND_TASK_COMPLETED}; }
  /// The people that this robot guarded are off the road, and its body has finished its fallback. To be told only when both are so: it ends the robot's duty.
  static Event road_clear() noexcept { return Event{CROSSGUARD_EVENT_KIND_ROAD_CLEAR}; }
  /// The requester knows of no robot nearby that has not answered its request.
  static Event all_answered() noexcept { return Event{CROSSGUARD_EVENT_KIND_ALL_ANSWERED}; }
  /// The robot wants to leave whatever session it is in.
  static Event leave_requested() noexcept { return Event{CROSSGUARD_EVENT_KIND_LEAVE_REQUESTED}; }
  /// The leader's application wants to let the pedestrian cross.
  static Event open_corridor() noexcept { return Event{CROSSGUARD_EVENT_KIND_OPEN_CORRIDOR}; }
  /// The leader's application wants to hold the pedestrian back again.
  static Event close_corridor() noexcept { return Event{CROSSGUARD_EVENT_KIND_CLOSE_CORRIDOR}; }
  /// Somebody is on the road, seen by this follower itself. Until it tells `RoadClear` it stays, however its leader ends the session.
  static Event person_on_road() noexcept { return Event{CROSSGUARD_EVENT_KIND_PERSON_ON_ROAD}; }
  // </plain events>
  static Event available(Unavailability unavailability = CROSSGUARD_UNAVAILABILITY_NONE) noexcept {
    Event event{CROSSGUARD_EVENT_KIND_AVAILABILITY_CHANGED};
    event.plain_.unavailability = static_cast<std::uint8_t>(unavailability);
    return event;
  }
  static Event identity_changed(std::uint32_t station) noexcept {
    Event event{CROSSGUARD_EVENT_KIND_IDENTITY_CHANGED};
    event.plain_.station = station;
    return event;
  }
  /// Only when this boot counter, larger than the one before, is on the disk.
  static Event epoch_renewed(std::uint16_t boot) noexcept {
    Event event{CROSSGUARD_EVENT_KIND_EPOCH_RENEWED};
    event.plain_.boot = boot;
    return event;
  }
  const CrossguardEvent &plain() const noexcept { return plain_; }

private:
  CrossguardEvent plain_;
  explicit Event(CrossguardEventKind kind) noexcept {
    crossguard_event_init(&plain_, static_cast<std::uint8_t>(kind));
  }
  static Event of(CrossguardEventKind kind, const Maneuver &maneuver) noexcept {
    Event event{kind};
    event.plain_.session = maneuver.session;
    event.plain_.request = maneuver.request;
    return event;
  }
};

/// A robot. It can be moved, not copied: two robots with one identity are none.
class Robot {
public:
  /// A robot that has just booted; nothing if the configuration is refused, and then `status` says why.
  static std::optional<Robot> start(const Config &config, Status *status = nullptr) noexcept {
    Robot robot;
    const Status started = crossguard_robot_init(&robot.plain_, sizeof robot.plain_,
                                                 CROSSGUARD_ABI_VERSION, &config.plain());
    if (status) *status = started;
    if (started != CROSSGUARD_STATUS_OK) return std::nullopt;
    return std::optional<Robot>{std::move(robot)};
  }
  Robot(const Robot &) = delete;
  Robot &operator=(const Robot &) = delete;
  Robot(Robot &&other) noexcept : plain_{other.plain_} { other.plain_ = {}; }
  Robot &operator=(Robot &&other) noexcept {
    if (this != &other) {
      crossguard_robot_finish(&plain_);
      plain_ = other.plain_;
      other.plain_ = {};
    }
    return *this;
  }
  /// Says no farewell; for one, tell `Event::leave_requested()` and wait until the robot is idle.
  ~Robot() { crossguard_robot_finish(&plain_); }

  /// Tells that time has passed: before every other call, and no later than `next_due()`.
  Status elapse(std::chrono::milliseconds elapsed, Turn &turn) noexcept {
    const auto most = static_cast<std::chrono::milliseconds::rep>(UINT32_MAX);
    const auto count = elapsed.count() < 0 ? 0 : elapsed.count() > most ? most : elapsed.count();
    return crossguard_elapse(&plain_, static_cast<std::uint32_t>(count), turn.plain());
  }
  Status tell(const Event &event, Turn &turn) noexcept {
    return crossguard_tell(&plain_, &event.plain(), turn.plain());
  }
  /// Takes in a GeoNetworking packet.
  Status receive(Octets packet, Turn &turn) noexcept {
    return crossguard_receive(&plain_, packet.data, packet.size, turn.plain());
  }
  /// Takes in a RAM or RMCM that another stack took out of its packet.
  Status receive_message(Octets message, Turn &turn) noexcept {
    return crossguard_receive_message(&plain_, message.data, message.size, turn.plain());
  }
  /// Sends a RAM outside of a session; in a session it does nothing.
  Status announce(Turn &turn) noexcept { return crossguard_announce(&plain_, turn.plain()); }
  Status start_log(std::uint64_t unix_ms, Turn &turn) noexcept {
    return crossguard_log_start(&plain_, unix_ms, turn.plain());
  }
  Status stop_log(Turn &turn) noexcept { return crossguard_log_stop(&plain_, turn.plain()); }

  View view() const noexcept {
    View view{};
    // Another thread is in it for some microseconds. Without a view this would say that the robot has no duty.
    while (crossguard_view(&plain_, &view) == CROSSGUARD_STATUS_IN_USE) std::this_thread::yield();
    return view;
  }
  State state() const noexcept { return static_cast<State>(view().state); }
  Role role() const noexcept { return static_cast<Role>(view().role); }
  std::optional<Session> session() const noexcept {
    const View it = view();
    return it.has_session ? std::optional<Session>{it.session} : std::nullopt;
  }
  /// Leader: whether the pedestrian may cross, and whether the road is known to be clear.
  Corridor corridor() const noexcept { return static_cast<Corridor>(view().corridor); }
  /// Whether it is on duty on the road until `Event::road_clear()`, and takes part in nothing new.
  bool is_on_duty() const noexcept { return view().duty != CROSSGUARD_DUTY_NONE; }
  /// When time must be told at the latest, if a timer is armed.
  std::optional<std::chrono::milliseconds> next_due() const noexcept {
    const View it = view();
    if (it.next_due_ms == CROSSGUARD_NONE_MS) return std::nullopt;
    return std::chrono::milliseconds{it.next_due_ms};
  }
  /// Whether the caller announces the robot, because no session says when its RAM go.
  bool announces_itself() const noexcept { return view().next_ram_ms == CROSSGUARD_NONE_MS; }
  CrossguardRobot *plain() noexcept { return &plain_; }

private:
  CrossguardRobot plain_{};
  Robot() noexcept = default;
};

} // namespace crossguard

#endif // CROSSGUARD_HPP
