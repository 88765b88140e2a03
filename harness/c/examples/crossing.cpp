// One robot of a crossing, in C++17: what crossing.c does, with crossguard.hpp.
//
// Usage: crossing_cpp leader|follower STATION PORT PEER_PORT BOOT_FILE [LOG_FILE]
//
// Four things in it keep people alive; when you copy it, keep them and put your own robot behind them:
//
// 1. The sign ends go by itself, also when this program hangs: class `Sign`.
// 2. `in_position` is told when the body is there, and not before: `move_body`.
// 3. `road_clear` is told when the fallback is finished and the road was seen to be clear: `finish_duty`.
// 4. `task_completed` is told when nobody is on the road any more: `live`.
//
// It ends with 0 when the crossing was completed, with 1 when it was not, with 2 on wrong usage.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "crossguard.hpp"

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using std::chrono::duration_cast;
using std::chrono::milliseconds;

constexpr auto maneuver_time = 1500ms;
constexpr auto patience = 60s;

// TimestampIts counts from 2004 with leap seconds, of which there were 5 since.
std::uint64_t unix_ms() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(duration_cast<milliseconds>(now).count());
}
std::uint64_t timestamp_its() { return unix_ms() - 1072915200000u + 5000u; }

// The next boot counter. It is on the disk before the robot takes part in anything.
std::optional<std::uint16_t> next_boot(const std::string &path) {
  unsigned boot = 0;
  if (std::ifstream before{path}; before && (!(before >> boot) || boot >= UINT16_MAX))
    return std::nullopt;
  const std::string beside = path + ".new";
  std::FILE *file = std::fopen(beside.c_str(), "w");
  if (!file) return std::nullopt;
  const bool written = std::fprintf(file, "%u\n", boot + 1) > 0 && std::fflush(file) == 0 &&
                       fsync(fileno(file)) == 0;
  if (std::fclose(file) != 0 || !written || std::rename(beside.c_str(), path.c_str()) != 0)
    return std::nullopt;
  return static_cast<std::uint16_t>(boot + 1);
}

// A UDP socket on the loopback interface, and who is at its other end.
class Link {
public:
  Link(std::uint16_t port, std::uint16_t peer) : socket_{::socket(AF_INET, SOCK_DGRAM, 0)} {
    const sockaddr_in own = address(port);
    is_open_ = socket_ >= 0 && bind(socket_, reinterpret_cast<const sockaddr *>(&own), sizeof own) == 0;
    peer_ = address(peer);
  }
  ~Link() { close(socket_); }
  Link(const Link &) = delete;
  Link &operator=(const Link &) = delete;

  bool is_open() const { return is_open_; }
  void send(crossguard::Octets packet) const {
    // A packet that the link does not take is as lost as one on the air.
    (void)::sendto(socket_, packet.data, packet.size, 0,
                   reinterpret_cast<const sockaddr *>(&peer_), sizeof peer_);
  }
  std::optional<crossguard::Octets> receive(milliseconds at_most) {
    pollfd readable{socket_, POLLIN, 0};
    const auto called = Clock::now();
    int ready = poll(&readable, 1, 0);
    // Only a link that has nothing at once is empty, and that when it was asked: this process may have been
    // stopped since. A packet may have come as soon as the link was seen to be empty.
    if (ready == 0) {
      empty_ = called;
      ready = poll(&readable, 1, static_cast<int>(at_most.count()));
    }
    if (ready <= 0) return std::nullopt;
    const ssize_t length = recv(socket_, packet_.data(), packet_.size(), MSG_DONTWAIT);
    if (length < 0) return std::nullopt;
    return crossguard::Octets{packet_.data(), static_cast<std::size_t>(length)};
  }

  milliseconds waited() const { return duration_cast<milliseconds>(Clock::now() - empty_); }

private:
  int socket_;
  bool is_open_ = false;
  Clock::time_point empty_ = Clock::now();
  sockaddr_in peer_{};
  std::array<std::uint8_t, 2048> packet_{};

  static sockaddr_in address(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }
};

// The sign. It is a process of its own, as it is a device of its own on your robot, because it ends go by
// itself: when its time is over, and when the program that renews it hangs or is gone. What it is sent is the
// moment until which it may show go, so a message that comes late makes nothing longer.
class Sign {
public:
  Sign() {
    int ends[2];
    if (pipe(ends) != 0 || fcntl(ends[1], F_SETFL, O_NONBLOCK) != 0 || (process_ = fork()) < 0) {
      std::perror("sign");
      std::exit(2);
    }
    if (process_ == 0) {
      close(ends[1]);
      show(ends[0]);
    }
    close(ends[0]);
    orders_ = ends[1];
  }
  ~Sign() {
    close(orders_);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {}
  }
  Sign(const Sign &) = delete;
  Sign &operator=(const Sign &) = delete;

