// A Crossguard robot as a node on DDS: `crossguard_dds --help`.
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <memory>

#include "loopback.hpp"
#include "node.hpp"

volatile std::sig_atomic_t is_to_end;

namespace {

constexpr const char *usage = R"(A Crossguard robot as a node on DDS, for ROS 2 systems with a DDS middleware.

usage: crossguard_dds --station N --name NAME --boot-file FILE --link ADDRESS:PORT --peer ADDRESS:PORT ...
                      --origin LATITUDE LONGITUDE [more]

  --station N            station id, 1 to 4294967295
  --name NAME            the robot's name in logs
  --boot-file FILE       its boot counter, which counts up at every start
  --link ADDRESS:PORT    the V2X link: where UDP datagrams come in, like 127.0.0.1:4002
  --peer ADDRESS:PORT    where they go; may be said several times
  --origin LAT LON       the origin of the site, in degrees: places are metres east and north of it
  --namespace /NAME      the namespace of the topics, like /go2
  --node NAME            the name of the node, crossguard by default
  --domain N             the ROS domain, ROS_DOMAIN_ID or 0 by default
  --build NAME           unknown, humanoid, quadruped, wheeled, tracked, aerial or other
  --silence-ms N         after how long without a pose the body is silent, 200 to 5000; 500 by default
  --log FILE             write what 'crossguard validate' judges

DDS stays on this machine unless CYCLONEDDS_URI says otherwise: every node that can publish on the topic command
commands the robot.
)";

[[noreturn]] void refuse(const std::string &why) {
  std::cerr << why << "; see --help" << std::endl;
  std::exit(2);
}

template <class Number> Number number(const std::string &option, const std::string &text, Number least, Number most) {
  char *end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_whole = std::is_floating_point_v<Number> || value == static_cast<double>(static_cast<long long>(value));
  if (text.empty() || *end != '\0' || !(value >= static_cast<double>(least) && value <= static_cast<double>(most)) ||
      !is_whole)
    refuse(option + " " + text + ": a number from " + std::to_string(least) + " to " + std::to_string(most) +
           " is wanted");
  return static_cast<Number>(value);
}

sockaddr_in address(const std::string &option, const std::string &text) {
  const auto of = endpoint(text);
  if (!of) refuse(option + " " + text + ": an IPv4 address and port are wanted, like 127.0.0.1:4002");
  return *of;
}

// A name of ROS 2: letters, digits and underscores, and no digit first.
bool is_name(const std::string &text) {
  const char *letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
  return !text.empty() && text.find_first_not_of(letters) == std::string::npos && (text[0] < '0' || text[0] > '9');
}

bool is_namespace(const std::string &text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const auto next = std::min(text.find('/', at + 1), text.size());
    if (text[at] != '/' || !is_name(text.substr(at + 1, next - at - 1))) return false;
    at = next;
  }
  return true;
}

std::uint8_t category(const std::string &text) {
  std::uint8_t code = 0;
  for (const char *name : {"unknown", "humanoid", "quadruped", "wheeled", "tracked", "aerial", "other"}) {
    if (text == name) return code;
    ++code;
  }
  refuse("--build " + text + ": there is no such build");
}

Options options(int argc, char **argv) {
  Options of;
  bool has_origin = false;
  const char *domain = std::getenv("ROS_DOMAIN_ID");
  if (domain && *domain) of.domain = number<std::uint32_t>("ROS_DOMAIN_ID", domain, 0, 232);
  for (int at = 1; at < argc; ++at) {
    const std::string option = argv[at];
    if (option == "--help") {
      std::cout << usage;
      std::exit(0);
    }
    const auto value = [&]() -> std::string {
      if (++at >= argc) refuse(option + ": a value is missing");
      return argv[at];
    };
    if (option == "--station") of.station = number<std::uint32_t>(option, value(), 1, UINT32_MAX);
    else if (option == "--name") of.name = value();
    else if (option == "--boot-file") of.boot_file = value();
    else if (option == "--link") of.link = address(option, value());
    else if (option == "--peer") of.peers.push_back(address(option, value()));
    else if (option == "--origin") {
      of.site.latitude = number<double>(option, value(), -89, 89);
      of.site.longitude = number<double>(option, value(), -180, 180);
      has_origin = true;
    } else if (option == "--namespace") of.space = value();
    else if (option == "--node") of.node = value();
    else if (option == "--domain") of.domain = number<std::uint32_t>(option, value(), 0, 232);
    else if (option == "--build") of.category = category(value());
    else if (option == "--silence-ms") of.silence = std::chrono::milliseconds{number<int>(option, value(), 200, 5000)};
    else if (option == "--log") of.log = value();
    else refuse(option + ": there is no such option");
  }
  if (of.space == "/") of.space.clear();
  if (of.station == 0 || of.name.empty() || of.boot_file.empty() || !of.link || of.peers.empty() || !has_origin)
    refuse("--station, --name, --boot-file, --link, --peer and --origin are wanted");
  if (!is_namespace(of.space)) refuse("--namespace " + of.space + ": a name of ROS 2 is wanted, like /go2");
  if (!is_name(of.node)) refuse("--node " + of.node + ": a name of ROS 2 is wanted, like crossguard");
  return of;
}

} // namespace

int main(int argc, char **argv) {
  const Options of = options(argc, argv);
  std::signal(SIGPIPE, SIG_IGN);
  for (const int ending : {SIGINT, SIGTERM}) std::signal(ending, [](int) { is_to_end = 1; });
  if (!of.log.empty() && !std::ofstream{of.log}) refuse("--log " + of.log + ": " + std::strerror(errno));
  Link link{*of.link, of.peers};
  if (!link.is_open()) refuse(std::string{"--link: "} + std::strerror(errno));
  // Without a say of somebody, DDS is on this machine alone.
  if (!std::getenv("CYCLONEDDS_URI")) setenv("CYCLONEDDS_URI", loopback, 0);
  const dds_entity_t participant = dds_create_participant(of.domain, nullptr, nullptr);
  if (participant < 0) {
    std::cerr << "DDS: " << dds_strretcode(participant) << std::endl;
    return 2;
  }
  // The counter is taken last, when nothing else can go wrong, and before anything is sent.
  const auto boot = next_boot(of.boot_file);
  if (!boot) refuse("--boot-file " + of.boot_file + ": no boot counter can be taken");
  const crossguard::Config config{of.station, *boot, of.name};
  auto robot = crossguard::Robot::start(config);
  if (!robot) refuse(config.why().value_or("the robot cannot be started"));
  bool has_left = false;
  try {
    // A node is large: buffers for packets and log are in it.
    const auto node = std::make_unique<Node>(of, participant, std::move(*robot), link);
    has_left = node->run();
    // What DDS calls from its threads has to end before what it calls.
    (void)dds_delete(participant);
  } catch (const ros::Error &error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  return has_left ? 0 : 3;
}
