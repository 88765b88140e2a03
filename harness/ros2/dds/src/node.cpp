#include "node.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <variant>

using namespace std::chrono_literals;
using std::chrono::duration_cast;
using std::chrono::milliseconds;

namespace {

constexpr auto corridor_period = 100ms;
constexpr auto status_period = 1s;
// For how long a body is where its pose said, and how long a farewell may take.
constexpr auto pose_lasts = 1s;
constexpr auto farewell = 3s;
constexpr std::size_t packets_at_a_time = 64;
// An application may order all followers in one breath.
constexpr int commands_at_a_time = 100;

std::uint64_t unix_ms() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(duration_cast<milliseconds>(now).count());
}
// TimestampIts counts from 2004 with leap seconds, of which there were 5 since.
std::uint64_t timestamp_its() { return unix_ms() - 1072915200000u + 5000u; }

ros::Qos depth(int depth) { return {depth, DDS_INFINITY, true}; }
ros::Qos newest(milliseconds deadline) { return {1, DDS_MSECS(deadline.count()), true}; }
// Of publishers that send again before long, also those are heard that repeat nothing.
constexpr ros::Qos sensor{10, DDS_INFINITY, false};

} // namespace

std::optional<std::uint16_t> next_boot(const std::string &path) {
  unsigned boot = 0;
  if (std::ifstream before{path}; before && (!(before >> boot) || boot >= UINT16_MAX)) return std::nullopt;
  const std::string beside = path + ".new";
  std::FILE *file = std::fopen(beside.c_str(), "w");
  if (!file) return std::nullopt;
  const bool written =
      std::fprintf(file, "%u\n", boot + 1) > 0 && std::fflush(file) == 0 && fsync(fileno(file)) == 0;
  if (std::fclose(file) != 0 || !written || std::rename(beside.c_str(), path.c_str()) != 0) return std::nullopt;
  return static_cast<std::uint16_t>(boot + 1);
}

Bell::Bell() : descriptor_{eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)}, listener_{dds_create_listener(this)} {
  dds_lset_data_available(listener_, [](dds_entity_t, void *bell) {
    const std::uint64_t one = 1;
    (void)!write(static_cast<Bell *>(bell)->descriptor_, &one, sizeof one);
  });
}

Bell::~Bell() {
  dds_delete_listener(listener_);
  close(descriptor_);
}

void Bell::hush() const {
  std::uint64_t rung = 0;
  (void)!read(descriptor_, &rung, sizeof rung);
}

Node::Node(const Options &options, dds_entity_t participant, crossguard::Robot robot, Link &link)
    : options_{options}, link_{link}, robot_{std::move(robot)},
      corridor_{participant, topic("corridor"), newest(300ms)}, status_{participant, topic("status"), newest(2s)},
      event_{participant, topic("event"), depth(100)}, diagnostics_{participant, "rt/diagnostics", depth(10)},
      commands_{participant, topic("command"), depth(commands_at_a_time), bell_.listener()},
      poses_{participant, topic("pose"), sensor, bell_.listener()} {
  if (!options.log.empty()) log_.open(options.log);
  crossguard::Body &body = turn_.body();
  body.category = options.category;
  body.abilities = 0b111; // detects pedestrians, leads, follows
  prepare();
  finish("log", robot_.start_log(unix_ms(), turn_));
}

std::string Node::topic(const char *name) const {
  return "rt" + options_.space + "/" + options_.node + "/" + name;
}

void Node::count(const std::string &cause, const std::string &more) {
  const std::uint64_t times = ++counters_[cause];
  ++dropped_;
  // Diagnostics have them all; who floods this node fills no log with it.
  if ((times & (times - 1)) == 0)
    std::cerr << cause << (more.empty() ? "" : ": ") << more << std::endl;
}

bool Node::run() {
  while (!is_to_end) turn();
  // It leaves its session by name, and says farewell.
  tell_robot(crossguard::Event::leave());
  const auto until = Clock::now() + farewell;
  const auto is_gone = [&] {
    const auto view = robot_.view();
    return view.state == CROSSGUARD_STATE_IDLE && !view.is_locked;
  };
  while (!is_gone() && Clock::now() < until) turn();
  prepare();
  finish("log", robot_.stop_log(turn_));
  tell_corridor(CorridorTold::inactive(options_.station));
  corridor_.settle(DDS_MSECS(300));
  return is_gone();
}