  // A sign that does not take the order shows stop when its time is over.
  void go_until(Clock::time_point until) const {
    if (write(orders_, &until, sizeof until) < 0) std::cerr << "the sign is gone" << std::endl;
  }
  void stop() const { go_until({}); }

private:
  pid_t process_ = -1;
  int orders_ = -1;

  [[noreturn]] static void show(int orders) {
    Clock::time_point until{};
    bool shows_go = false;
    for (;;) {
      const auto left = duration_cast<milliseconds>(until - Clock::now());
      const bool may = left > 0ms;
      if (may != shows_go) std::cout << "sign shows " << (may ? "go" : "stop") << std::endl;
      shows_go = may;
      pollfd readable{orders, POLLIN, 0};
      if (poll(&readable, 1, may ? static_cast<int>(left.count()) : -1) <= 0) continue;
      if (read(orders, &until, sizeof until) != sizeof until) break;
    }
    if (shows_go) std::cout << "sign shows stop" << std::endl;
    _exit(0);
  }
};

// STANDS FOR YOUR PERCEPTION: whether somebody has seen that nobody is on the carriageway. No clock and no
// message says it. Here an operator says it: kill -USR1.
volatile std::sig_atomic_t road_was_seen_clear;
void see_road_clear(int) { road_was_seen_clear = 1; }

class Application {
public:
  Application(bool leads, crossguard::Robot robot, Link &link, const Sign &sign, std::string boot_file,
              std::ofstream *log)
      : leads_{leads}, robot_{std::move(robot)}, link_{link}, sign_{sign},
        boot_file_{std::move(boot_file)}, log_{log} {
    turn_.body().latitude_deg = 49.0101;
    turn_.body().longitude_deg = 8.4124;
    turn_.body().speed_mps = 0;
    turn_.body().category = leads ? 1 : 2;
    prepare();
    finish("log", robot_.start_log(unix_ms(), turn_));
  }

  bool run() {
    while (Clock::now() - started_ < patience) {
      const auto view = robot_.view();
      if (over_ && view.state == CROSSGUARD_STATE_IDLE && !view.is_locked &&
          view.duty == CROSSGUARD_DUTY_NONE)
        break;
      const auto due = robot_.next_due().value_or(20ms);
      if (const auto packet = link_.receive(due < 20ms ? due : 20ms)) receive(*packet);
      let_time_pass();
      live(view);
      while (!wishes_.empty()) {
        const crossguard::Event event = wishes_.front();
        wishes_.pop_front();
        let_time_pass();
        prepare();
        finish("tell", robot_.tell(event, turn_));
      }
    }
    prepare();
    finish("log", robot_.stop_log(turn_));
    return completed_;
  }

  // What a robot is to do, by kind of output.
  void operator()(const crossguard::Send &send) { link_.send(send.packet); }
  void operator()(const crossguard::StartManeuver &start) {
    maneuver_ = start.maneuver;
    parameters_ = start.parameters;
    doing_ = Doing::under_way;
    arrives_at_ = Clock::now() + maneuver_time;
    std::cout << "starts task " << int(start.maneuver.task) << " of request "
              << int(start.maneuver.request) << std::endl;
  }
  void operator()(const crossguard::StopManeuver &) { doing_ = Doing::stands; }
  // A body stays at its person's side to the kerb, or holds the traffic: see `policy`. Never just stop.
  void operator()(const crossguard::FallBack &fallback) {
    doing_ = Doing::falls_back;
    arrives_at_ = Clock::now() + maneuver_time;
    look_again();
    std::cout << "falls back by policy " << int(fallback.policy) << std::endl;
  }
  void operator()(const crossguard::CorridorOpened &opened) {
    corridor_was_open_ = true;
    look_again();
    sign_.go_until(started_ + told_ + opened.open_for);
    std::cout << "corridor open" << std::endl;
  }
  void operator()(const crossguard::CorridorExtended &extended) {
    sign_.go_until(started_ + told_ + extended.open_for);
  }
  void operator()(const crossguard::CorridorClosed &) {
    sign_.stop();
    std::cout << "corridor closed" << std::endl;
  }
  // A larger boot counter, on the disk before it is told. The disk may be slow: do it beside your loop.
  void operator()(const crossguard::RenewEpoch &) {
    if (const auto boot = next_boot(boot_file_)) wishes_.push_back(crossguard::Event::epoch_renewed(*boot));
  }
  void operator()(const crossguard::LockIdentity &) {}
  void operator()(const crossguard::Ignored &) {}
  void operator()(const crossguard::Notice &notice) {
    if (leads_) {
      lead(notice);
    } else if (notice.kind == CROSSGUARD_NOTICE_RELEASED) {
      over_ = true;
      completed_ = notice.why.reason == CROSSGUARD_REASON_TASK_COMPLETED;
    }
  }

private:
  enum class Stage { waits, asks, positions, escorts, arrived, done };
  enum class Doing { stands, under_way, holds_place, falls_back };

