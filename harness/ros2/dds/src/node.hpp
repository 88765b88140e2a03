// One robot as a node on DDS: what the robot puts out goes to topics, and what comes by topics goes to the robot.
#ifndef CROSSGUARD_DDS_NODE_HPP
#define CROSSGUARD_DDS_NODE_HPP

#include <array>
#include <chrono>
#include <csignal>
#include <deque>
#include <fstream>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crossguard.hpp"
#include "dds.hpp"
#include "hearing.hpp"
#include "link.hpp"
#include "telling.hpp"

// What the node is started with.
struct Options {
  std::uint32_t station = 0;
  std::string name, boot_file, log, space = "", node = "crossguard";
  std::uint32_t domain = 0;
  std::uint8_t category = 0;
  Site site;
  std::chrono::milliseconds silence{500};
  std::optional<sockaddr_in> link;
  std::vector<sockaddr_in> peers;
};

// The next boot counter, which is on the disk before the robot takes part in anything.
std::optional<std::uint16_t> next_boot(const std::string &path);

// Whether the process was told to end.
extern volatile std::sig_atomic_t is_to_end;

// A descriptor that is readable when messages have come. DDS writes to it from threads of its own.
class Bell {
public:
  Bell();
  ~Bell();
  Bell(const Bell &) = delete;
  Bell &operator=(const Bell &) = delete;

  int descriptor() const { return descriptor_; }
  const dds_listener_t *listener() const { return listener_; }
  void hush() const;

private:
  int descriptor_;
  dds_listener_t *listener_;
};

class Node {
public:
  // Throws `ros::Error` where DDS does not open its topics.
  Node(const Options &options, dds_entity_t participant, crossguard::Robot robot, Link &link);

  // Until the process is told to end. Whether the robot could leave in order.
  bool run();

  // What the robot is to do, by kind of output.
  void operator()(const crossguard::Send &send) { link_.send(send.packet); }
  void operator()(const crossguard::StartManeuver &it) { act(happening(it, options_.site), true); }
  void operator()(const crossguard::StopManeuver &it) { act(happening(it), false); }
  void operator()(const crossguard::FallBack &it) { act(happening(it), false); }
  void operator()(const crossguard::CorridorOpened &it) { go(it.open_for); }
  void operator()(const crossguard::CorridorExtended &it) { go(it.open_for); }
  void operator()(const crossguard::CorridorClosed &it);
  void operator()(const crossguard::LockIdentity &it);
  void operator()(const crossguard::RenewEpoch &);
  void operator()(const crossguard::Notice &it) { tell(happening(it)); }
  void operator()(const crossguard::Ignored &it);

private:
  using Clock = std::chrono::steady_clock;
  // Whether the node that moves the body is there: it publishes poses and hears events.
  enum class Presence { absent, here, silent };

  const Options &options_;
  Bell bell_;
  Link &link_;
  crossguard::Robot robot_;
  crossguard::Turn turn_;
  std::ofstream log_;
  ros::Writer<ros::Corridor> corridor_;
  ros::Writer<ros::Status> status_;
  ros::Writer<ros::Event> event_;
  ros::Writer<ros::DiagnosticArray> diagnostics_;
  ros::Reader<ros::Command> commands_;
  ros::Reader<ros::PoseStamped> poses_;

  const Clock::time_point started_ = Clock::now();
  std::chrono::milliseconds told_{0};
  Clock::time_point announced_{}, corridor_told_{}, status_told_{}, diagnostics_told_{};
  std::deque<crossguard::Event> wishes_;
  std::future<std::optional<std::uint16_t>> renewing_;
  bool is_commanded_ = false, is_to_tell_ = true;

  // Until when the pedestrian may cross, and why the corridor was closed last in this session.
  Clock::time_point go_until_{};
  std::optional<crossguard::Why> closed_;

  Presence presence_ = Presence::absent;
  // What the robot is unavailable for while its body is not there.
  std::optional<crossguard::Unavailability> missing_ = CROSSGUARD_UNAVAILABILITY_LOCAL_FAULT;
  dds_instance_handle_t body_ = 0, participant_ = 0;
  Clock::time_point heard_{};
  crossguard::Body announced_body_{};

  std::map<std::string, std::uint64_t> counters_;
  std::uint64_t dropped_ = 0, dropped_before_ = 0;

  std::string topic(const char *name) const;
  void count(const std::string &cause, const std::string &more = "");
  void prepare();
  void finish(const char *what, crossguard::Status status);
  void let_time_pass();
  void tell_robot(const crossguard::Event &event);
  void turn();
  void hear_link();
  void hear_pose(const ros::PoseStamped &pose, dds_instance_handle_t writer);
  void hear_command(const ros::Command &command);
  void watch_body();
  void announce();
  void go(std::chrono::milliseconds open_for);
  void act(Happening what, bool begins);
  bool tell(Happening what);
  void tell_state();
  void tell_corridor(const CorridorTold &told);
};

#endif // CROSSGUARD_DDS_NODE_HPP