void Node::turn() {
  const auto due = std::min(robot_.next_due().value_or(20ms), milliseconds{20});
  std::array<pollfd, 2> readable{pollfd{link_.socket(), POLLIN, 0}, pollfd{bell_.descriptor(), POLLIN, 0}};
  (void)poll(readable.data(), readable.size(), static_cast<int>(due.count()));
  let_time_pass();
  hear_link();
  bell_.hush();
  poses_.take([this](const auto &pose, auto writer) { hear_pose(pose, writer); });
  commands_.take([this](const auto &command, auto) { hear_command(command); });
  watch_body();
  if (renewing_.valid() && renewing_.wait_for(0s) == std::future_status::ready) {
    if (const auto boot = renewing_.get()) wishes_.push_back(crossguard::Event::epoch_renewed(*boot));
  }
  while (!wishes_.empty()) {
    const crossguard::Event event = wishes_.front();
    wishes_.pop_front();
    tell_robot(event);
  }
  announce();
  tell_state();
}

// The log's clock shows the reading by which the robot was told of time: one reading for both.
void Node::prepare() {
  crossguard::Body &body = turn_.body();
  const auto now = Clock::now();
  if (now - heard_ > pose_lasts || heard_ == Clock::time_point{})
    body.latitude_deg = body.longitude_deg = body.heading_deg = body.speed_mps = std::nan("");
  const auto why = robot_.view().unavailability;
  body.control_mode = why == CROSSGUARD_UNAVAILABILITY_TELEOPERATED     ? 1
                      : why == CROSSGUARD_UNAVAILABILITY_EMERGENCY_STOP ? 2
                      : why == CROSSGUARD_UNAVAILABILITY_LOCAL_FAULT    ? 3
                                                                        : 0;
  turn_.at(timestamp_its(), static_cast<std::uint64_t>(std::chrono::microseconds{told_}.count()));
}

void Node::finish(const char *what, crossguard::Status status) {
  if (status != CROSSGUARD_STATUS_OK) {
    std::cerr << what << ": " << crossguard::text(status) << std::endl;
    std::abort();
  }
  if (log_.is_open()) log_ << turn_.log() << std::flush;
  if (turn_.outputs().size() > 0) is_to_tell_ = true;
  for (const auto output : turn_.outputs()) std::visit(*this, output.what());
}

// Time first, then what happened in it.
void Node::let_time_pass() {
  const auto before = told_;
  told_ = duration_cast<milliseconds>(Clock::now() - started_);
  prepare();
  finish("elapse", robot_.elapse(told_ - before, turn_));
}

void Node::tell_robot(const crossguard::Event &event) {
  let_time_pass();
  prepare();
  finish("tell", robot_.tell(event, turn_));
}

void Node::hear_link() {
  for (std::size_t nth = 0; nth < packets_at_a_time; ++nth) {
    const auto packet = link_.receive();
    if (!packet) return;
    let_time_pass();
    prepare();
    turn_.waited(link_.waited());
    finish("receive", robot_.receive(*packet, turn_));
    if (const auto why = turn_.dropped()) count(std::string{*why});
  }
}

void Node::hear_pose(const ros::PoseStamped &pose, dds_instance_handle_t writer) {
  if (presence_ == Presence::here && writer != body_) return count("ros: other body");
  const auto participant = poses_.participant_of(writer);
  // What it is told to do would be lost.
  if (!participant || !event_.is_heard_by(*participant)) return count("ros: body hears no events");
  crossguard::Body &body = turn_.body();
  const auto before = body;
  try {
    place(pose, options_.site, body);
  } catch (const Refusal &why) {
    return count("ros: impossible pose", why.what());
  }
  const auto now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - heard_).count();
  const auto [x, y] = options_.site.place(body.latitude_deg, body.longitude_deg);
  const auto [x_before, y_before] = options_.site.place(before.latitude_deg, before.longitude_deg);
  const double speed = std::hypot(x - x_before, y - y_before) / seconds;
  // Two poses that came in one breath tell no speed.
  if (seconds > 0.01) body.speed_mps = std::isfinite(speed) ? std::min(speed, 163.8) : 0;
  if (std::isnan(body.speed_mps)) body.speed_mps = 0;
  heard_ = now;
  body_ = writer;
  participant_ = *participant;
  if (presence_ == Presence::here) return;
  presence_ = Presence::here;
  // An emergency stop ends by the word of a person, and not by a body that comes again.
  if (missing_ == CROSSGUARD_UNAVAILABILITY_LOCAL_FAULT) wishes_.push_front(crossguard::Event::available());
  missing_.reset();
}

void Node::watch_body() {
  if (presence_ == Presence::here && Clock::now() - heard_ > options_.silence) {
    presence_ = Presence::silent;
    missing_ = CROSSGUARD_UNAVAILABILITY_EMERGENCY_STOP;
    count("body: silent");
  }
  // While the body is not there its robot is unavailable, whatever anybody says.
  if (missing_ && robot_.view().unavailability != *missing_)
    wishes_.push_front(crossguard::Event::available(*missing_));
}