  bool leads_;
  crossguard::Robot robot_;
  Link &link_;
  const Sign &sign_;
  std::string boot_file_;
  std::ofstream *log_;
  crossguard::Turn turn_;
  Clock::time_point started_ = Clock::now();
  milliseconds told_{0};
  Clock::time_point announced_{}, tried_{}, arrives_at_{};
  std::deque<crossguard::Event> wishes_;
  crossguard::Maneuver maneuver_{};
  crossguard::TaskParameters parameters_{};
  Doing doing_ = Doing::stands;
  Stage stage_ = Stage::waits;
  std::uint32_t follower_ = 0;
  bool corridor_was_open_ = false, is_across_ = false, over_ = false, completed_ = false;

  // The leader's simulated pedestrian is across when its escort has arrived. What was seen before the last
  // go or the beginning of a fallback does not count.
  bool road_is_clear() const { return road_was_seen_clear || is_across_; }
  void look_again() {
    road_was_seen_clear = 0;
    is_across_ = false;
  }

  // The log's clock shows the reading by which the robot was told of time: one reading for both.
  void prepare() {
    const std::chrono::microseconds log_at = told_;
    turn_.at(timestamp_its(), static_cast<std::uint64_t>(log_at.count()));
  }

  void finish(const char *what, crossguard::Status status) {
    if (status != CROSSGUARD_STATUS_OK) {
      std::cerr << what << ": " << crossguard::text(status) << std::endl;
      std::exit(1);
    }
    if (log_) *log_ << turn_.log();
    for (const auto output : turn_.outputs()) std::visit(*this, output.what());
  }

  // Time first, then what happened in it.
  void let_time_pass() {
    const auto before = told_;
    told_ = duration_cast<milliseconds>(Clock::now() - started_);
    prepare();
    finish("elapse", robot_.elapse(told_ - before, turn_));
  }

  void receive(crossguard::Octets packet) {
    let_time_pass();
    prepare();
    turn_.waited(link_.waited());
    finish("receive", robot_.receive(packet, turn_));
    if (const auto why = turn_.dropped()) std::cout << "dropped, " << *why << std::endl;
  }

  void command(crossguard::Task task, double latitude) {
    crossguard::TaskParameters parameters;
    parameters.place_deg = {latitude, 8.4124137};
    parameters.maximum_speed_mps = 1.4;
    wishes_.push_back(crossguard::Event::command(follower_, task, parameters));
  }

  void open_corridor() {
    tried_ = Clock::now();
    wishes_.push_back(crossguard::Event::open_corridor());
  }

  // What a leader makes of the news.
  void lead(const crossguard::Notice &notice) {
    switch (notice.kind) {
    case CROSSGUARD_NOTICE_FOLLOWER_JOINED:
      follower_ = notice.station;
      stage_ = Stage::positions;
      command(crossguard::Task::initial_pos, 49.010091);
      break;
    case CROSSGUARD_NOTICE_MANEUVER_REPORTED:
      if (stage_ == Stage::escorts) open_corridor();
      break;
    case CROSSGUARD_NOTICE_MANEUVER_COMPLETED:
      if (stage_ == Stage::positions) {
        stage_ = Stage::escorts;
        command(crossguard::Task::move, 49.010172);
      } else {
        stage_ = Stage::arrived;
        is_across_ = true;
      }
      break;
    case CROSSGUARD_NOTICE_MANEUVER_FAILED:
    case CROSSGUARD_NOTICE_FOLLOWER_SAFE_IDLE:
      // It gives up. If the corridor was open, its duty lasts until the road is seen to be clear.
      stage_ = Stage::done;
      wishes_.push_back(crossguard::Event::leave());
      break;
    case CROSSGUARD_NOTICE_SESSION_ENDED:
      over_ = true;
      completed_ = notice.why.reason == CROSSGUARD_REASON_TASK_COMPLETED && corridor_was_open_;
      break;
    default: break;
    }
  }