void Node::hear_command(const ros::Command &command) {
  let_time_pass();
  std::string why;
  try {
    const auto told = event(command, options_.site);
    if (!told) return describe(command, turn_.body());
    prepare();
    is_commanded_ = true;
    const crossguard::Status status = robot_.tell(*told, turn_);
    if (status == CROSSGUARD_STATUS_OK) finish("command", status);
    else why = crossguard::text(status);
  } catch (const Refusal &refusal) {
    why = refusal.what();
  }
  is_commanded_ = false;
  if (why.empty()) return;
  count("ros: impossible command", why);
  tell(refused(why));
}

// RAM outside of sessions: once a second, and when the body has moved (EN 302 637-2, 6.1.3).
void Node::announce() {
  if (!robot_.announces_itself()) return;
  const auto since = Clock::now() - announced_;
  const crossguard::Body &now = turn_.body(), &then = announced_body_;
  const auto [x, y] = options_.site.place(now.latitude_deg, now.longitude_deg);
  const auto [x_then, y_then] = options_.site.place(then.latitude_deg, then.longitude_deg);
  const bool has_moved = std::hypot(x - x_then, y - y_then) > 4 ||
                         std::fabs(std::remainder(now.heading_deg - then.heading_deg, 360)) > 4 ||
                         std::fabs(now.speed_mps - then.speed_mps) > 0.5;
  if (since < 100ms || (since < 1s && !has_moved)) return;
  announced_ = Clock::now();
  announced_body_ = now;
  let_time_pass();
  prepare();
  finish("announce", robot_.announce(turn_));
}

void Node::go(milliseconds open_for) {
  go_until_ = started_ + told_ + open_for;
  closed_.reset();
}

void Node::operator()(const crossguard::CorridorClosed &it) {
  go_until_ = {};
  closed_ = it.why;
}

void Node::operator()(const crossguard::LockIdentity &it) {
  tell(Happening{static_cast<std::uint8_t>(it.locked ? crossguard_msgs_msg_dds__Event_Constants_LOCK_IDENTITY
                                                     : crossguard_msgs_msg_dds__Event_Constants_UNLOCK_IDENTITY)});
}

// A larger boot counter. The disk may be slow.
void Node::operator()(const crossguard::RenewEpoch &) {
  if (!renewing_.valid()) renewing_ = std::async(std::launch::async, next_boot, options_.boot_file);
}

void Node::operator()(const crossguard::Ignored &it) {
  if (is_commanded_) tell(ignored(it.why));
}

// What the body is to do. One that is not told is a fault: the robot takes no part until somebody says so.
void Node::act(Happening what, bool begins) {
  const bool is_heard = presence_ == Presence::here && event_.is_heard_by(participant_);
  const bool is_told = tell(std::move(what)) && is_heard;
  // That it is silent was told already; it stands still by itself, as it hears nothing either.
  if (is_told || (presence_ == Presence::silent && !begins)) return;
  count("ros: act not taken");
  wishes_.push_front(crossguard::Event::available(CROSSGUARD_UNAVAILABILITY_LOCAL_FAULT));
}

bool Node::tell(Happening what) {
  what.plain.header = header("site");
  what.plain.text = const_cast<char *>(what.text.c_str());
  what.plain.map_place = const_cast<char *>(what.map_place.c_str());
  return event_.write(what.plain);
}

void Node::tell_corridor(const CorridorTold &told) {
  ros::Corridor plain = told.plain;
  plain.header = header("");
  plain.text = const_cast<char *>(told.text.c_str());
  // What a display does not hear is closed there before long.
  if (!corridor_.write(plain)) count("ros: corridor not taken");
}

// How it is: at every change, and by the clock.
void Node::tell_state() {
  const auto now = Clock::now();
  const bool changes = std::exchange(is_to_tell_, false);
  const auto view = robot_.view();
  if (view.role != CROSSGUARD_ROLE_LEADER) closed_.reset();
  if (changes || now - corridor_told_ >= corridor_period) {
    corridor_told_ = now;
    Go go;
    go.closed = closed_;
    if (go_until_ > now) go.left = duration_cast<milliseconds>(go_until_ - now);
    tell_corridor(CorridorTold{view, go});
  }
  if (changes || now - status_told_ >= status_period) {
    status_told_ = now;
    StatusTold told{view, options_.name};
    told.plain.header = header("");
    if (!status_.write(told.plain)) count("ros: status not taken");
  }
  if (now - diagnostics_told_ >= status_period) {
    diagnostics_told_ = now;
    DiagnosticTold told{counters_, dropped_ - dropped_before_, options_.space + "/" + options_.node + ": robot",
                        options_.name};
    dropped_before_ = dropped_;
    told.plain.header = header("");
    if (!diagnostics_.write(told.plain)) count("ros: diagnostics not taken");
  }
}