  // The next RAM says where the body is: a leader does not believe a follower that is elsewhere than it was
  // sent.
  void stand_where_sent() {
    const crossguard::TaskParameters &sent = parameters_;
    if (sent.is_offset || !sent.place_deg) return;
    turn_.body().latitude_deg = sent.place_deg->first;
    turn_.body().longitude_deg = sent.place_deg->second;
  }

  // The simulated body arrives. A guard that holds traffic says so and stays, until it is told to stop.
  void move_body() {
    if (doing_ != Doing::under_way || Clock::now() < arrives_at_) return;
    stand_where_sent();
    if (maneuver_.task == crossguard::Task::block) {
      doing_ = Doing::holds_place;
      wishes_.push_back(crossguard::Event::in_position(maneuver_));
    } else {
      doing_ = Doing::stands;
      wishes_.push_back(crossguard::Event::completed(maneuver_));
    }
  }

  // `road_clear`, once the body has finished its fallback and the road is seen to be clear.
  void finish_duty(const crossguard::View &view) {
    if (doing_ == Doing::falls_back && Clock::now() >= arrives_at_ && road_is_clear())
      doing_ = Doing::stands;
    const bool is_bound = view.duty != CROSSGUARD_DUTY_NONE ||
                          (leads_ && view.corridor == CROSSGUARD_CORRIDOR_CLEARING);
    if (is_bound && doing_ == Doing::stands && road_is_clear())
      wishes_.push_back(crossguard::Event::road_clear());
  }

  // What the application does by the clock.
  void live(const crossguard::View &view) {
    const auto now = Clock::now();
    move_body();
    finish_duty(view);
    if (leads_ && stage_ == Stage::waits && now - started_ > 300ms) {
      using crossguard::Task;
      stage_ = Stage::asks;
      const auto tasks = crossguard::tasks(Task::initial_pos, Task::move);
      wishes_.push_back(crossguard::Event::pedestrian_detected(1, tasks));
    }
    if (stage_ == Stage::escorts && view.corridor != CROSSGUARD_CORRIDOR_OPEN && !view.has_yielded &&
        !over_ && now - tried_ > 200ms)
      open_corridor();
    if (stage_ == Stage::arrived && road_is_clear()) {
      stage_ = Stage::done;
      wishes_.push_back(crossguard::Event::task_completed());
    }
    if (robot_.announces_itself() && now - announced_ >= 1s) {
      announced_ = now;
      let_time_pass();
      prepare();
      finish("announce", robot_.announce(turn_));
    }
  }
};

} // namespace

int main(int argc, char **argv) {
  const std::string role = argc > 1 ? argv[1] : "";
  if (argc < 6 || argc > 7 || (role != "leader" && role != "follower")) {
    std::cerr << "usage: " << argv[0]
              << " leader|follower STATION PORT PEER_PORT BOOT_FILE [LOG_FILE]" << std::endl;
    return 2;
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGUSR1, see_road_clear);
  std::optional<Sign> sign{std::in_place};
  const auto station = static_cast<std::uint32_t>(std::stoul(argv[2]));
  Link link{static_cast<std::uint16_t>(std::stoi(argv[3])),
            static_cast<std::uint16_t>(std::stoi(argv[4]))};
  if (!link.is_open()) {
    std::perror("link");
    return 2;
  }
  const auto boot = next_boot(argv[5]);
  if (!boot) {
    std::cerr << argv[5] << ": no boot counter can be taken" << std::endl;
    return 2;
  }
  std::ofstream log;
  if (argc == 7) log.open(argv[6]);
  const crossguard::Config config{station, *boot, "Cpp" + std::to_string(station)};
  auto robot = crossguard::Robot::start(config);
  if (!robot) {
    std::cerr << config.why().value_or("the robot cannot be started") << std::endl;
    return 2;
  }
  // An application is large: buffers for packets and log are in it.
  const auto application = std::make_unique<Application>(
      role == "leader", std::move(*robot), link, *sign, argv[5], log.is_open() ? &log : nullptr);
  const bool completed = application->run();
  sign.reset();
  std::cout << "crossing " << (completed ? "completed" : "not completed") << std::endl;
  return completed ? 0 : 1;
}
